"""Options that several verbs share, and the types of their values.

``add_mission_arguments``  what is run, how long, and where to
``add_recorded_arguments``  a run to look at, and what it was if its bag doesn't say
``add_pace_argument``      how simulated time goes on
``add_compression_argument``  how the bag is compressed
``add_seed_argument``      what chance is drawn from
``add_solver_argument``    how rounds are solved
``add_view_argument``      whether a browser can look on
``positive_int``, ``not_negative_int``, ``positive_float``, ``positive_fraction``   types
``not_negative_float``, ``share``, ``seed``, ``team_size``   more types
``pace``, ``method``, ``solver``, ``compression``  more types
``mission_end``            how long to run
``print_json``             one document on standard output
"""

import argparse
import json
import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import DEFAULT, SOLVERS, Solver
from tlcomm_core.method import Method
from tlcomm_core.pace import Pace, parse_pace
from tlcomm_tools.bag.compression import DEFAULT as DEFAULT_COMPRESSION
from tlcomm_tools.bag.compression import Compression

__all__ = [
    "LOCKSTEP",
    "add_compression_argument",
    "add_mission_arguments",
    "add_pace_argument",
    "add_recorded_arguments",
    "add_seed_argument",
    "add_solver_argument",
    "add_view_argument",
    "compression",
    "method",
    "mission_end",
    "not_negative_float",
    "not_negative_int",
    "pace",
    "positive_float",
    "positive_fraction",
    "positive_int",
    "print_json",
    "seed",
    "share",
    "solver",
    "team_size",
]

LOCKSTEP: Final = "lockstep"
_DEFAULT_ROUNDS: Final = 5
_LEAST_TEAM: Final = 2
# As large as a parameter of a ROS node may be.
_MOST_SEED: Final = 2**63 - 1
_LEAST_FRACTION: Final = Fraction(1, 10**9)
_MOST_FRACTION: Final = Fraction(10**9)


def positive_int(text: str) -> int:
    """Read a whole number from 1 on."""
    value = _whole(text)
    if value is None or value < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number from 1 on, not {text!r}")
    return value


def not_negative_int(text: str) -> int:
    """Read a whole number from 0 on."""
    value = _whole(text)
    if value is None or value < 0:
        raise argparse.ArgumentTypeError(f"expected a whole number from 0 on, not {text!r}")
    return value


def seed(text: str) -> int:
    """Read a seed."""
    value = _whole(text)
    if value is None or not 0 <= value <= _MOST_SEED:
        raise argparse.ArgumentTypeError(
            f"expected a whole number from 0 to {_MOST_SEED}, not {text!r}"
        )
    return value


def team_size(most: int) -> Callable[[str], int]:
    """Return a type: a whole number of agents that can meet, up to so many."""

    def read(text: str) -> int:
        value = _whole(text)
        if value is None or not _LEAST_TEAM <= value <= most:
            raise argparse.ArgumentTypeError(
                f"expected a whole number from {_LEAST_TEAM} to {most}, not {text!r}"
            )
        return value

    return read


def positive_float(text: str) -> float:
    """Read a finite number greater than 0."""
    value = _number(text)
    if not value:
        raise argparse.ArgumentTypeError(f"expected a number greater than 0, not {text!r}")
    return value


def not_negative_float(text: str) -> float:
    """Read a finite number from 0 on."""
    value = _number(text)
    if value is None:
        raise argparse.ArgumentTypeError(f"expected a number from 0 on, not {text!r}")
    return value


def share(text: str) -> float:
    """Read a number from 0 to 1."""
    value = _number(text)
    if value is None or value > 1.0:
        raise argparse.ArgumentTypeError(f"expected a number from 0 to 1, not {text!r}")
    return value


def positive_fraction(text: str) -> Fraction:
    """Read a number or a ratio from 1e-9 to 1e9, exactly."""
    try:
        # A float first: exactly, the number 1e-999999999 would fill the memory.
        is_fine = "/" in text or _LEAST_FRACTION <= float(text) <= _MOST_FRACTION
        value = Fraction(text) if is_fine else Fraction(0)
    except (ValueError, ZeroDivisionError):
        value = Fraction(0)
    if not _LEAST_FRACTION <= value <= _MOST_FRACTION:
        raise argparse.ArgumentTypeError(
            f"expected a number or a ratio from 1e-9 to 1e9, not {text!r}"
        )
    return value


def pace(text: str) -> Pace:
    """Read a pace: ``lockstep``, or the factor to run at."""
    try:
        return parse_pace(text)
    except InputError:
        raise argparse.ArgumentTypeError(
            f"expected {LOCKSTEP!r} or a factor greater than 0 (1.0 is real time), not {text!r}"
        ) from None


def method(text: str) -> Method:
    """Read a method of coordination."""
    if text not in list(Method):
        choices = ", ".join(repr(own.value) for own in Method)
        raise argparse.ArgumentTypeError(f"invalid choice: {text!r} (choose from {choices})")
    return Method(text)


def compression(text: str) -> Compression:
    """Read a way of compressing a bag."""
    if text not in list(Compression):
        choices = ", ".join(repr(own.value) for own in Compression)
        raise argparse.ArgumentTypeError(f"invalid choice: {text!r} (choose from {choices})")
    return Compression(text)


def solver(text: str) -> Solver:
    """Read a solver's name."""
    if text not in SOLVERS:
        choices = ", ".join(map(repr, SOLVERS))
        raise argparse.ArgumentTypeError(f"invalid choice: {text!r} (choose from {choices})")
    return SOLVERS[text]


def add_mission_arguments(parser: argparse.ArgumentParser) -> None:
    """Add how long to run, how, and where to write."""
    end = parser.add_mutually_exclusive_group()
    end.add_argument(
        "--rounds",
        type=not_negative_int,
        metavar="N",
        help=f"run until D_c after the meeting of round N (default {_DEFAULT_ROUNDS})",
    )
    end.add_argument(
        "--until", type=positive_float, metavar="S", help="run until this simulated time (s)"
    )
    parser.add_argument(
        "--method",
        type=method,
        default=Method.TEAM,
        metavar="NAME",
        help=f"of coordination: {', '.join(Method)} (default {Method.TEAM})",
    )
    add_solver_argument(parser)
    add_seed_argument(parser)
    parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="write here (default runs/NAME-METHOD-TIME)",
    )


def add_solver_argument(parser: argparse.ArgumentParser) -> None:
    """Add how rounds are solved."""
    parser.add_argument(
        "--solver",
        type=solver,
        default=DEFAULT,
        metavar="NAME",
        help=f"of the team's rounds: {', '.join(SOLVERS)} (default {DEFAULT.name})",
    )


def add_seed_argument(parser: argparse.ArgumentParser, of: str = "all that is random") -> None:
    """Add what chance is drawn from."""
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help=f"of {of} (default 0)")


def add_recorded_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the run or bag, and what it may not say of itself."""
    parser.add_argument(
        "run", type=Path, metavar="RUN_OR_BAG", help="a run's folder, a bag's folder or MCAP file"
    )
    parser.add_argument(
        "--scenario",
        type=Path,
        metavar="FILE",
        help="the scenario (default: as the bag says, else scenario.yaml beside the bag)",
    )
    parser.add_argument(
        "--method",
        type=method,
        metavar="NAME",
        help=f"one of {', '.join(Method)} (default: as the bag says, else {Method.TEAM})",
    )
    parser.add_argument(
        "--pace",
        type=pace,
        metavar="lockstep|FACTOR",
        help="how simulated time went on (default: as the bag says)",
    )


def add_pace_argument(parser: argparse.ArgumentParser) -> None:
    """Add how simulated time goes on."""
    parser.add_argument(
        "--pace",
        type=pace,
        default=Pace(None),
        metavar="lockstep|FACTOR",
        help="in lock step (the default), or at a factor of real time",
    )


def add_compression_argument(parser: argparse.ArgumentParser) -> None:
    """Add how the bag is compressed."""
    parser.add_argument(
        "--compression",
        type=compression,
        default=DEFAULT_COMPRESSION,
        metavar="NAME",
        help=f"of the bag: {', '.join(Compression)} (default {DEFAULT_COMPRESSION})",
    )


def add_view_argument(parser: argparse.ArgumentParser) -> None:
    """Add whether a browser can look on."""
    parser.add_argument(
        "--view",
        action="store_true",
        help="serve a page on this machine that shows the run as it goes on",
    )


def mission_end(options: argparse.Namespace) -> tuple[int | None, float | None]:
    """Return the rounds and the time to run to; one of them is ``None``."""
    if options.until is not None:
        return None, options.until
    return _DEFAULT_ROUNDS if options.rounds is None else options.rounds, None


def print_json(document: Mapping[str, Any]) -> None:
    """Print one JSON document on standard output."""
    print(json.dumps(document, indent=2, ensure_ascii=False))


def _whole(text: str) -> int | None:
    try:
        return int(text)
    except ValueError:
        return None


def _number(text: str) -> float | None:
    """Return a finite number from 0 on, or ``None``."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) and value >= 0.0 else None
