"""The ``tlcomm`` command: finds the verb, runs it, turns errors into exit statuses.

``main``    the entry point
``VERBS``   the verbs, with their modules and one line each

Each verb's module is imported only when it is asked for, so that the command starts at once.
"""

import argparse
import errno
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Final, NoReturn

from tlcomm_core.errors import InfeasibleRoundError, InputError, PlanningError
from tlcomm_tools.status import Status

__all__ = ["VERBS", "main"]

VERBS: Final = {
    "demo": "the plant scenario: one process per agent, recorded, with a summary",
    "run": "run a scenario with one ROS 2 process per agent",
    "simulate": "run a scenario inside one process, without ROS",
    "plan": "show each agent's local plan",
    "ltl": "translate a formula into a Büchi automaton",
    "round": "show one round's problem and its solution",
    "check": "audit a run from its bag",
    "report": "one page for a browser that shows a run",
    "replay": "publish a bag on ROS topics again, or verify its decisions",
    "repair": "finish a bag that was left unfinished",
    "compare": "the methods side by side: table, figures, CSV",
    "validate": "check a scenario file",
    "bench": "measure planning, solving and simulating",
    "network": "rehearse meetings over bad radio",
}
_HELP: Final = ("-h", "--help")
_BREAKING: Final = {errno.ENOSPC, errno.EDQUOT, errno.EIO}


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are ``InputError``s."""

    def error(self, message: str) -> NoReturn:
        """Raise the complaint instead of ending the process."""
        raise InputError(f"{message} (see '{self.prog} --help')")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments without the program's name; by default the process's.

    Returns:
        The exit status of the contract.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    try:
        status = _dispatch(arguments)
        # Here a full disk or a reader that has gone is still an error of ours to tell.
        sys.stdout.flush()
    except (InputError, PlanningError) as error:
        return _report(str(error), Status.BAD_INPUT)
    except InfeasibleRoundError as error:
        return _report(str(error), Status.BROKEN)
    except KeyboardInterrupt:
        return _report("interrupted", Status.INTERRUPTED)
    except BrokenPipeError:
        # Nobody reads on, ``head`` for instance.
        _discard_output()
        return Status.FINE
    except OSError as error:
        status = Status.BROKEN if error.errno in _BREAKING else Status.BAD_INPUT
        if error.filename is None:
            _discard_output()
        place = "standard output" if error.filename is None else repr(str(error.filename))
        return _report(f"{place}: {error.strerror}", status)
    return status


def _discard_output() -> None:
    """Let what can't be printed go nowhere: Python would complain once more at its exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _dispatch(arguments: Sequence[str]) -> int:
    if not arguments:
        raise InputError(f"expected a verb (the verbs are {', '.join(VERBS)}; see 'tlcomm --help')")
    if arguments[0] in _HELP:
        print(_overview())
        return Status.FINE
    verb, *rest = arguments
    if verb not in VERBS:
        raise InputError(f"unknown verb {verb!r} (the verbs are {', '.join(VERBS)})")
    module = import_module(f"tlcomm_tools.verbs.{verb}")
    parser = _Parser(
        prog=f"tlcomm {verb}",
        description=module.__doc__,
        epilog=f"example: {module.EXAMPLE}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    module.add_arguments(parser)
    try:
        options = parser.parse_args(rest)
    except SystemExit:  # --help
        return Status.FINE
    try:
        status: Status = module.run(options)
    except PlanningError as error:
        scenario = getattr(options, "scenario", None)
        raise type(error)(f"{scenario}: {error}" if scenario else str(error)) from error
    return status


def _overview() -> str:
    width = max(map(len, VERBS))
    lines = [f"  {verb:{width}}  {summary}" for verb, summary in VERBS.items()]
    return "\n".join(
        [
            "usage: tlcomm VERB [OPTION…]",
            "",
            *lines,
            "",
            "Every verb has --help and --json.",
            "Exit status: 0 all well, 1 a property failed, 2 bad input, 3 the run broke,",
            "130 interrupted.",
            "",
            "example: tlcomm demo",
        ]
    )


def _report(message: str, status: Status) -> Status:
    line = " ".join(message.split("\n"))
    print(f"tlcomm: error: {line}", file=sys.stderr)
    return status
