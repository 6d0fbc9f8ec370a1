"""Publish a bag on ROS topics again, with its clock, types and qualities of service.

With ``--verify``, let fresh brains decide again what the bag's agents decided.
"""

import sys
import time
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.units import seconds
from tlcomm_tools.replay.keyboard import open_keyboard
from tlcomm_tools.replay.script import read_script
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import not_negative_float, positive_float, print_json
from tlcomm_tools.verbs.verification import verify_run

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm replay runs/plant-team-20260101-120000 --rate 10"

_RATE: Final = 1.0
_WAIT_S: Final = 2.0


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "run", type=Path, metavar="RUN_OR_BAG", help="a run's folder, a bag's folder or MCAP file"
    )
    parser.add_argument(
        "--rate",
        type=positive_float,
        default=_RATE,
        metavar="X",
        help="seconds of the bag per second (default: %(default)s)",
    )
    parser.add_argument(
        "--start",
        type=not_negative_float,
        default=0.0,
        metavar="S",
        help="begin S seconds after the bag's first message",
    )
    parser.add_argument(
        "--topics",
        type=_topics,
        metavar="A,B",
        help="these topics and /clock only (default: all)",
    )
    parser.add_argument("--loop", action="store_true", help="begin again after the end")
    parser.add_argument(
        "--wait",
        type=not_negative_float,
        default=_WAIT_S,
        metavar="S",
        help="wait at most S seconds for the first subscriber (default: %(default)s)",
    )
    parser.add_argument(
        "--verify",
        action="store_true",
        help="publish nothing; compare what fresh brains decide with what was recorded (of a run "
        "in lock step)",
    )


def run(options: Namespace) -> Status:
    """Replay the bag and say what was published; or verify it."""
    if options.verify:
        _refuse_playing(options)
        return verify_run(options.run, as_json=options.json)
    script = read_script(options.run, options.topics, options.start)
    # ROS is loaded only when there is something to replay.
    from tlcomm_tools.runtime.player import Playing, play  # noqa: PLC0415

    how = Playing(options.rate, options.loop, options.wait)
    begun_s = time.monotonic()
    with open_keyboard() as keyboard:
        if script.damage:
            _tell(f"the bag can be read only in part: {script.damage}")
        if keyboard.is_there:
            _tell("space pauses and goes on, '.' or right arrow steps, q quits")
        played = play(script, how, keyboard, _tell)
    wall_s = time.monotonic() - begun_s
    if options.json:
        print_json(
            {
                "format": "tlcomm-replay/1",
                "messages": played.messages,
                "topics": played.topics,
                "skipped": played.skipped,
                "reached_s": seconds(played.reached_ns) if played.messages else None,
                "wall_s": wall_s,
            }
        )
    else:
        until = f", up to {seconds(played.reached_ns):.3f} s" if played.messages else ""
        print(
            f"replayed {played.messages} messages on {played.topics} topics{until}, "
            f"in {wall_s:.1f} s"
        )
    return Status.FINE


def _refuse_playing(options: Namespace) -> None:
    """Refuse to be told how to publish where nothing is published."""
    told = {
        "--rate": options.rate != _RATE,
        "--start": options.start > 0.0,
        "--topics": options.topics is not None,
        "--loop": options.loop,
        "--wait": options.wait != _WAIT_S,
    }
    for name, is_told in told.items():
        if is_told:
            raise InputError(f"argument {name}: not with --verify, which publishes nothing")


def _tell(line: str) -> None:
    print(f"tlcomm: {line}", file=sys.stderr)


def _topics(text: str) -> frozenset[str]:
    """Read names of topics, with or without the slash before them."""
    names = [name.strip() for name in text.split(",")]
    if not all(names):
        raise ArgumentTypeError(f"expected names of topics, A,B, not {text!r}")
    return frozenset(name if name.startswith("/") else f"/{name}" for name in names)
