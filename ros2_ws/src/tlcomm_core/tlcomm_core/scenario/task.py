"""What an agent has to do, as the planner takes it.

``Task``            a formula, or an automaton that was given instead
``task_of``         an agent's
``hard_formula``    what its formulas ask for together
``task_field``      where its task stands in the scenario
``read_automaton``  an automaton's text
"""

from functools import lru_cache
from typing import Final

from tlcomm_core.ltl import BuchiAutomaton, Formula, conjunction, parse, read_hoa
from tlcomm_core.scenario.model import Agent

__all__ = ["Task", "hard_formula", "read_automaton", "task_field", "task_of"]

Task = Formula | BuchiAutomaton

# As many as agents of one process may well have.
_KEPT: Final = 32


def task_of(agent: Agent) -> Task:
    """Return the task of an agent of a checked scenario."""
    if agent.automaton is not None:
        return read_automaton(agent.automaton)
    return hard_formula(agent)


def hard_formula(agent: Agent) -> Formula:
    """Return all of an agent's hard tasks as one formula; *true* beside an automaton."""
    return conjunction([parse(text) for text in agent.hard_tasks])


def task_field(agent: Agent) -> str:
    """Return the field of an agent that says what it has to do, for messages."""
    if agent.automaton is not None:
        return "automaton"
    return "tasks" if agent.tasks else "task"


@lru_cache(maxsize=_KEPT)
def read_automaton(text: str) -> BuchiAutomaton:
    """Return the automaton that a text in HOA v1 describes; the last ones are kept.

    Raises:
        InputError: see ``read_hoa``.
    """
    return read_hoa(text)
