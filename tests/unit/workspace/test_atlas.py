"""Travel times by motion and avoided regions."""

import numpy as np

from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion

ATLAS = Atlas(Grid((2.5, 0.5), 0.5), {"gate": (1.25, 0.25, 0.2), "end": (2.25, 0.1, 0.2)})
MOTION = Motion(1.0, 1.5)


def test_equal_motions_that_avoid_the_same_share_their_travel_times() -> None:
    """Another motion or another region gives others."""
    plain = ATLAS.travel(MOTION)
    round_gate = ATLAS.travel(MOTION, frozenset({"gate"}))
    assert ATLAS.travel(Motion(1.0, 1.5)) is plain
    assert ATLAS.travel(MOTION, frozenset({"gate"})) is round_gate is not plain
    assert ATLAS.travel(Motion(2.0, 1.5)) is not plain
    assert ATLAS.travel(MOTION, frozenset({"end"})).grid.avoided.keys() == {"end"}


def test_what_is_avoided_is_out_of_reach_and_so_is_what_lies_behind() -> None:
    """All others keep their times."""
    plain, round_gate = ATLAS.travel(MOTION), ATLAS.travel(MOTION, frozenset({"gate"}))
    assert np.isinf(round_gate.time_to(0)[2:]).all()
    np.testing.assert_array_equal(round_gate.time_to(0)[:2], plain.time_to(0)[:2])


def test_only_regions_can_be_avoided() -> None:
    """Whether a peer's names are regions can be asked."""
    assert ATLAS.knows(frozenset({"gate", "end"}))
    assert not ATLAS.knows(frozenset({"gate", "gaet"}))
