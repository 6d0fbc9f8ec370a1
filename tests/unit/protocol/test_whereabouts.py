"""Where a team meets though its meetings may end without agreement."""

from collections.abc import Iterator

import numpy as np
import pytest

from tlcomm_core.protocol.whereabouts import Ending, Whereabouts

START, NEW = (0.0, 0.0), (3.0, 4.0)


def test_at_first_it_is_where_it_started() -> None:
    """In every window."""
    assert {Whereabouts(START).place(window) for window in range(9)} == {START}


def test_with_an_agreement_it_is_at_the_new_place_for_good() -> None:
    """Whatever it was unsure of before."""
    unsure = Whereabouts(START, (1.0, 1.0), 1)
    assert unsure.after(3, Ending.AGREED, NEW) == Whereabouts(NEW)


def test_in_doubt_it_tries_both_places_in_turn() -> None:
    """The new one in the next window, the last one in the one after."""
    after = Whereabouts(START).after(6, Ending.DOUBTFUL, NEW)
    assert [after.place(window) for window in range(7, 12)] == [NEW, START, NEW, START, NEW]


@pytest.mark.parametrize("window", [7, 8])
def test_where_all_offers_were_heard_it_stays(window: int) -> None:
    """That all were here ends its doubt; not having heard them doesn't."""
    unsure = Whereabouts(START).after(6, Ending.DOUBTFUL, NEW)
    here = unsure.place(window)
    assert unsure.after(window, Ending.GATHERED, None) == Whereabouts(here)
    assert unsure.after(window, Ending.MISSED, None) == unsure


def endings(rng: np.random.Generator, count: int, *, are_all_here: bool) -> Iterator[Ending]:
    """Yield how a meeting may end for each member, by what the negotiation rules out.

    Somebody hears all offers only if all are here; all have confirmed if somebody agreed; and to
    have confirmed is to have heard all offers.
    """
    if not are_all_here:
        yield from [Ending.MISSED] * count
    elif rng.random() < 0.5:
        yield from rng.choice([Ending.AGREED, Ending.DOUBTFUL], count)
    else:
        yield from rng.choice([Ending.DOUBTFUL, Ending.GATHERED, Ending.MISSED], count)


@pytest.mark.parametrize("count", [2, 3, 5])
def test_in_every_other_window_all_are_together(count: int) -> None:
    """Meetings that end for each member in any way that can be never scatter the team: of two
    windows in a row, it is at the places of one meeting in at least one.
    """
    rng = np.random.default_rng(count)
    for _ in range(300):
        team = [Whereabouts((0.0, float(member))) for member in range(count)]
        meetings = {tuple(own.place(0) for own in team)}
        were_together = True
        for window in range(40):
            places = tuple(own.place(window) for own in team)
            are_together = places in meetings
            assert are_together or were_together
            were_together = are_together
            new = [(window + 1.0, float(member)) for member in range(count)]
            meetings.add(tuple(new))
            team = [
                own.after(window, ending, place)
                for own, ending, place in zip(
                    team, endings(rng, count, are_all_here=are_together), new, strict=True
                )
            ]
