"""What a comparison can vary from one point of a figure to the next.

``Sweep``        a quantity and its values
``QUANTITIES``   what can be varied, with how it changes a scenario
``parse_sweep``  NAME=V1,V2,…
``shown``        a value as it was given
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from pydantic import ValidationError

from tlcomm_core.errors import InputError
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.model import Scenario

__all__ = ["QUANTITIES", "Quantity", "Sweep", "parse_sweep", "shown"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """What can be varied.

    Attributes:
        label: with its unit, for people.
        apply: returns the scenario with another value of it, not yet checked.
        is_count: whether its values are whole numbers.
    """

    label: str
    apply: Callable[[Scenario, float], Scenario]
    is_count: bool = False


def _with_agents(scenario: Scenario, value: float) -> Scenario:
    names = list(scenario.agents)[: int(value)]
    if len(names) < value:
        raise InputError(f"scenario {scenario.name!r} has no more than {len(names)} of them")
    return scenario.model_copy(update={"agents": {name: scenario.agents[name] for name in names}})


def _field(section: str, field: str) -> Callable[[Scenario, float], Scenario]:
    """Return what changes one field of a section."""

    def apply(scenario: Scenario, value: float) -> Scenario:
        before = getattr(scenario, section)
        try:
            changed = type(before).model_validate(before.model_dump() | {field: value})
        except ValidationError as error:
            raise InputError(
                error.errors()[0]["msg"].replace("Input should", "it should")
            ) from None
        return scenario.model_copy(update={section: changed})

    return apply


QUANTITIES: Final[Mapping[str, Quantity]] = MappingProxyType(
    {
        "agents": Quantity("agents", _with_agents, is_count=True),
        "range": Quantity("radio range R (m)", _field("communication", "range_m")),
        "period": Quantity("period T_c (s)", _field("communication", "period_s")),
        "duration": Quantity("duration D_c (s)", _field("communication", "duration_s")),
        "speed": Quantity("speed (m/s)", _field("motion", "linear_mps")),
        "loss": Quantity("share of messages lost", _field("radio", "loss")),
    }
)


@dataclass(frozen=True, slots=True)
class Sweep:
    """A quantity's values, one scenario each.

    Attributes:
        name: of the quantity.
        values: ascending.
    """

    name: str
    values: tuple[float, ...]

    def scenario(self, scenario: Scenario, value: float) -> Scenario:
        """Return a scenario with one of the values.

        Raises:
            InputError: that isn't a scenario that can be run.
        """
        try:
            return verify(QUANTITIES[self.name].apply(scenario, value))
        except InputError as error:
            raise InputError(f"--sweep: {self.name}={shown(value)}: {error}") from error


def parse_sweep(text: str) -> Sweep:
    """Read a sweep, given as NAME=V1,V2,… .

    Raises:
        InputError: there is no such quantity, or a value can't be one of it.
    """
    name, equals, values = text.partition("=")
    if not equals or name not in QUANTITIES:
        raise InputError(
            f"expected NAME=V1,V2,… with a NAME of {', '.join(QUANTITIES)}, not {text!r}"
        )
    quantity = QUANTITIES[name]
    read = {_value(part, quantity) for part in values.split(",")}
    return Sweep(name, tuple(sorted(read)))


def shown(value: float) -> str:
    """Return a value as it was given, a whole number without a point."""
    return str(int(value)) if value.is_integer() else repr(value)


def _value(text: str, quantity: Quantity) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    is_fine = math.isfinite(value) and value >= 0.0
    if quantity.is_count:
        is_fine = is_fine and value >= 1.0 and value.is_integer()
    if not is_fine:
        kind = "a whole number from 1 on" if quantity.is_count else "a number from 0 on"
        raise InputError(f"{quantity.label}: expected {kind}, not {text!r}")
    return value
