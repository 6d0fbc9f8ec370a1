"""Measuring what agreeing on a round takes."""

from dataclasses import dataclass, field

from support.hall import DURATION_S, PERIOD_S, STARTS, make_member
from tlcomm_core.agent.actions import SendMessage
from tlcomm_core.agent.timing import RoundTiming, TimedMember
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.messages import Message
from tlcomm_core.units import nanoseconds

LATENCY_NS = 5_000_000


@dataclass
class Clocks:
    """Clocks that go on by a tick whenever they are read; their readings tell the order."""

    steady_s: float = 0.0
    wall_s: float = 1000.0
    reads: list[float] = field(default_factory=list)

    def steady(self) -> float:
        """Read the stopwatch."""
        self.steady_s += 0.5
        return self.steady_s

    def wall(self) -> float:
        """Read the wall clock."""
        self.wall_s += 1.0
        self.reads.append(self.wall_s)
        return self.wall_s


@dataclass
class Timed:
    """A timed member at the meeting of round 0, everybody in range."""

    name: str
    clocks: Clocks = field(default_factory=Clocks)
    timings: list[RoundTiming] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Stand at the start."""
        self.member = make_member(self.name, 2)
        self.member.see_odometry(0, Pose(*STARTS[self.name]), 0.0, 0.0)
        self.member.see_neighbours(0, dict.fromkeys(STARTS.keys() - {self.name}, 1.0))
        self._timed = TimedMember(self.member, self.clocks.steady, self.clocks.wall)

    def step(self, now_ns: int) -> list[Message]:
        """Step; return what is said."""
        actions, timing = self._timed.step(now_ns)
        self.timings += [] if timing is None else [timing]
        return [action.message for action in actions if isinstance(action, SendMessage)]


def talk(one: Timed, two: Timed, begin: int, steps: int) -> None:
    """Let two members talk for a number of latencies."""
    for step in range(begin, begin + steps):
        now_ns = step * LATENCY_NS
        said = one.step(now_ns), two.step(now_ns)
        for messages, hearer in zip(said, (two, one), strict=True):
            for message in messages:
                hearer.member.receive(message, now_ns)


def test_a_round_is_timed_from_the_first_offer_to_the_agreement() -> None:
    """Once, by whoever agrees, with the computing of all steps in between."""
    one, two = Timed("one"), Timed("two")
    talk(one, two, 0, 30)
    (timing,) = one.timings
    assert (timing.agent, timing.round) == ("one", 1)
    assert timing.offered_wall_s == one.clocks.reads[0]
    assert timing.agreed_wall_s in one.clocks.reads
    assert timing.agreed_wall_s > timing.offered_wall_s
    # Each step takes half a second by the stopwatch, and one reading of the wall clock begins it;
    # only in the first and the last it doesn't solve: it offers, and hears the last confirmation.
    steps = one.clocks.reads.index(timing.agreed_wall_s)
    assert timing.solve_wall_s == 0.5 * (steps - 2)


def test_what_is_said_after_the_agreement_is_no_offer() -> None:
    """A confirmation still owed doesn't begin the next round's coordination."""
    one, two = Timed("one"), Timed("two")
    talk(one, two, 0, 30)
    assert one.timings
    confirmation = two.member._brain._meeting.negotiation._confirming.repetition()  # type: ignore[union-attr]
    fresh = type(confirmation)(
        confirmation.sender,
        confirmation.round,
        confirmation.iteration,
        confirmation.digest,
        ("two",),
    )
    one.member._brain._meeting.negotiation._confirming._flood._shown.clear()  # type: ignore[union-attr]
    one.member.receive(fresh, 30 * LATENCY_NS)
    assert one.step(31 * LATENCY_NS) != []
    assert one._timed._offered_wall_s is None


def test_steps_away_from_planning_are_not_counted() -> None:
    """Driving and acting is no solving."""
    one, two = Timed("one"), Timed("two")
    talk(one, two, 0, 30)
    for tenth in range(2, 30):
        one.step(tenth * 100_000_000)
    assert one._timed._solve_wall_s == 0.0


def test_a_team_of_one_is_timed_too() -> None:
    """It offers and agrees within a single step."""
    member, clocks = make_member("one", 1), Clocks()
    member.see_odometry(0, Pose(*STARTS["one"]), 0.0, 0.0)
    _, timing = TimedMember(member, clocks.steady, clocks.wall).step(0)
    assert timing == RoundTiming("one", 1, 0.5, 1001.0, 1002.0)


def test_a_meeting_without_agreement_counts_for_no_round() -> None:
    """The next round is timed from its own first offer."""
    one, two = Timed("one"), Timed("two")
    one.step(0)
    failed_ns = nanoseconds(PERIOD_S + DURATION_S)
    fallen_back = failed_ns // LATENCY_NS
    assert one.step(failed_ns) != []
    offered_wall_s = one.clocks.reads[-1]
    two.step(failed_ns)
    talk(one, two, fallen_back + 1, 30)
    (timing,) = one.timings
    assert timing.round == 2
    assert timing.offered_wall_s == offered_wall_s
