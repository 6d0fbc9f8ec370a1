"""Finish a bag that was left unfinished: all that can be read goes into a new, complete one."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.units import seconds
from tlcomm_tools.bag.reader import find_files
from tlcomm_tools.bag.repair import Ending, inspect, repair
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm repair runs/plant-team-20260101-120000/bag -o finished"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "bag", type=Path, metavar="BAG", help="a bag's folder or MCAP file, or a run's folder"
    )
    parser.add_argument(
        "-o",
        "--out",
        type=Path,
        metavar="OUT",
        help="the new bag's folder, which mustn't exist (default: beside the bag, …_repaired)",
    )


def run(options: Namespace) -> Status:
    """Repair the bag and say what was saved; a whole one is left alone."""
    path = _find_file(options.bag)
    ending = inspect(path)
    if not ending.flaw:
        _show(options, ending, None)
        return Status.FINE
    folder = _beside(path, options.bag) if options.out is None else options.out
    saved = repair(path, folder)
    _show(options, Ending(saved.messages, saved.end_ns, ending.flaw), folder)
    return Status.FINE


def _find_file(bag: Path) -> Path:
    files = find_files(bag)
    if len(files) > 1:
        raise InputError(f"{str(bag)!r} holds {len(files)} files: repair them one by one")
    return files[0]


def _beside(path: Path, bag: Path) -> Path:
    """Return where a repaired bag goes by default."""
    return path.with_name(f"{path.stem}_repaired") if bag.is_file() else _next_to(path.parent)


def _next_to(folder: Path) -> Path:
    whole = folder.resolve()
    return whole.with_name(f"{whole.name}_repaired")


def _show(options: Namespace, ending: Ending, folder: Path | None) -> None:
    end_s = None if ending.end_ns is None else seconds(ending.end_ns)
    if options.json:
        print_json(
            {
                "format": "tlcomm-repair/1",
                "flaw": ending.flaw or None,
                "messages": ending.messages,
                "end_s": end_s,
                "folder": None if folder is None else str(folder),
            }
        )
        return
    until = "" if end_s is None else f", up to {end_s:.3f} s"
    if folder is None:
        print(f"{options.bag} is whole: {ending.messages} messages{until}; nothing to do")
    else:
        print(f"{options.bag}: {ending.flaw}\n{folder}: {ending.messages} messages{until}")
