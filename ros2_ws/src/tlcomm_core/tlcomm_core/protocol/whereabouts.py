"""Where a team meets though its meetings may end without agreement.

``Whereabouts``  where an agent is to be in which window
``Ending``       how a meeting ended for an agent

No protocol over a lossy network lets all members be certain, by a fixed time, that all are certain
(the coordinated attack): however long they confirm, one may lack a last word that the others
don't know to be lost. So when the meeting in window w is over, what an agent knows of round w + 1
is one of these, and it goes by

AGREED     It knows that all have confirmed the strategy: to its place in that, for good.
DOUBTFUL   It has confirmed, and may never learn whether all have. It keeps its promise: to the new
           place in window w + 1. Should the others not be there, it comes back in window w + 2,
           tries again in w + 3, and so on in turn, until it knows more.
GATHERED   It hasn't confirmed, and won't any more. But it has heard all offers, so all were at the
           meeting: to the same place as now, in every window.
MISSED     Not even that: where it would have gone without the meeting.

Claim: whatever is lost, late, doubled or reordered, from any window on there are q ∈ {0, 1} and a
place for each member, together the places of one meeting, such that each is to be at its place in
every window w ≡ q (mod 2), until the next meeting that somebody hears all offers of. So in at least
every other window the whole team is together.

Proof, by induction over windows. At first all are to be at their initial places in all windows. Let
window w end. If nobody has heard all offers, nobody's whereabouts have changed. If somebody has,
all were at a meeting in window w, since offers are made there, for one round; let W be the places
where they were. Whoever has MISSED was at its place by its whereabouts, and by the same is there
in windows w + 2, w + 4, …. Whoever has GATHERED is there in all. Whoever is DOUBTFUL is there in
w + 2, w + 4, … too. So if nobody has AGREED, the claim holds with W and q ≡ w. If somebody has, all
have confirmed (``negotiation``), so each has AGREED or is DOUBTFUL: all are at the new places in
windows w + 1, w + 3, …, and the claim holds with those and q ≡ w + 1.

A strategy for window w + 2, where the team skips one, changes nothing in this: who has AGREED waits
at the new place from w + 2 on, who is DOUBTFUL tries it in w + 1, w + 3, …

A pair that meets in some windows only counts these one by one, and all of this holds for it.

An agent whose meeting ended without agreement leaves it D_c after the end of the window, at the
latest. So for the team to be together for D_c in that window, the way between two places must not
take longer than T_c − D_c.
"""

from dataclasses import dataclass
from enum import Enum

__all__ = ["Ending", "Whereabouts"]

Place = tuple[float, float]


class Ending(Enum):
    """How a meeting ended for an agent; the value says so in reports."""

    AGREED = "agreed"
    DOUBTFUL = "doubtful"
    GATHERED = "gathered"
    MISSED = "missed"


@dataclass(frozen=True, slots=True)
class Whereabouts:
    """Where an agent is to be in which window.

    Attributes:
        sure: its place (m) in the last meeting that it knows all to have been at, or to go to.
        doubtful: its place in a later one that not all may have confirmed, if there is one.
        parity: it tries the doubtful place in windows w with w mod 2 equal to this.
    """

    sure: Place
    doubtful: Place | None = None
    parity: int = 0

    def place(self, window: int) -> Place:
        """Return where to be in a window."""
        if self.doubtful is not None and window % 2 == self.parity:
            return self.doubtful
        return self.sure

    def after(self, window: int, ending: Ending, new: Place | None) -> "Whereabouts":
        """Return where to be from now on.

        Args:
            window: w, whose meeting has ended.
            ending: how.
            new: the place in the strategy that the agent has confirmed, if it has.
        """
        here = self.place(window)
        if ending is Ending.MISSED:
            return self
        if ending is Ending.GATHERED or new is None:
            return Whereabouts(here)
        if ending is Ending.DOUBTFUL:
            return Whereabouts(here, new, (window + 1) % 2)
        return Whereabouts(new)
