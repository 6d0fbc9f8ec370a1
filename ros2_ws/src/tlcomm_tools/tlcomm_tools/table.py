"""Small aligned tables for people.

``format_table``   rows as lines
``format_number``  a figure, or a dash for what is not available
"""

from collections.abc import Sequence

__all__ = ["format_number", "format_table"]

_MISSING = "–"


def format_number(value: float | None, digits: int = 1, unit: str = "") -> str:
    """Return a figure with its unit, or a dash for ``None``."""
    if value is None:
        return _MISSING
    return f"{value:.{digits}f}{f' {unit}' if unit else ''}"


def format_table(
    header: Sequence[str], rows: Sequence[Sequence[str]], left: int = 1, indent: str = "  "
) -> str:
    """Return an aligned table.

    Args:
        header: of the columns.
        rows: their cells.
        left: how many columns, from the left, are aligned to the left; the others to the right.
        indent: in front of each line.
    """
    lines = [header, *rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(header))]

    def align(line: Sequence[str]) -> str:
        cells = (
            f"{cell:{'<' if column < left else '>'}{width}}"
            for column, (cell, width) in enumerate(zip(line, widths, strict=True))
        )
        return (indent + "  ".join(cells)).rstrip()

    return "\n".join(map(align, lines))
