"""What an agent has to do, as the planner takes it.

``Task``            a formula, or an automaton that was given instead
``task_of``         an agent's
``read_automaton``  an automaton's text
"""

from functools import lru_cache
from typing import Final

from tlcomm_core.ltl import BuchiAutomaton, Formula, conjunction, parse, read_hoa
from tlcomm_core.scenario.model import Agent

__all__ = ["Task", "read_automaton", "task_of"]

Task = Formula | BuchiAutomaton

# As many as agents of one process may well have.
_KEPT: Final = 32


def task_of(agent: Agent) -> Task:
    """Return the task of an agent of a checked scenario."""
    if agent.automaton is not None:
        return read_automaton(agent.automaton)
    return conjunction([parse(text) for text in agent.hard_tasks])


@lru_cache(maxsize=_KEPT)
def read_automaton(text: str) -> BuchiAutomaton:
    """Return the automaton that a text in HOA v1 describes; the last ones are kept.

    Raises:
        InputError: see ``read_hoa``.
    """
    return read_hoa(text)
