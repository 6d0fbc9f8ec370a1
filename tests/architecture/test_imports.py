"""Imports go the ways that the design has, and no other.

``PACKAGES``  which package may import which
``ARROWS``    which part of the core may import which
"""

import sys
from graphlib import TopologicalSorter

import pytest

from support.source_tree import Module, imported, modules

PACKAGES: dict[str, set[str]] = {
    "tlcomm_msgs": set(),
    "tlcomm_core": set(),
    "tlcomm_agent": {"tlcomm_core", "tlcomm_msgs"},
    "tlcomm_sim": {"tlcomm_core", "tlcomm_msgs"},
    "tlcomm_tools": {"tlcomm_agent", "tlcomm_core", "tlcomm_msgs", "tlcomm_sim"},
}

# From the ground up. The laws of motion and of radio are the world's, but agents and protocol
# reckon with them as well; nothing else of the world is known to them.
ARROWS: dict[str, set[str]] = {
    "errors": set(),
    "units": set(),
    "geometry": set(),
    "pace": {"errors"},
    "windows": {"units"},
    "world.radio": set(),
    "world.unicycle": {"geometry"},
    "workspace": {"errors", "geometry"},
    "ltl": {"errors"},
    "scenario": {"errors", "geometry", "ltl", "workspace"},
    "field": {"scenario", "units", "workspace"},
    "planning": {"errors", "geometry", "ltl", "workspace"},
    "game": {"errors", "geometry", "planning", "workspace"},
    "protocol": {"errors", "game", "units", "world.radio"},
    "method": {"errors", "game"},
    "agent": {
        "errors",
        "game",
        "geometry",
        "ltl",
        "method",
        "planning",
        "protocol",
        "scenario",
        "units",
        "workspace",
        "world.radio",
        "world.unicycle",
    },
    "world": {
        "errors",
        "field",
        "geometry",
        "units",
        "workspace",
        "world.radio",
        "world.unicycle",
    },
    "wire": {"errors", "game", "protocol", "units", "world"},
    "records": {"agent", "game", "world"},
    "mission": {"field", "game", "method", "scenario", "units", "world"},
    "metrics": {
        "agent",
        "field",
        "game",
        "geometry",
        "method",
        "planning",
        "records",
        "scenario",
        "units",
        "windows",
        "workspace",
        "world",
        "world.radio",
        "world.unicycle",
    },
    "verdict": {"agent", "game", "method", "metrics", "records", "scenario", "units", "windows"},
    "result": {
        "agent",
        "method",
        "metrics",
        "records",
        "scenario",
        "units",
        "verdict",
    },
    "simulation": {
        "agent",
        "mission",
        "protocol",
        "records",
        "units",
        "workspace",
        "world",
    },
}

LIBRARIES = {"PIL", "numpy", "pydantic", "pydantic_core", "scipy", "yaml"}
MOST_LINES = 400


def test_packages_import_one_way() -> None:
    """Messages and core know nobody, agent and sim not each other, the tools anyone."""
    assert [flaw for module in modules() for flaw in package_flaws(module)] == []


def test_rclpy_and_messages_stay_at_the_edge() -> None:
    """The rclpy library is for node and runtime modules; messages are for wire modules too."""
    assert [flaw for module in modules() for flaw in ros_flaws(module)] == []


def test_the_core_needs_no_more_than_its_libraries() -> None:
    """Beside the standard library, only what works without ROS."""
    assert [flaw for module in modules() for flaw in library_flaws(module)] == []


def test_the_core_is_layered() -> None:
    """Each part of the core imports only what the design lets it."""
    assert [flaw for module in modules() for flaw in core_flaws(module)] == []


def test_the_declared_layers_have_no_cycle() -> None:
    """There is an order in which each part needs only those before it."""
    order = list(TopologicalSorter(ARROWS).static_order())
    assert order.index("workspace") < order.index("game") < order.index("simulation")


def test_modules_are_small() -> None:
    """No module is longer than one can keep in mind."""
    lengths = {module.name: len(module.text.splitlines()) for module in modules()}
    assert {name: lines for name, lines in lengths.items() if lines > MOST_LINES} == {}


def test_public_modules_say_what_they_offer() -> None:
    """Each has ``__all__``, unless it offers nothing."""
    assert [module.name for module in modules() if not says_what_it_offers(module)] == []


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("tlcomm_core.agent.brain", "import tlcomm_agent"),
        ("tlcomm_core.agent.brain", "from tlcomm_msgs.msg import Tick"),
        ("tlcomm_agent.node", "from tlcomm_sim import wire"),
        ("tlcomm_sim.lockstep", "import tlcomm_agent.wire as peer"),
        ("tlcomm_agent.node", "import tlcomm_tools.cli"),
        ("tlcomm_core.agent.brain", "from importlib import import_module"),
    ],
)
def test_a_wrong_way_between_packages_is_found(name: str, line: str) -> None:
    """Whatever the form of the import, also inside a function."""
    assert package_flaws(Module(name, line))
    assert package_flaws(Module(name, f"def late():\n    {line}"))


@pytest.mark.parametrize(
    ("name", "line", "is_allowed"),
    [
        ("tlcomm_agent.node", "import rclpy", True),
        ("tlcomm_agent.node", "from nav_msgs.msg import Odometry", True),
        ("tlcomm_tools.runtime.spin", "from rclpy.node import Node", True),
        ("tlcomm_agent.wire", "from builtin_interfaces.msg import Time", True),
        ("tlcomm_agent.wire", "from rclpy.time import Time", False),
        ("tlcomm_sim.lockstep", "import rclpy", False),
        ("tlcomm_sim.outputs", "from tlcomm_msgs.msg import Tick", False),
        ("tlcomm_tools.verbs.run", "from rclpy.node import Node", False),
        ("tlcomm_tools.verbs.check", "from tlcomm_msgs import msg", False),
        ("tlcomm_core.agent.brain", "import rclpy", False),
        ("tlcomm_core.node", "import rclpy", False),
        ("tlcomm_core.wire.fields", "from std_msgs.msg import Header", False),
    ],
)
def test_ros_away_from_the_edge_is_found(name: str, line: str, is_allowed: bool) -> None:
    """Each kind of module may import its kind of thing."""
    assert (ros_flaws(Module(name, line)) == []) is is_allowed


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("tlcomm_core.game.offer", "from tlcomm_core.protocol.messages import PlanOffer"),
        ("tlcomm_core.geometry", "from tlcomm_core import units"),
        ("tlcomm_core.agent.brain", "from tlcomm_core.world import World"),
        ("tlcomm_core.agent.brain", "from tlcomm_core.world.world import World"),
        ("tlcomm_core.agent.brain", "from ..world.world import World"),
        ("tlcomm_core.world.radio", "from .world import World"),
        ("tlcomm_core.protocol.team", "import tlcomm_core.agent.brain"),
        ("tlcomm_core.unheard_of", "from tlcomm_core import units"),
    ],
)
def test_a_wrong_way_inside_the_core_is_found(name: str, line: str) -> None:
    """Upwards, into the world, or from a part that the design doesn't have."""
    assert core_flaws(Module(name, line))


def test_a_foreign_library_in_the_core_is_found() -> None:
    """A library that isn't on the list is."""
    assert library_flaws(Module("tlcomm_core.game.sample", "import pandas as pd"))
    assert library_flaws(Module("tlcomm_core.game.sample", "import numpy as np, math")) == []


def package_flaws(module: Module) -> list[str]:
    """Return the imports of other packages of ours that aren't allowed.

    ``importlib`` hides an arrow; only the tools load by name.
    """
    allowed = {module.package, *PACKAGES[module.package]}
    forbidden = PACKAGES.keys() - allowed
    if module.package != "tlcomm_tools":
        forbidden |= {"importlib"}
    return [f"{module.name} -> {name}" for name in imported(module) if _first(name) in forbidden]


def ros_flaws(module: Module) -> list[str]:
    """Return the imports of rclpy and of messages where they don't belong."""
    package, last = module.package, module.name.rpartition(".")[2]
    is_shell = package in {"tlcomm_agent", "tlcomm_sim"}
    is_runtime = module.name.startswith("tlcomm_tools.runtime.")
    may_spin = is_runtime or (is_shell and last == "node")
    may_speak = may_spin or (last.startswith("wire") and package != "tlcomm_core")
    return [
        f"{module.name} -> {name}"
        for name in imported(module)
        if (_is_rclpy(name) and not may_spin) or (_is_messages(name) and not may_speak)
    ]


def library_flaws(module: Module) -> list[str]:
    """Return what the core imports from elsewhere than its libraries and Python's own."""
    if module.package != "tlcomm_core":
        return []
    known = LIBRARIES | sys.stdlib_module_names | {"tlcomm_core"}
    return [f"{module.name} -> {name}" for name in imported(module) if _first(name) not in known]


def core_flaws(module: Module) -> list[str]:
    """Return the imports between parts of the core that aren't allowed."""
    if module.package != "tlcomm_core" or module.name == "tlcomm_core":
        return []
    part = _part(module.name)
    allowed = {part} | ARROWS[part] if part in ARROWS else set()
    return [
        f"{module.name} -> {name}"
        for name in imported(module)
        if _first(name) == "tlcomm_core" and _part(name) not in allowed
    ]


def says_what_it_offers(module: Module) -> bool:
    """Return whether a module has ``__all__`` or nothing but a docstring, or is private."""
    last = module.name.rpartition(".")[2]
    lines = [line for line in module.text.splitlines() if line.startswith("__all__")]
    defines = any(line.startswith(("def ", "class ", "from ")) for line in module.text.splitlines())
    return bool(lines) or last.startswith("_") or (module.is_package and not defines)


def _part(name: str) -> str:
    """Return the part of the core that a module or a name in it belongs to."""
    parts = name.split(".")[1:]
    pair = ".".join(parts[:2])
    return pair if pair in ARROWS else parts[0]


def _first(name: str) -> str:
    return name.partition(".")[0]


def _is_rclpy(name: str) -> bool:
    return _first(name).startswith("rclpy")


def _is_messages(name: str) -> bool:
    return _first(name).endswith(("_msgs", "_interfaces"))
