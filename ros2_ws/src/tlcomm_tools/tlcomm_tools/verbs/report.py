"""Show a run as one page for a browser: the map in motion, why each meeting, tasks and audit."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_tools.bag.origin import find_method, find_pace, find_scenario
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.collection import uncollected
from tlcomm_tools.folder import replace_file
from tlcomm_tools.report.document import report_document
from tlcomm_tools.report.moves import read_best_responses
from tlcomm_tools.report.page import render_page
from tlcomm_tools.report.plans import read_plans
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import add_recorded_arguments, print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm report runs/plant-team-20260101-120000 -o plant.html"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_recorded_arguments(parser)
    parser.add_argument(
        "-o",
        "--out",
        type=Path,
        required=True,
        metavar="FILE.html",
        help="write the page here; a file that is there already is replaced",
    )


@uncollected()
def run(options: Namespace) -> Status:
    """Write the page; the status is that of reading and writing, whatever the verdict."""
    _require_writable(options.out)
    recorded = read_run(options.run)
    scenario = find_scenario(options.run, recorded, options.scenario)
    method = find_method(options.run, recorded, options.method)
    pace = find_pace(options.run, recorded, options.pace)
    said, plans = read_best_responses(options.run), read_plans(options.run)
    document = report_document(scenario, method, recorded, said, plans, pace)
    text = render_page(document)
    replace_file(options.out, text)
    verdict = document["audit"]["verdict"]
    size_mb = len(text.encode()) / 1e6
    if options.json:
        print_json({"file": str(options.out), "size_mb": round(size_mb, 3), "verdict": verdict})
    else:
        print(f"{options.out}  {size_mb:.1f} MB")
        print(f"verdict: {verdict if verdict == 'ok' else 'FAILED'}")
    return Status.FINE


def _require_writable(path: Path) -> None:
    """Refuse early what can't be a file; a long reading would be for nothing."""
    if path.is_dir():
        raise InputError(f"--out: {str(path)!r} is a folder, expected a file's name")
    if not path.parent.is_dir():
        raise InputError(f"--out: there is no folder {str(path.parent)!r}")
