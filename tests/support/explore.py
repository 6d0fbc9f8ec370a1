"""Explore larger teams by hand: ``python -m support.explore line 3`` in ``tests``.

``main``  explore one space, print what was found
"""

import sys
import time
from argparse import ArgumentParser

from support.meetings import SHAPES
from support.state_space import flaw, tiny_space
from tlcomm_core.game.solver import BEST_RESPONSE, EXACT

__all__ = ["main"]


def main() -> int:
    """Explore the space that the command line asks for; return 1 if something is wrong."""
    parser = ArgumentParser(prog="support.explore", description=__doc__)
    parser.add_argument("shape", choices=SHAPES)
    parser.add_argument("agents", type=int)
    parser.add_argument("--iterations", type=int, default=1, help="of best responses (default 1)")
    parser.add_argument("--gathered", action="store_true", help="offers are known beforehand")
    parser.add_argument("--prompt", action="store_true", help="act upon each message at once")
    parser.add_argument("--proposing", action="store_true", help="begin with proposals")
    parser.add_argument("--most", type=int, default=10_000_000, help="states (default 10000000)")
    options = parser.parse_args()
    space = tiny_space(
        options.shape,
        options.agents,
        iterations=options.iterations,
        is_gathered=options.gathered,
        is_prompt=options.prompt,
        solver=EXACT if options.proposing else BEST_RESPONSE,
    )
    begin_s = time.perf_counter()
    found = space.explore(flaw, options.most)
    print(  # noqa: T201  # a command's output
        f"{found.team_states} states of the team, {found.agent_states} of single agents, "
        f"{found.messages} messages, {found.transitions} transitions, "
        f"{'all' if found.is_complete else 'not all'} explored "
        f"in {time.perf_counter() - begin_s:.1f} s\n" + ("\n".join(found.flaws) or "nothing wrong")
    )
    return 1 if found.flaws else 0


if __name__ == "__main__":
    sys.exit(main())
