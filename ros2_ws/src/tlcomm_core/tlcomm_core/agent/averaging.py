"""How agents in range of each other come to one estimate of what they measure.

``Averaging``  what both ways have in common
``Consensus``  weighted steps towards what neighbours say
``Exact``      the average of everybody's newest measurement
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from math import fsum
from typing import Final

from tlcomm_core.protocol.messages import EstimateExchange, Measurement

__all__ = ["Averaging", "Consensus", "Exact"]


class Averaging(ABC):
    """One agent's part in averaging; what it says and hears are ``EstimateExchange``."""

    def __init__(self, own: str) -> None:
        """Begin without any estimate.

        Args:
            own: the agent's name.
        """
        self._own: Final = own

    @property
    @abstractmethod
    def estimate(self) -> float | None:
        """What the agent takes the field to be; ``None`` while it knows nothing of it."""

    @property
    def known(self) -> tuple[Measurement, ...]:
        """The measurements to be passed on, sorted by agent."""
        return ()

    @abstractmethod
    def measure(self, value: float, time_ns: int) -> None:
        """Take in what the agent has measured itself."""

    @abstractmethod
    def moving(
        self, said: EstimateExchange | None, heard: Iterable[EstimateExchange]
    ) -> tuple[EstimateExchange, ...]:
        """Return what is heard and would change anything; the arguments are an exchange's."""

    @abstractmethod
    def exchange(self, said: EstimateExchange | None, heard: Sequence[EstimateExchange]) -> None:
        """Take a step.

        Args:
            said: what the agent itself said last; ``None`` if it had nothing to say.
            heard: what each neighbour said last.
        """


class Consensus(Averaging):
    """Steps towards what neighbours say, x_i ← x_i + Σ_j ε_ij (x_j − x_i), and by readings.

    An agent's first reading is its estimate. A later one shifts the estimate by what it differs
    from the one before, x_i ← x_i + (u_i' − u_i). What an agent without a reading takes over from
    those that it hears counts as one. So the sum of all estimates is that of all newest
    readings: the team follows their average, though each goes on measuring at its own station, and
    what that station's own error is cancels out once and for all. Were the reading to take the
    estimate's place, each measurement would throw away what the team has come to.

    The sum is over neighbours whose values differ by more than a tolerance, so it is the protocol
    on the graph of these links alone, and comes to rest: where it changes anything, it lessens
    Σ x_i² by at least a fixed amount. Then neighbours agree to the tolerance, and nothing more need
    be said.

    ε_ij is the given step, or 1 / (1 + the larger of both agents' numbers of neighbours): what
    ε = 1 / (Δ + 1) is where Δ is known, from what the two ends of a link know. Either is the same
    at both ends, and the x are those that both have said and heard; so what one gains the other
    loses, and the sum of all estimates stays. That needs what is said to be heard. After a loss an
    end steps towards an older value than it should, or not at all, and the sum shifts by that much,
    for good. But the weights of a step always sum up to less than 1, so no step leads out of the
    span of the values around, and agreement comes all the same.

    Source: R. Olfati-Saber, J. A. Fax and R. M. Murray, "Consensus and Cooperation in Networked
        Multi-Agent Systems", Proc. IEEE 95(1), 2007, Theorem 2: average consensus for ε < 1/Δ on a
        connected undirected graph, Δ its largest number of neighbours. The local weights are the
        Metropolis weights of L. Xiao, S. Boyd and S. Lall, "A Scheme for Robust Distributed Sensor
        Fusion Based on Average Consensus", IPSN 2005. Readings: M. Zhu and S. Martínez,
        "Discrete-time Dynamic Average Consensus", Automatica 46(2), 2010, first order; after
        D. P. Spanos, R. Olfati-Saber and R. M. Murray, "Dynamic Consensus on Mobile Networks",
        IFAC World Congress 2005.
    Deviates: differences within the tolerance count as none. Agents that have no value yet take the
        mean of what they hear.
    """

    def __init__(self, own: str, step: float | None, tolerance: float) -> None:
        """Begin without any estimate.

        Args:
            own: the agent's name.
            step: ε, below 1/(N − 1); ``None``: of each link, by the neighbours of its ends.
            tolerance: the difference of neighbours' values that is left as it is.
        """
        super().__init__(own)
        self._step: Final = step
        self._tolerance: Final = tolerance
        self._estimate: float | None = None
        self._reading: float | None = None

    @property
    def estimate(self) -> float | None:
        """x_i."""
        return self._estimate

    def measure(self, value: float, time_ns: int) -> None:
        """Shift the estimate by what a measurement differs from the last; the first replaces it."""
        del time_ns
        before, self._reading = self._reading, value
        if self._estimate is None or before is None:
            self._estimate = value
        else:
            self._estimate += value - before

    def moving(
        self, said: EstimateExchange | None, heard: Iterable[EstimateExchange]
    ) -> tuple[EstimateExchange, ...]:
        """Return the words whose value is further off than the tolerance."""
        if said is None:
            return tuple(heard) if self._estimate is None else ()
        return tuple(word for word in heard if abs(word.value - said.value) > self._tolerance)

    def exchange(self, said: EstimateExchange | None, heard: Sequence[EstimateExchange]) -> None:
        """Step towards what neighbours said, from what they were told."""
        if self._estimate is None:
            if heard:
                self._estimate = fsum(word.value for word in heard) / len(heard)
                self._reading = self._estimate
        elif said is not None:
            # Exactly rounded, so that the order of neighbours doesn't matter.
            self._estimate += fsum(
                self._weight(said, word) * (word.value - said.value)
                for word in self.moving(said, heard)
            )

    def _weight(self, said: EstimateExchange, word: EstimateExchange) -> float:
        if self._step is not None:
            return self._step
        return 1.0 / (1 + max(said.neighbours, word.neighbours))


class Exact(Averaging):
    """The average of the newest measurement of every member that the agent knows of.

    Measurements are flooded: whoever learns a newer one passes it on. So in a connected team all
    know everybody's after as many exchanges as the graph's diameter, and their estimates are equal
    to the bit. What is lost on all ways is missing until more is said.
    """

    def __init__(self, own: str) -> None:
        """Begin without any measurement."""
        super().__init__(own)
        self._newest: dict[str, Measurement] = {}

    @property
    def estimate(self) -> float | None:
        """The average."""
        if not self._newest:
            return None
        return fsum(each.value for each in self._newest.values()) / len(self._newest)

    @property
    def known(self) -> tuple[Measurement, ...]:
        """Each member's newest measurement, as far as it is known."""
        return tuple(self._newest[agent] for agent in sorted(self._newest))

    def measure(self, value: float, time_ns: int) -> None:
        """Take in the agent's own newest measurement."""
        self._newest[self._own] = Measurement(self._own, value, time_ns)

    def moving(
        self, said: EstimateExchange | None, heard: Iterable[EstimateExchange]
    ) -> tuple[EstimateExchange, ...]:
        """Return the words that tell of a newer measurement."""
        del said
        return tuple(word for word in heard if any(map(self._is_news, word.known)))

    def exchange(self, said: EstimateExchange | None, heard: Sequence[EstimateExchange]) -> None:
        """Take over what is newer."""
        del said
        for word in heard:
            for each in word.known:
                if self._is_news(each):
                    self._newest[each.agent] = each

    def _is_news(self, measurement: Measurement) -> bool:
        held = self._newest.get(measurement.agent)
        if measurement.agent == self._own:
            return False
        return held is None or measurement.time_ns > held.time_ns
