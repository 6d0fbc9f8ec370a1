"""What a run records.

``Topic``            a recorded topic
``recorded_topics``  all of them, for a team
``mirror_topics``    what the recorder adds for other people's viewers
``split_topic``      whose a topic is
``OPTIONAL_TOPICS``  those that bags from before them lack
``FIELD_TOPICS``     those that are there only if something is measured
"""

from collections.abc import Iterable
from dataclasses import dataclass

__all__ = [
    "AGENT_TOPICS",
    "FIELD_TOPICS",
    "OPTIONAL_TOPICS",
    "Topic",
    "mirror_topics",
    "recorded_topics",
    "split_topic",
]

AGENT_TOPICS = {
    "odom": "nav_msgs/msg/Odometry",
    "cmd_vel": "geometry_msgs/msg/TwistStamped",
    "task_event": "tlcomm_msgs/msg/TaskEvent",
    "team_strategy": "tlcomm_msgs/msg/TeamStrategy",
    "plan_offer": "tlcomm_msgs/msg/PlanOffer",
    "proposal": "tlcomm_msgs/msg/Proposal",
    "best_response": "tlcomm_msgs/msg/BestResponse",
    "confirmation": "tlcomm_msgs/msg/Confirmation",
    "estimate": "tlcomm_msgs/msg/Estimate",
    "round_timing": "tlcomm_msgs/msg/RoundTiming",
    "undelivered": "tlcomm_msgs/msg/Undelivered",
    "hearing": "tlcomm_msgs/msg/Hearing",
}
FIELD_TOPICS = {
    "reading": "tlcomm_msgs/msg/Reading",
    "estimate_exchange": "tlcomm_msgs/msg/EstimateExchange",
}
OPTIONAL_TOPICS = ("hearing",)
_LATCHED = "team_strategy"


@dataclass(frozen=True, slots=True)
class Topic:
    """A recorded topic.

    Attributes:
        name: absolute.
        type: as ``package/msg/Name``.
        agent: whose it is, or "" for the simulation's own.
        latched: whether it is offered transient local.
    """

    name: str
    type: str
    agent: str = ""
    latched: bool = False


def recorded_topics(agents: Iterable[str], *, measures: bool = False) -> tuple[Topic, ...]:
    """Return every topic that a run of these agents records; ``measures``: if there is a field."""
    suffixes = {**AGENT_TOPICS, **FIELD_TOPICS} if measures else AGENT_TOPICS
    own = [
        Topic("/clock", "rosgraph_msgs/msg/Clock"),
        Topic("/connectivity", "tlcomm_msgs/msg/Connectivity"),
        Topic("/map", "nav_msgs/msg/OccupancyGrid", latched=True),
    ]
    return (
        *own,
        *(
            Topic(f"/{agent}/{suffix}", type_name, agent, latched=suffix == _LATCHED)
            for agent in agents
            for suffix, type_name in suffixes.items()
        ),
    )


def mirror_topics(agents: Iterable[str]) -> tuple[Topic, ...]:
    """Return every topic that mirrors a run in standard messages."""
    markers = "visualization_msgs/msg/MarkerArray"
    return (
        Topic("/region_markers", markers, latched=True),
        Topic("/team_markers", markers),
        Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),
        *(
            Topic(f"/{agent}/{suffix}", "nav_msgs/msg/Path", agent)
            for agent in agents
            for suffix in ("plan", "trail")
        ),
    )


def split_topic(name: str) -> tuple[str, str]:
    """Return the agent whose topic it is, or "", and the topic's own name."""
    agent, _, suffix = name.removeprefix("/").rpartition("/")
    return agent, suffix
