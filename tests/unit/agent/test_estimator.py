"""When agents exchange what they take the field to be, and when they are silent."""

import pytest

from support.estimating_team import ACTION, LATENCY_NS, PERIOD_NS, EstimatingTeam
from support.good_scenario import GOOD
from tlcomm_core.agent.actions import (
    Action,
    CountIgnored,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    TaskEvent,
    TaskEventKind,
)
from tlcomm_core.agent.averaging import Consensus, Exact
from tlcomm_core.agent.estimator import Estimator, create_estimator
from tlcomm_core.protocol.messages import EstimateExchange, Measurement
from tlcomm_core.scenario.loader import loads

FIELD = "field: {action: pick, profile: [[0, 40.0]], exchange: {mode: MODE}}\n"


def alone() -> Estimator:
    """Return the estimator of a member of a team of three."""
    return Estimator("a", "abc", Consensus("a", None, 0.01), PERIOD_NS, ACTION)


def ended(kind: TaskEventKind, action: str) -> Action:
    """Return the report of something done at m1."""
    return ReportTask(TaskEvent(kind, "m1", action, 0, 0))


def test_an_agent_that_knows_nothing_has_nothing_to_do() -> None:
    """Not even with neighbours."""
    estimator = alone()
    estimator.see_neighbours(0, "bc")
    assert estimator.proceed(0) == ()
    assert estimator.next_need_ns is None


def test_a_reading_is_the_estimate_at_once() -> None:
    """It is reported once, with the measurement that it is, and again if it is measured again."""
    estimator = alone()
    estimator.read(5.0, 7)
    assert estimator.proceed(7) == (ReportEstimate(5.0, 5.0),)
    assert estimator.proceed(7) == ()
    estimator.read(5.0, 8)
    assert estimator.proceed(8) == (ReportEstimate(5.0, 5.0),)
    assert estimator.next_need_ns is None


def test_an_estimate_is_said_at_the_next_multiple_of_the_period() -> None:
    """If there is anybody to hear it; once."""
    estimator = alone()
    estimator.read(5.0, 7)
    estimator.proceed(7)
    estimator.see_neighbours(2 * PERIOD_NS + 1, "b")
    assert estimator.proceed(2 * PERIOD_NS + 1) == ()
    assert estimator.next_need_ns == 3 * PERIOD_NS
    word = EstimateExchange("a", 3, 1, False, 5.0)
    assert estimator.proceed(3 * PERIOD_NS) == (SayEstimate(word),)
    assert estimator.next_need_ns is None
    assert estimator.proceed(4 * PERIOD_NS) == ()


def test_who_comes_into_range_at_an_exchange_is_told_in_it() -> None:
    """Since it sees that before it acts."""
    estimator = alone()
    estimator.read(5.0, 0)
    estimator.see_neighbours(PERIOD_NS, "b")
    (said, _) = estimator.proceed(PERIOD_NS)
    assert said == SayEstimate(EstimateExchange("a", 1, 1, False, 5.0))


def test_a_late_call_exchanges_once() -> None:
    """Running freely, an agent may sleep through several multiples of the period."""
    estimator = alone()
    estimator.read(5.0, 0)
    estimator.see_neighbours(1, "b")
    estimator.proceed(1)
    (said,) = estimator.proceed(7 * PERIOD_NS + 3)
    assert said == SayEstimate(EstimateExchange("a", 7, 1, False, 5.0))


@pytest.mark.parametrize(
    ("word", "reason"),
    [
        (EstimateExchange("z", 0, 1, False, 1.0), "foreign"),
        (EstimateExchange("a", 0, 1, False, 1.0), "foreign"),
        (EstimateExchange("c", 0, 1, False, 1.0), "late"),
        (EstimateExchange("b", 9, 1, False, 1.0), "early"),
        (EstimateExchange("b", 0, 1, False, 1.0, (Measurement("z", 1.0, 0),)), "malformed"),
    ],
)
def test_what_can_t_be_used_is_counted(word: EstimateExchange, reason: str) -> None:
    """From nobody of the team, from who is no neighbour any more, or of a time to come."""
    estimator = alone()
    estimator.see_neighbours(0, "b")
    assert estimator.hear(word, LATENCY_NS) == (CountIgnored(reason),)
    assert estimator.proceed(LATENCY_NS) == ()
    assert estimator.next_need_ns is None


def test_what_is_heard_twice_or_overtaken_counts_once() -> None:
    """The newest word of a neighbour stands."""
    estimator = alone()
    estimator.see_neighbours(0, "b")
    old, new = (EstimateExchange("b", step, 1, False, 10.0 * step) for step in (1, 2))
    now_ns = 2 * PERIOD_NS + LATENCY_NS
    assert estimator.hear(new, now_ns) == ()
    assert estimator.hear(new, now_ns) == estimator.hear(old, now_ns) == (CountIgnored("late"),)
    estimator.proceed(now_ns)
    (said, reported) = estimator.proceed(3 * PERIOD_NS)
    assert said == SayEstimate(EstimateExchange("a", 3, 1, False, 20.0))
    assert reported == ReportEstimate(20.0, None)


def test_a_step_uses_only_what_was_said_before_it() -> None:
    """A word of the same exchange, heard in time by chance, waits for the next."""
    estimator = alone()
    estimator.read(10.0, 0)
    estimator.see_neighbours(0, "b")
    estimator.proceed(0)
    estimator.hear(EstimateExchange("b", 1, 1, False, 20.0), PERIOD_NS)
    estimator.hear(EstimateExchange("b", 0, 1, False, 14.0), PERIOD_NS)
    assert estimator.proceed(PERIOD_NS) == ()
    (said, _) = estimator.proceed(2 * PERIOD_NS)
    assert said == SayEstimate(EstimateExchange("a", 2, 1, False, 15.0))


def test_a_neighbour_s_word_waits_until_it_has_been_answered() -> None:
    """Who acts late says first what it has: the other can't have reckoned with that yet."""
    estimator = alone()
    estimator.read(10.0, 0)
    estimator.see_neighbours(0, "c")
    estimator.proceed(0)
    estimator.see_neighbours(PERIOD_NS + 1, "bc")
    estimator.hear(EstimateExchange("b", 2, 3, False, 20.0), 2 * PERIOD_NS + LATENCY_NS)
    (said,) = estimator.proceed(3 * PERIOD_NS)
    assert said == SayEstimate(EstimateExchange("a", 3, 2, False, 10.0))
    (said, _) = estimator.proceed(4 * PERIOD_NS)
    assert said == SayEstimate(EstimateExchange("a", 4, 2, False, 12.5))


def test_two_that_meet_agree_and_are_silent() -> None:
    """Each says what it has, then the middle; then nothing."""
    team = EstimatingTeam("ab")
    team.read({"a": 1.0, "b": 2.0})
    team.link(["ab"])
    team.run()
    assert team.values == {"a": 1.5, "b": 1.5}
    assert team.said == 4
    for _ in range(5):
        team.exchange()
    assert team.said == 4


def test_two_that_agree_already_say_so_once() -> None:
    """A new neighbour is told, whatever it thinks."""
    team = EstimatingTeam("ab")
    team.read({"a": 1.0, "b": 1.005})
    team.link(["ab"])
    team.run()
    assert team.said == 2
    assert team.values == {"a": 1.0, "b": 1.005}


def test_what_was_lost_is_asked_for_and_repeated() -> None:
    """Of two that have each other's first word, one misses the second, and the third."""
    lost = {(2, "b", "a"), (3, "b", "a")}
    team = EstimatingTeam("ab", is_heard=lambda *what: what not in lost)
    team.read({"a": 1.0, "b": 2.0})
    team.link(["ab"])
    team.run()
    assert team.asked > 0
    assert abs(team.values["a"] - team.values["b"]) <= 0.01


def test_a_link_that_comes_again_begins_anew() -> None:
    """What was heard before it broke counts no more."""
    team = EstimatingTeam("ab")
    team.read({"a": 1.0, "b": 2.0})
    team.link(["ab"])
    team.run()
    team.link([])
    team.read({"a": 4.0})
    team.link(["ab"])
    team.run()
    assert team.values == {"a": 3.0, "b": 3.0}


def test_a_reading_in_a_silent_team_is_spread() -> None:
    """It shifts the estimate, and the sum of all changes by just that."""
    team = EstimatingTeam("abc")
    team.read({"a": 3.0, "b": 3.0, "c": 3.0})
    team.link(["ab", "bc"])
    team.run()
    team.read({"a": 6.0})
    team.run()
    assert sum(team.values.values()) == pytest.approx(12.0)
    assert max(team.values.values()) - min(team.values.values()) < 0.03


def test_who_has_nothing_adopts_what_it_hears_and_passes_it_on() -> None:
    """Through the whole team; nobody reports an estimate before it has one."""
    team = EstimatingTeam("abc")
    team.read({"a": 3.0})
    team.link(["ab", "bc"])
    team.run()
    assert team.values == {"a": 3.0, "b": 3.0, "c": 3.0}
    assert team.history["c"] == [3.0]


def test_flooding_makes_all_estimates_the_exact_average() -> None:
    """Equal to the bit, after as many exchanges as the graph's diameter and one to begin with."""
    team = EstimatingTeam("abcd", Exact)
    team.read({"a": 0.1, "b": 0.2, "c": 0.4})
    team.link(["ab", "bc", "cd"])
    assert team.run() <= 5
    assert set(team.values.values()) == {(0.1 + 0.2 + 0.4) / 3.0}
    assert len(team.values) == 4


def test_the_region_of_an_ended_measurement_is_told() -> None:
    """Only of the action that reads the field, and only of its end."""
    estimator = alone()
    assert estimator.measured_at(()) == ""
    begun = ended(TaskEventKind.ACTION_STARTED, ACTION)
    other = ended(TaskEventKind.ACTION_FINISHED, "collect")
    assert estimator.measured_at((begun, other)) == ""
    assert estimator.measured_at((begun, ended(TaskEventKind.ACTION_FINISHED, ACTION))) == "m1"


def test_a_scenario_without_a_field_has_no_estimator() -> None:
    """With one it has, of the way that the scenario names."""
    assert create_estimator("one", loads(GOOD), ("one", "two")) is None
    for mode, kind in (("consensus", Consensus), ("exact", Exact)):
        scenario = loads(GOOD + FIELD.replace("MODE", mode))
        estimator = create_estimator("one", scenario, scenario.agents)
        assert estimator is not None
        assert isinstance(estimator._averaging, kind)


def test_who_exchanges_with_nobody_sees_no_neighbours() -> None:
    """A method without communication has readings, and no more."""
    scenario = loads(GOOD + FIELD.replace("MODE", "consensus"))
    estimator = create_estimator("one", scenario, ())
    assert estimator is not None
    estimator.see_neighbours(0, ["two"])
    estimator.read(3.0, 0)
    assert estimator.proceed(0) == (ReportEstimate(3.0, 3.0),)
    assert estimator.next_need_ns is None
