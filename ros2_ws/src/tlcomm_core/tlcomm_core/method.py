"""How a team coordinates: the paper's way, and those that it is compared with.

``Method``        all of them, by the names that users call them
``parse_method``  one by its name
"""

from enum import StrEnum

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import BEST_RESPONSE, EXACT, Solver

__all__ = ["Method", "parse_method"]


class Method(StrEnum):
    """A way for a team to coordinate; each is decentralised, and runs in both harnesses."""

    TEAM = "team"
    """The team meets as a whole in each window, where and when costs it least."""
    STATIC = "static"
    """The same, at the places where it stands at first: only when to go there is optimised."""
    PAIRWISE = "pairwise"
    """Pairs of a connected graph meet by turns (Kantaros, Guo and Zavlanos 2019)."""
    ALL_TIME = "all-time"
    """The team stays connected; its members lead by turns (Guo, Tumova and Dimarogonas 2016)."""
    NONE = "none"
    """Nobody meets: the least that tasks take."""
    ORACLE = "oracle"
    """As ``TEAM``, with the optimum of each round: the yardstick for small teams."""

    def solver(self, chosen: Solver) -> Solver:
        """Return how its rounds are solved, where the user has chosen a solver for the team's."""
        match self:
            case Method.ORACLE | Method.PAIRWISE:
                return EXACT
            case Method.TEAM:
                return chosen
            case _:
                return BEST_RESPONSE

    @property
    def meets_in_windows(self) -> bool:
        """Whether its rounds are windows: the team meets in each as a whole, once."""
        return self in (Method.TEAM, Method.STATIC, Method.ORACLE)

    @property
    def goes_together(self) -> bool:
        """Whether the team goes everywhere as one, by one way at one speed."""
        return self is Method.ALL_TIME

    @property
    def keeps_windows(self) -> bool:
        """Whether it promises that the team is connected for D_c in each window."""
        return self not in (Method.PAIRWISE, Method.NONE)

    @property
    def chooses_places(self) -> bool:
        """Whether its meetings' places are chosen, so that demands on them can be met."""
        return self in (Method.TEAM, Method.PAIRWISE, Method.ORACLE)

    @property
    def has_meetings(self) -> bool:
        """Whether its strategies are meetings, each in a window, that agents go to and leave."""
        return self not in (Method.ALL_TIME, Method.NONE)


def parse_method(text: str) -> Method:
    """Return the method of a name.

    Raises:
        InputError: there is none.
    """
    try:
        return Method(text)
    except ValueError:
        raise InputError(f"method: {text!r} isn't one of {', '.join(Method)}") from None
