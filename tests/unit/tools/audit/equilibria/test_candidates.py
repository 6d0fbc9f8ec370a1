"""The maps that rounds are planned on."""

from support.hand_made_run import hand_made_scenario
from tlcomm_core.scenario.model import Change
from tlcomm_tools.audit.equilibria.candidates import grounds_of


def test_each_change_is_a_map_by_its_time() -> None:
    """One that closes the same cells as the first is the first: agents know its obstacles."""
    good = hand_made_scenario()
    whole, half = (3.0, 0.0, 3.5, 0.5), (3.1, 0.1, 3.4, 0.4)
    changes = (
        Change(at_s=1.5, obstacles_m=()),
        Change(at_s=2.0, obstacles_m=(half,)),
    )
    update = {"obstacles_m": (whole,), "changes": changes}
    workspace = good.workspace.model_copy(update=update)
    grounds = grounds_of(good.model_copy(update={"workspace": workspace}), 0.0)
    assert list(grounds) == [0, 1_500_000_000, 2_000_000_000]
    assert grounds[2_000_000_000] is grounds[0]
    assert len(grounds[1_500_000_000].cells) == len(grounds[0].cells) + 1
