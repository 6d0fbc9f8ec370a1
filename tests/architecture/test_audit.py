"""The audit shares no code with what it judges."""

import pytest

from support.source_tree import Module, imported, modules

# What records are made of, what was asked for, and the library of formulas, tested on its own.
SHARED = (
    "tlcomm_core.agent.actions",
    "tlcomm_core.errors",
    "tlcomm_core.game.offer.MemberOffer",
    "tlcomm_core.game.strategy",
    "tlcomm_core.ltl",
    "tlcomm_core.method",
    "tlcomm_core.pace",
    "tlcomm_core.records",
    "tlcomm_core.scenario.model",
    "tlcomm_core.scenario.task",
    "tlcomm_core.units",
    "tlcomm_core.world.observation",
)


def flaws(module: Module) -> list[str]:
    """Return what a module of the audit imports from what it judges."""
    if not module.name.startswith("tlcomm_tools.audit"):
        return []
    names = (name for name in imported(module) if name.startswith("tlcomm_core."))
    return [f"{module.name} -> {own}" for own in names if not own.startswith(SHARED)]


def test_the_audit_reckons_for_itself() -> None:
    """Values are shared, but nothing that computes."""
    assert [flaw for module in modules() for flaw in flaws(module)] == []


@pytest.mark.parametrize(
    "line",
    [
        "from tlcomm_core.workspace.travel import TravelTimes",
        "from tlcomm_core.game.offer import offer_flaw",
        "from tlcomm_core.game.links import Links",
        "from tlcomm_core.world.radio import links",
        "from tlcomm_core.protocol.team import Team",
        "import tlcomm_core.planning.plan",
    ],
)
def test_borrowed_reckoning_is_found(line: str) -> None:
    """Whatever the form of the import."""
    assert flaws(Module("tlcomm_tools.audit.equilibria.travel", line))
