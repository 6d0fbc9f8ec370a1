"""The scenario's fields, their types and ranges, one class per section of the file.

``Scenario`` holds ``Workspace`` (with ``Region`` and ``Change``), ``Communication``, ``Drive``,
``Noise``, ``Faults``, ``Radio``, ``MeasuredField`` (with ``Drift`` and ``Exchange``), ``Action``
and ``Agent`` (with ``DriveOverride`` and ``Soft``).
What fields mean together is checked in ``checks``.
"""

from typing import Annotated, Final, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

__all__ = [
    "ACTION_FORMS",
    "MAX_AGENTS",
    "MAX_OBSTACLES",
    "MAX_TASKS",
    "Action",
    "Agent",
    "AnyAction",
    "Change",
    "Communication",
    "Drift",
    "Drive",
    "DriveOverride",
    "Exchange",
    "Faults",
    "MeasuredField",
    "Noise",
    "Radio",
    "Region",
    "Scenario",
    "Soft",
    "Workspace",
]

MAX_AGENTS: Final = 1000
MAX_OBSTACLES: Final = 5000
MAX_REGIONS: Final = 1000
MAX_CHANGES: Final = 100
MAX_TASKS: Final = 100
MAX_BREAKPOINTS: Final = 10_000

# Far beyond any plant, and small enough that no product of two overflows.
_HUGE: Final = 1e9

Number = Annotated[float, Field(ge=-_HUGE, le=_HUGE)]
Positive = Annotated[float, Field(gt=0.0, le=_HUGE)]
# Slower agents would take longer than any run for a single cell.
Speed = Annotated[float, Field(ge=1e-3, le=1e3)]
NotNegative = Annotated[float, Field(ge=0.0, le=_HUGE)]
# A day and more for one atom is beyond any detour, and sums of such prices are exact.
Price = Annotated[float, Field(ge=0.0, le=1e5)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]
Obstacles = Annotated[
    tuple[tuple[Number, Number, Number, Number], ...], Field(max_length=MAX_OBSTACLES)
]
# Valid as a ROS namespace token and as an atom.
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*$", max_length=60)]
Title = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]*$", max_length=60)]


class _Section(BaseModel):
    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False)


class Region(_Section):
    """A disc in which actions can be performed."""

    at_m: tuple[Number, Number]
    radius_m: Positive


class Change(_Section):
    """Obstacles that from a time on take the place of those before."""

    at_s: Positive
    obstacles_m: Obstacles


class Workspace(_Section):
    """The rectangle, its cells, obstacles (x_min, y_min, x_max, y_max), regions and changes."""

    size_m: tuple[Positive, Positive]
    cell_m: Positive
    origin_m: tuple[Number, Number] = (0.0, 0.0)
    obstacles_m: Obstacles = ()
    regions: Annotated[dict[Name, Region], Field(min_length=1, max_length=MAX_REGIONS)]
    changes: Annotated[tuple[Change, ...], Field(max_length=MAX_CHANGES)] = ()


class Communication(_Section):
    """When and how the team meets.

    Attributes:
        range_m: radio range R.
        period_s: T_c.
        duration_s: D_c.
        hop_latency_s: from sending a message to its arrival, in lock step.
        separation_m: the least distance between two agents' places at a planned meeting.
        resilience: how many agents may fail so that the others still are connected.
        margin_s: how long before its window's end a meeting begins at the latest.
        on_infeasible: what the team does when nobody can plan a meeting in the next window.
    """

    range_m: Positive
    period_s: Positive
    duration_s: Positive
    hop_latency_s: Positive = 0.005
    separation_m: NotNegative = 0.0
    resilience: Annotated[int, Field(ge=0, le=1)] = 0
    margin_s: NotNegative = 0.001
    on_infeasible: Literal["wait", "skip", "stop"] = "wait"


class Radio(_Section):
    """How good the links between neighbours are; by default nothing is lost or late.

    Attributes:
        loss: probability that a neighbour misses a message.
        loss_at_range: the same at the distance R, linear in between from ``loss`` at distance 0;
            ``loss`` at any distance if not given.
        jitter_s: what is added to a message's latency, at random: uniform from 0 to this.
        duplication: probability that a message that is heard is heard twice.
        bandwidth_bps: how many bits a second one agent gets through to another; no limit if not
            given.
        line_of_sight: whether agents hear each other only if no obstacle is between them.
    """

    loss: Share = 0.0
    loss_at_range: Share | None = None
    jitter_s: NotNegative = 0.0
    duplication: Share = 0.0
    bandwidth_bps: Positive | None = None
    line_of_sight: bool = False


class Drive(_Section):
    """Speeds of an agent, and how close to a point its controller comes."""

    linear_mps: Speed
    angular_radps: Speed
    position_tolerance_m: Positive = 0.02


class DriveOverride(_Section):
    """What one agent's drive has different from the team's."""

    linear_mps: Speed | None = None
    angular_radps: Speed | None = None
    position_tolerance_m: Positive | None = None


class Noise(_Section):
    """Standard deviations of the seeded factors (around 1) on an agent's actual speeds."""

    linear: Share = 0.0
    angular: Share = 0.0


class Faults(_Section):
    """What goes wrong: the share of attempts at actions that fail, and how often to begin anew."""

    action_failure: Share = 0.0
    retries: Annotated[int, Field(ge=0, le=1000)] = 3


class Drift(_Section):
    """What a station reads beside the field: amplitude · sin(frequency · t + the station's phase).

    ``phases_rad`` names the stations; if not given, they are all regions in which the action is
    possible, with phases spread evenly over them.
    """

    amplitude: NotNegative = 0.0
    frequency_radps: NotNegative = 0.0
    phases_rad: Annotated[dict[Name, Number], Field(min_length=1)] | None = None


class Exchange(_Section):
    """How agents in range of each other come to one estimate.

    Attributes:
        mode: by consensus, or by flooding what was measured and taking the exact average.
        period_s: exchanges are at its multiples.
        step: ε of the consensus; chosen by the number of neighbours if not given.
        tolerance: neighbours whose estimates are no further apart exchange nothing.
    """

    mode: Literal["consensus", "exact"] = "consensus"
    period_s: Annotated[float, Field(ge=1e-3, le=_HUGE)] = 0.1
    step: Positive | None = None
    tolerance: Annotated[float, Field(ge=1e-6, le=_HUGE)] = 0.01


class MeasuredField(_Section):
    """What agents measure: a value over time that is the same everywhere, up to a drift.

    Attributes:
        action: that reads it.
        profile: ν as (time s, value): linear in between, constant before and after.
        drift: of the stations.
        noise: standard deviation of each reading.
        exchange: of estimates.
    """

    action: Name
    profile: Annotated[
        tuple[tuple[NotNegative, Number], ...], Field(min_length=1, max_length=MAX_BREAKPOINTS)
    ]
    drift: Drift = Drift()
    noise: NotNegative = 0.0
    exchange: Exchange = Exchange()


class Action(_Section):
    """How long an action takes, where it is possible, and after which others.

    It is possible in the regions ``at`` only, if any are given, and only when each of the actions
    ``after`` has been performed since it was last performed itself.
    """

    duration_s: NotNegative
    at: Annotated[tuple[Name, ...], Field(min_length=1, max_length=MAX_REGIONS)] | None = None
    after: Annotated[tuple[Name, ...], Field(max_length=MAX_REGIONS)] = ()


ACTION_FORMS: Final = ("[duration]", "[action]")
"""What the two forms of an action are called in places of validation errors."""


def _action_form(value: object) -> str:
    return ACTION_FORMS[isinstance(value, dict | Action)]


# A number is a duration: most actions need nothing first.
AnyAction = Annotated[
    Annotated[NotNegative, Tag(ACTION_FORMS[0])] | Annotated[Action, Tag(ACTION_FORMS[1])],
    Discriminator(_action_form),
]
Actions = Annotated[dict[Name, AnyAction], Field(max_length=MAX_REGIONS)]


class Soft(_Section):
    """A task to be satisfied as much as possible, and the price of each atom that violates it."""

    task: str
    weight_s: Price


class Agent(_Section):
    """Where an agent starts (x, y, yaw), its tasks, and what it has different from the team.

    The task and each of the tasks must be satisfied, all of them together. An automaton, as text
    in HOA v1, may be given in place of both.
    """

    start: tuple[Number, Number, Number]
    task: str | None = None
    automaton: str | None = None
    tasks: Annotated[tuple[str, ...], Field(max_length=MAX_TASKS)] = ()
    soft: Soft | None = None
    motion: DriveOverride = DriveOverride()
    actions: Actions = {}

    @property
    def hard_tasks(self) -> tuple[str, ...]:
        """The task and the tasks, those that there are."""
        return self.tasks if self.task is None else (self.task, *self.tasks)

    @property
    def whole_task(self) -> str:
        """All that must be satisfied, as one formula; ``true`` beside an automaton."""
        parts = self.hard_tasks or ("true",)
        return parts[0] if len(parts) == 1 else " & ".join(f"({part})" for part in parts)


class Scenario(_Section):
    """A whole scenario file."""

    name: Title
    workspace: Workspace
    communication: Communication
    motion: Drive
    noise: Noise = Noise()
    faults: Faults = Faults()
    radio: Radio = Radio()
    actions: Actions = {}
    field: MeasuredField | None = None
    agents: Annotated[dict[Name, Agent], Field(min_length=1, max_length=MAX_AGENTS)]

    def drive_of(self, agent: str) -> Drive:
        """Return the drive of an agent, its own fields over the team's."""
        own = self.agents[agent].motion.model_dump(exclude_none=True)
        return self.motion.model_copy(update=own)

    def actions_of(self, agent: str) -> dict[str, float]:
        """Return the durations (s) of an agent's actions, its own over the team's."""
        return {
            name: action.duration_s if isinstance(action, Action) else action
            for name, action in (self.actions | self.agents[agent].actions).items()
        }

    def conditional_actions_of(self, agent: str) -> dict[str, Action]:
        """Return those of an agent's actions that are given with more than a duration."""
        actions = self.actions | self.agents[agent].actions
        return {name: action for name, action in actions.items() if isinstance(action, Action)}

    @property
    def position_tolerance_m(self) -> float:
        """The largest of the agents' position tolerances."""
        return max(self.drive_of(name).position_tolerance_m for name in self.agents)
