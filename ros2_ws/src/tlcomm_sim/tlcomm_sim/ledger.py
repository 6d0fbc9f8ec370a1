"""How much has been published, so that whoever is ticked can tell what is missing.

``Ledger``  counts since the start, of messages on recorded topics
"""

from collections.abc import Iterable, Sequence

from tlcomm_core.world.observation import Connectivity, Occupancy, Odometry, Reading
from tlcomm_sim.outputs import Output, Show, ShowClock, Tick

__all__ = ["Ledger"]


class Ledger:
    """How much has been published on recorded topics since the start."""

    def __init__(self, agents: Sequence[str]) -> None:
        """Begin with nothing."""
        self._odometry = dict.fromkeys(agents, 0)
        self._readings = dict.fromkeys(agents, 0)
        self._by_agents = dict.fromkeys(agents, 0)
        self._connectivity = 0
        self._clock = 0
        self._maps = 0

    @property
    def total(self) -> int:
        """Messages on recorded topics, by sim and agents."""
        by_agent = (self._odometry, self._readings, self._by_agents)
        own = self._connectivity + self._clock + self._maps
        return own + sum(sum(counts.values()) for counts in by_agent)

    def note(self, output: Output) -> None:
        """Count a publication of the sim."""
        match output:
            case ShowClock():
                self._clock += 1
            case Show(Odometry(agent=agent)):
                self._odometry[agent] += 1
            case Show(Connectivity()):
                self._connectivity += 1
            case Show(Occupancy()):
                self._maps += 1
            case Show(Reading(agent=agent)):
                self._readings[agent] += 1
            case _:
                pass

    def note_agent(self, agent: str, published: int) -> None:
        """Note how much an agent says it has published."""
        self._by_agents[agent] = published

    def agent_tick(
        self,
        agent: str,
        sequence: int,
        time_ns: int,
        arrived: Sequence[int],
        *,
        stop: bool = False,
    ) -> Tick:
        """Return a tick for an agent."""
        return Tick(
            sequence=sequence,
            time_ns=time_ns,
            odometry_count=self._odometry[agent],
            connectivity_count=self._connectivity,
            clock_count=self._clock,
            map_count=self._maps,
            reading_count=self._readings[agent],
            agent_counts=tuple(arrived),
            stop=stop,
        )

    def recorder_tick(
        self, sequence: int, time_ns: int, without: Iterable[Output] = (), *, stop: bool = False
    ) -> Tick:
        """Return a tick for the recorder.

        Args:
            sequence: its number.
            time_ns: the time up to which it counts.
            without: publications of the sim that have been noted already, and are later.
            stop: whether the run is over.
        """
        later = Ledger(tuple(self._by_agents))
        for output in without:
            later.note(output)
        return Tick(
            sequence=sequence,
            time_ns=time_ns,
            odometry_count=sum(self._odometry.values()) - sum(later._odometry.values()),
            connectivity_count=self._connectivity - later._connectivity,
            clock_count=self._clock - later._clock,
            map_count=self._maps - later._maps,
            reading_count=sum(self._readings.values()) - sum(later._readings.values()),
            agent_counts=tuple(self._by_agents.values()),
            stop=stop,
        )
