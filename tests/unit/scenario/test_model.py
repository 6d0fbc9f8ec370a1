"""The scenario's fields and their documentation."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel

from tlcomm_core.scenario.model import Action, Scenario

REFERENCE = Path(__file__).parents[3] / "docs" / "scenario.md"


def test_the_reference_has_every_field() -> None:
    """Whatever a scenario may say stands in its documentation."""
    text = REFERENCE.read_text("utf-8")
    fields = {*fields_of(Scenario), *Action.model_fields}
    assert {"loss_at_range", "weight_s", "at_s", "after"} <= fields
    missing = {
        field
        for field in fields
        if not any(form in text for form in (f"`{field}`", f".{field}`", f"{field}:"))
    }
    assert missing == set()


def fields_of(kind: Any) -> Iterator[str]:  # noqa: ANN401 (a type's parts are anything)
    """Yield the names of a section's fields and of those of the sections in it."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        for name, field in kind.model_fields.items():
            yield name
            yield from fields_of(field.annotation)
    else:
        for part in get_args(kind):
            yield from fields_of(part)
