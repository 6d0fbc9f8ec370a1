"""Where two values differ.

``Mismatch``        a part of them that does
``first_mismatch``  the first one
"""

from dataclasses import dataclass, fields, is_dataclass

__all__ = ["Mismatch", "first_mismatch"]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """A part of two values that differs.

    Attributes:
        where: the path to it, as Python writes it; "" for the whole.
        recorded: what it is in the one.
        came_out: what it is in the other.
    """

    where: str
    recorded: object
    came_out: object


def first_mismatch(recorded: object, came_out: object, where: str = "") -> Mismatch | None:
    """Return the first part in which two values differ, as deep inside as it goes; or ``None``."""
    if recorded == came_out:
        return None
    for name, one, other in _parts(recorded, came_out):
        found = first_mismatch(one, other, f"{where}{name}")
        if found is not None:
            return found
    return Mismatch(where.removeprefix("."), recorded, came_out)


def _parts(recorded: object, came_out: object) -> list[tuple[str, object, object]]:
    """Return what two values are made of, where they are made alike."""
    if isinstance(recorded, tuple) and isinstance(came_out, tuple):
        if len(recorded) != len(came_out):
            return []
        pairs = zip(recorded, came_out, strict=True)
        return [(f"[{index}]", one, other) for index, (one, other) in enumerate(pairs)]
    if not is_dataclass(recorded) or type(recorded) is not type(came_out):
        return []
    names = [own.name for own in fields(recorded)]
    return [(f".{name}", getattr(recorded, name), getattr(came_out, name)) for name in names]
