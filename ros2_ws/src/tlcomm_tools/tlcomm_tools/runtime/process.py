"""A supervised process of a run: ``python -m tlcomm_tools.runtime.process {agent|sim|recorder}``.

``main``  the process
"""

import argparse
import contextlib
import os
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from rclpy.parameter import Parameter

from tlcomm_core.errors import InputError, PlanningError, TlcommError
from tlcomm_core.method import parse_method
from tlcomm_core.pace import parse_pace
from tlcomm_core.units import seconds
from tlcomm_tools.runtime.life import live
from tlcomm_tools.runtime.notify import (
    Failed,
    Notifier,
    Progress,
    Ready,
    watch_parent,
)
from tlcomm_tools.runtime.spin import spin
from tlcomm_tools.status import Status

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one process of a run and tell its supervisor how it goes; return the exit status."""
    watch_parent()
    # A process that wakes up waits for its turn instead of interrupting another's: what arrives
    # meanwhile is then handled together, and agents that share a computer agree sooner.
    # It is a favour to the others: where the kernel doesn't grant it, all goes on without.
    with contextlib.suppress(OSError):
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
    notifier = Notifier.from_environment()
    arguments = _parser().parse_args(argv)
    work: Callable[[argparse.Namespace, Notifier], int] = arguments.work
    try:
        return work(arguments, notifier)
    except (InputError, PlanningError) as error:
        return _fail(notifier, error, Status.BAD_INPUT)
    except TlcommError as error:
        return _fail(notifier, error, Status.BROKEN)


def _fail(notifier: Notifier, error: TlcommError, status: Status) -> int:
    print(error, file=sys.stderr)
    # The supervisor interrupts everybody as soon as it hears of this; it is leaving already.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    notifier.tell(Failed(str(error), status))
    return status


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="process", description="A process of a run.")
    roles = parser.add_subparsers(required=True, metavar="ROLE")
    agent = roles.add_parser("agent", help="an agent")
    agent.add_argument("--name", required=True)
    sim = roles.add_parser("sim", help="world and clock")
    sim.add_argument("--rounds", type=int)
    sim.add_argument("--until", type=float, metavar="S")
    recorder = roles.add_parser("recorder", help="the recorder")
    recorder.add_argument("--bag", type=Path, required=True)
    recorder.add_argument("--compression", required=True)
    for role in (agent, sim, recorder):
        role.add_argument("--scenario", required=True)
        role.add_argument("--seed", type=int, default=0)
        role.add_argument("--pace", required=True)
    for role in (agent, sim):
        role.add_argument("--recorder", action="store_true", help="wait for a recorder")
    for role in (agent, recorder):
        role.add_argument("--solver", required=True)
        role.add_argument("--method", required=True)
    agent.set_defaults(work=_be_agent)
    sim.set_defaults(work=_be_sim)
    recorder.set_defaults(work=_be_recorder)
    return parser


def _be_agent(arguments: argparse.Namespace, notifier: Notifier) -> int:
    from tlcomm_agent.node import AgentNode  # noqa: PLC0415 (each role loads its own part only)

    parameters = [
        *_common(arguments),
        Parameter("solver", value=arguments.solver),
        Parameter("method", value=arguments.method),
        Parameter("use_sim_time", value=not parse_pace(arguments.pace).is_lockstep),
    ]
    return live(
        lambda: AgentNode(
            namespace=arguments.name,
            parameters=parameters,
            on_ready=lambda: notifier.tell(Ready()),
        ),
        notifier,
    )


def _be_sim(arguments: argparse.Namespace, notifier: Notifier) -> int:
    from tlcomm_sim.node import SimNode  # noqa: PLC0415 (each role loads its own part only)

    chosen = {"rounds": arguments.rounds, "until_s": arguments.until}
    parameters = [
        *_common(arguments),
        *(Parameter(name, value=value) for name, value in chosen.items() if value is not None),
    ]
    return live(
        lambda: SimNode(
            parameters=parameters,
            on_ready=lambda: notifier.tell(Ready()),
            on_progress=lambda sim_ns, meetings_ended: notifier.tell(
                Progress(seconds(sim_ns), meetings_ended)
            ),
        ),
        notifier,
    )


def _be_recorder(arguments: argparse.Namespace, notifier: Notifier) -> int:
    from tlcomm_core.scenario.loader import dumps, load_scenario  # noqa: PLC0415 (as above)
    from tlcomm_tools.bag.compression import Compression  # noqa: PLC0415 (as above)
    from tlcomm_tools.runtime import recorder  # noqa: PLC0415 (as above)

    scenario = load_scenario(arguments.scenario)
    notes = {
        "scenario": dumps(scenario),
        "method": arguments.method,
        "solver": arguments.solver,
        "seed": str(arguments.seed),
        "pace": arguments.pace,
    }
    settings = recorder.RecorderSettings(
        bag=arguments.bag,
        scenario=scenario,
        method=parse_method(arguments.method),
        is_lockstep=parse_pace(arguments.pace).is_lockstep,
        compression=Compression(arguments.compression),
        notes=notes,
    )
    return recorder.run(settings, spin, notifier)


def _common(arguments: argparse.Namespace) -> list[Parameter]:
    return [
        Parameter("scenario", value=arguments.scenario),
        Parameter("pace", value=arguments.pace),
        Parameter("seed", value=arguments.seed),
        Parameter("recorder", value=arguments.recorder),
    ]


if __name__ == "__main__":
    sys.exit(main())
