"""A hall with up to three agents whose plans are easy to follow by hand, and one agent alone.

``hall``         the scenario
``make_member``  one of its members
``LoneAgent``    a brain on an ideal vehicle, with whatever it is told
``under_way``    one on its way
``two_agents``   two at their first meeting
``exchange``     what they say to each other there
``of_kind``      some of an agent's events
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

from tlcomm_core.agent.actions import (
    Action,
    Drive,
    HoldStrategy,
    ReportTask,
    SendMessage,
    TaskEvent,
    TaskEventKind,
)
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.events import MessageHeard, OdometryReceived, TimePassed
from tlcomm_core.agent.member import Member, create
from tlcomm_core.game.solver import BEST_RESPONSE
from tlcomm_core.geometry import Pose
from tlcomm_core.method import Method
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.protocol.messages import Message, PlanOffer
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Faults
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.world.unicycle import integrate

__all__ = [
    "DURATION_S",
    "PERIOD_S",
    "STARTS",
    "LoneAgent",
    "exchange",
    "hall",
    "make_member",
    "of_kind",
    "two_agents",
    "under_way",
]

PERIOD_S, DURATION_S = 30.0, 3.0
STARTS = {"one": (2.75, 0.75, 0.0), "two": (3.25, 0.75, 0.0), "three": (3.75, 0.75, 0.0)}
_TEXT = """\
name: hall
workspace:
  size_m: [6.0, 2.0]
  cell_m: 0.5
  regions:
    a: {at_m: [0.75, 0.75], radius_m: 0.3}
    b: {at_m: [5.25, 0.75], radius_m: 0.3}
communication: {range_m: 1.0, period_s: 30.0, duration_s: 3.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 4.0, place: 2.0}
agents:
"""
_TASK = "G F ((a & pick) & F (b & place))"


def hall(count: int, faults: Faults | None = None) -> Site:
    """Return the hall with so many agents, side by side; all have the same task."""
    agents = [
        f'  {name}: {{start: {list(start)}, task: "{_TASK}"}}\n'
        for name, start in list(STARTS.items())[:count]
    ]
    scenario = loads(_TEXT + "".join(agents))
    return Site.from_scenario(scenario.model_copy(update={"faults": faults or Faults()}))


def make_member(
    name: str, count: int, pacing: Pacing = Pacing.EVENT, faults: Faults | None = None
) -> Member:
    """Return a member of the hall's team."""
    site = hall(count, faults)
    return create(name, site, pacing, Atlas(site.grid))


@dataclass
class LoneAgent:
    """A brain on a vehicle that does what it is told, to the bit.

    Attributes:
        site: where it is, unless that is the hall with ``count`` agents.
        method: of coordination.
        done: all actions with their times, in order.
    """

    name: str
    count: int
    faults: Faults | None = None
    site: Site | None = None
    method: Method = Method.TEAM
    now_s: float = 0.0
    done: list[tuple[float, Action]] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Stand at the start, and see it."""
        site = self.site or hall(self.count, self.faults)
        atlas = Atlas(site.grid, site.region_discs)
        self.member = create(
            self.name, site, Pacing.EVENT, atlas, solver=BEST_RESPONSE, method=self.method
        )
        self.brain = self.member._brain
        self.pose = Pose(*STARTS[self.name])
        self.velocity = Drive(0.0, 0.0)
        self._show_odometry()

    @property
    def sent(self) -> list[Message]:
        """All messages so far."""
        return [action.message for _, action in self.done if isinstance(action, SendMessage)]

    @property
    def events(self) -> list[tuple[float, TaskEvent]]:
        """All task events so far, with their times."""
        return [(t, action.event) for t, action in self.done if isinstance(action, ReportTask)]

    @property
    def held(self) -> list[HoldStrategy]:
        """All strategies held so far."""
        return [action for _, action in self.done if isinstance(action, HoldStrategy)]

    def times_s(self, kind: TaskEventKind) -> list[float]:
        """Return when events of a kind happened."""
        return [t for t, event in self.events if event.kind is kind]

    def hear(self, messages: Iterable[Message]) -> None:
        """Hear messages now, then let the brain act."""
        for message in messages:
            self._take(self.brain.handle(MessageHeard(message), self.now_s))
        self.act()

    def change_task(self, task: str) -> LocalPlan:
        """Give it another task now; return the plan."""
        return self.member.change_task(task, nanoseconds(self.now_s))

    def show_map(self, *boxes: Box) -> None:
        """Show it from now on a map with only these obstacles, and let it act."""
        grid = self.brain.travel.grid
        now_ns = nanoseconds(self.now_s)
        self.member.see_map(now_ns, Grid(grid.size_m, grid.cell_m, boxes).free)
        self._take(self.member.step(now_ns))

    def put(self, pose: Pose) -> None:
        """Displace the vehicle, and show it; its velocity stays."""
        self.pose = pose
        self._show_odometry()

    def act(self) -> None:
        """Let the brain do what is due."""
        self._take(self.brain.handle(TimePassed(), self.now_s))

    def advance_to(self, time_s: float) -> None:
        """Let time pass; the brain acts whenever it asked to."""
        while self.brain.next_need_s <= time_s:
            assert self.brain.next_need_s > self.now_s, "it asked for a time that has passed"
            self._go_to(self.brain.next_need_s)
            self.act()
        self._go_to(time_s)

    def _go_to(self, time_s: float) -> None:
        speeds = (self.velocity.linear_mps, self.velocity.angular_radps)
        self.pose = integrate(self.pose, *speeds, time_s - self.now_s)
        self.now_s = time_s

    def _take(self, actions: Iterable[Action]) -> None:
        for action in actions:
            self.done.append((self.now_s, action))
            if isinstance(action, Drive):
                self.velocity = action
        self._show_odometry()

    def _show_odometry(self) -> None:
        velocity = self.velocity
        odometry = OdometryReceived(
            self.now_s, self.pose, velocity.linear_mps, velocity.angular_radps
        )
        actions = self.brain.handle(odometry, self.now_s)
        self.done += [(self.now_s, action) for action in actions]


def under_way(time_s: float = 10.0) -> LoneAgent:
    """Return a team of one on its way."""
    agent = LoneAgent("one", 1)
    agent.act()
    agent.advance_to(time_s)
    return agent


def two_agents() -> tuple[LoneAgent, LoneAgent]:
    """Return both agents of a team of two, at the meeting of round 0."""
    one, two = LoneAgent("one", 2), LoneAgent("two", 2)
    one.act()
    two.act()
    return one, two


def exchange(one: LoneAgent, two: LoneAgent, time_s: float, *, is_silent: bool = False) -> int:
    """Let the two talk at a time until nothing new is said; return how much was said.

    With ``is_silent`` the second hears, and is heard with offers only.
    """
    marks = [0, 0]
    one.advance_to(time_s)
    two.advance_to(time_s)
    while marks != [len(one.sent), len(two.sent)]:
        from_one, from_two = one.sent[marks[0] :], two.sent[marks[1] :]
        marks = [len(one.sent), len(two.sent)]
        two.hear(from_one)
        one.hear([m for m in from_two if isinstance(m, PlanOffer) or not is_silent])
    return sum(marks)


def of_kind(events: list[TaskEvent], *kinds: TaskEventKind) -> list[TaskEvent]:
    """Return the events of some kinds."""
    return [event for event in events if event.kind in kinds]
