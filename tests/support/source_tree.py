"""The project's modules and what they import, read from their text.

``Module``    a module's dotted name and text
``modules``   all modules of the packages under a folder
``imported``  the dotted names that a module imports, wherever in its text
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

__all__ = ["SOURCE", "Module", "imported", "modules"]

SOURCE = Path(__file__).parents[2] / "ros2_ws" / "src"


@dataclass(frozen=True, slots=True)
class Module:
    """A module as a text.

    Attributes:
        name: dotted; a package's is that of its ``__init__``.
        text: its source.
        is_package: whether it is an ``__init__``.
    """

    name: str
    text: str
    is_package: bool = False

    @property
    def package(self) -> str:
        """The first part of the name."""
        return self.name.partition(".")[0]


def modules() -> Iterator[Module]:
    """Yield every module of every package in the workspace."""
    for folder in sorted(SOURCE.glob("tlcomm_*/tlcomm_*")):
        for path in sorted(folder.rglob("*.py")):
            parts = path.relative_to(folder.parent).with_suffix("").parts
            is_package = parts[-1] == "__init__"
            name = ".".join(parts[:-1] if is_package else parts)
            yield Module(name, path.read_text(encoding="utf-8"), is_package)


def imported(module: Module) -> frozenset[str]:
    """Return the dotted names that a module imports, inside functions and for types alone too.

    Of ``from a import b`` that is ``a.b``, whether ``b`` is a module or not.
    """
    names: set[str] = set()
    for node in ast.walk(ast.parse(module.text)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            origin = _origin(module, node)
            names |= {f"{origin}.{alias.name}" for alias in node.names}
    return frozenset(names)


def _origin(module: Module, node: ast.ImportFrom) -> str:
    """Return the absolute name of the module that is imported from."""
    if node.level == 0:
        return node.module or ""
    up = node.level - module.is_package
    parts = module.name.split(".")
    base = parts[: len(parts) - up]
    return ".".join([*base, *([node.module] if node.module else [])])
