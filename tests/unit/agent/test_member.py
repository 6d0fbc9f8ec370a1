"""One agent as a shell holds it."""

import pytest

from support.hall import STARTS, hall, make_member
from tlcomm_core.agent.actions import CountIgnored, Drive, SendMessage
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import Member, create, team_of
from tlcomm_core.errors import PlanningError
from tlcomm_core.game.rules import Rules
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.messages import EstimateExchange, Message
from tlcomm_core.protocol.negotiation import Phase
from tlcomm_core.scenario.loader import dumps, loads
from tlcomm_core.scenario.model import Radio
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas

LATENCY_NS = 5_000_000


def placed(name: str, count: int, pacing: Pacing = Pacing.EVENT) -> Member:
    """Return a member that has seen its start and everybody in range."""
    member = make_member(name, count, pacing)
    member.see_odometry(0, Pose(*STARTS[name]), 0.0, 0.0)
    member.see_neighbours(0, dict.fromkeys(STARTS.keys() - {name}, 1.0))
    return member


def said(member: Member, now_ns: int) -> list[Message]:
    """Return what a member says in a step."""
    return [action.message for action in member.step(now_ns) if isinstance(action, SendMessage)]


def test_a_step_after_nothing_needs_nothing() -> None:
    """Before its first odometry, time alone means nothing to it."""
    member = make_member("one", 1)
    assert member.step(0) == ()
    assert member.next_need_ns is None


@pytest.mark.parametrize("pacing", Pacing)
def test_the_next_need_is_always_ahead(pacing: Pacing) -> None:
    """Rounding never asks for the instant that just was, nor for one long after the need."""
    member = placed("one", 1, pacing)
    now_ns, drives = 0, 0
    pose, drive = Pose(*STARTS["one"]), Drive(0.0, 0.0)
    for _ in range(2000):
        member.see_odometry(now_ns, pose, drive.linear_mps, drive.angular_radps)
        for action in member.step(now_ns):
            if isinstance(action, Drive):
                drive, drives = action, drives + 1
        need_ns = member.next_need_ns
        assert need_ns is not None
        assert need_ns > now_ns
        need_s = member._brain.next_need_s
        assert need_ns == max(nanoseconds(need_s), now_ns + 1)
        now_ns = need_ns
    assert drives > 0


def test_a_step_handles_everything_seen_once() -> None:
    """A second step at the same time has nothing to add."""
    member = placed("one", 1)
    assert member.step(0) != ()
    assert member.step(0) == ()
    assert member._odometry == []


def test_estimates_are_no_business_of_the_brain_s() -> None:
    """A member whose scenario has no field counts them as unneeded, and its brain isn't woken."""
    one = placed("one", 2)
    one.step(0)
    need_ns = one.next_need_ns
    one.receive(EstimateExchange("two", 0, 1, False, 3.0), 0)
    assert one.step(LATENCY_NS) == (CountIgnored("unneeded"),)
    assert one.next_need_ns == need_ns


def test_a_message_is_heard_a_latency_after_it_was_sent() -> None:
    """In lock step; so what happens at one instant can't depend on who acts first."""
    one, two = placed("one", 2), placed("two", 2)
    for message in said(two, 0):
        one.receive(message, 0)
    first = said(one, 0)
    assert all(not message.offers or message.known == ("one",) for message in first)  # type: ignore[union-attr]
    assert said(one, LATENCY_NS - 1) == []
    assert said(one, LATENCY_NS) != []


def test_free_running_a_message_is_heard_when_it_comes() -> None:
    """The network's own latency is enough."""
    one, two = placed("one", 2, Pacing.PERIODIC), placed("two", 2, Pacing.PERIODIC)
    for message in said(two, 0):
        one.receive(message, 0)
    (offer, *_) = said(one, 0)
    assert offer.known == ("one", "two")  # type: ignore[union-attr]


def test_who_is_out_of_range_is_not_heard() -> None:
    """Nothing that it says has any effect but to be counted."""
    one, two, alone = placed("one", 2), placed("two", 2), placed("one", 2)
    one.see_neighbours(1, {})
    for message in said(two, 0):
        one.receive(message, 0)
    for now_ns in (0, LATENCY_NS, 10 * LATENCY_NS):
        assert one.step(now_ns) == alone.step(now_ns)
        assert one.next_need_ns == alone.next_need_ns
    assert (one.undelivered, alone.undelivered) == ({"out of range": 1}, {})


def test_it_asks_to_be_woken_for_what_is_still_under_way() -> None:
    """A message delayed at random is heard when it is due, not when something else happens."""
    site = hall(2)
    radio = Radio(jitter_s=0.05)
    late = Site.from_scenario(site.scenario.model_copy(update={"radio": radio}))
    one = create("one", late, Pacing.EVENT, Atlas(site.grid))
    two = placed("two", 2)
    one.see_odometry(0, Pose(*STARTS["one"]), 0.0, 0.0)
    one.see_neighbours(0, {"two": 0.5})
    for message in said(two, 0):
        one.receive(message, 0)
    one.step(0)
    one.step(LATENCY_NS)
    due_ns = one._radio.next_due_ns
    assert due_ns is not None
    while (need_ns := one.next_need_ns) is not None and need_ns < due_ns:
        assert all(repeated.known == ("one",) for repeated in said(one, need_ns))  # type: ignore[union-attr]
    assert need_ns == due_ns
    (offer, *_) = said(one, due_ns)
    assert offer.known == ("one", "two")  # type: ignore[union-attr]


def test_it_counts_what_is_said_to_it_on_the_way() -> None:
    """Away from a meeting, the radio lets a neighbour through, and the brain ignores it."""
    one, two = placed("one", 1), placed("two", 2)
    one.step(0)
    one.step(3_000_000_000)
    assert one.meetings_ended == 1
    for message in said(two, 0):
        one.receive(message, 3_000_000_000)
    assert CountIgnored("not meeting") in one.step(3_000_000_000 + LATENCY_NS)


def test_phase_and_meetings_ended_go_on_together() -> None:
    """A team of one agrees at once and leaves after D_c."""
    member = placed("one", 1)
    member.step(0)
    assert (member.meetings_ended, member.phase) == (0, Phase.AGREED)
    member.step(3_000_000_000)
    assert (member.meetings_ended, member.phase) == (1, None)


def test_periodic_control_is_allowed_for_in_predictions() -> None:
    """Free running, legs are reckoned longer than in lock step."""
    event, periodic = (make_member("one", 1, pacing)._brain._settings for pacing in Pacing)
    pose = Pose(*STARTS["one"])
    target = event.plan.step(0).location
    exact_s = event.travel.leg_to(pose, target).duration_s
    assert exact_s < periodic.travel.leg_to(pose, target).duration_s < exact_s + 1.0


def test_an_impossible_task_is_refused() -> None:
    """A member without a plan isn't made."""
    text = dumps(hall(1).scenario).replace("F (b & place)", "F (b & !b & place)")
    site = Site.from_scenario(loads(text))
    with pytest.raises(PlanningError):
        create("one", site, Pacing.EVENT, Atlas(site.grid))


def test_a_team_knows_what_its_scenario_demands_of_meetings() -> None:
    """Rules, margin and clearance, which is what an agent may be off."""
    site = hall(2)
    demands = {"separation_m": 0.5, "resilience": 1, "margin_s": 2.0}
    communication = site.scenario.communication.model_copy(update=demands)
    scenario = site.scenario.model_copy(
        update={"communication": communication, "radio": Radio(line_of_sight=True)}
    )
    team = team_of(Site.from_scenario(scenario))
    assert (team.rules, team.margin_s, team.clearance_m) == (Rules(0.5, 1), 2.0, 0.02)
    assert team_of(site).clearance_m is None
