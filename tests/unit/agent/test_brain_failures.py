"""Failed actions: attempts, and meetings that are kept all the same."""

import pytest

from support.hall import PERIOD_S, LoneAgent, of_kind
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.scenario.model import Faults

STARTED, FINISHED, REACHED, _, _, _, _, FAULT, VISITED, *_ = TaskEventKind


@pytest.fixture(scope="module", params=[0.3, 1.0])
def unlucky(request: pytest.FixtureRequest) -> LoneAgent:
    """Return a team of one whose actions often fail, or always, after forty windows."""
    agent = LoneAgent("one", 1, Faults(action_failure=request.param))
    agent.act()
    agent.advance_to(40 * PERIOD_S)
    return agent


def test_a_failed_attempt_is_reported_and_not_done(unlucky: LoneAgent) -> None:
    """Each attempt is started, takes its time, and ends either way; failed ones are numbered."""
    kinds = {STARTED, FINISHED, FAULT}
    acts = [(t, event) for t, event in unlucky.events if event.kind in kinds]
    assert len([event for _, event in acts if event.kind is FAULT]) > 20
    done = -1
    for (from_s, begun), (to_s, ended) in zip(acts[::2], acts[1::2], strict=False):
        assert (begun.kind, begun.action) == (STARTED, ended.action)
        assert to_s - from_s == pytest.approx({"pick": 4.0, "place": 2.0}[begun.action])
        assert begun.plan_index == ended.plan_index > done
        if ended.kind is FINISHED:
            done = ended.plan_index
        else:
            assert ended.detail.startswith(f"action={begun.action} attempt=")


def test_meetings_are_kept_though_actions_fail(unlucky: LoneAgent) -> None:
    """The place is reached by t_c as agreed, after step h or fewer."""
    reached = [(t, e) for t, e in unlucky.events if e.kind is REACHED][1:]
    assert len(reached) > 35
    short = 0
    for (time_s, event), held in zip(reached, unlucky.held, strict=False):
        assert time_s <= held.strategy.communication_s + 1e-6
        assert event.plan_index <= held.strategy.strategies[0].task_index
        short += event.plan_index < held.strategy.strategies[0].task_index
    assert short > 5


def test_steps_go_on_from_the_one_that_failed(unlucky: LoneAgent) -> None:
    """None is lost or done twice, and the next offer begins with it."""
    events = of_kind([event for _, event in unlucky.events], FINISHED, VISITED)
    assert [event.plan_index for event in events] == list(range(len(events)))
    ends = {FINISHED, VISITED}
    for message in unlucky.sent:
        if isinstance(message, PlanOffer):
            (own,) = message.offers
            done = sum(t <= own.arrival_s and e.kind in ends for t, e in unlucky.events)
            assert own.stops[0].task_index == done
