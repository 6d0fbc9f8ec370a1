"""Scenario files: what loads, and one clear line for each that doesn't."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from support.good_scenario import GOOD
from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.loader import dumps, load_scenario, loads, verify

_CHANGE = "{at_s: 5, obstacles_m: []}"
SCENARIOS = Path(__file__).parents[3] / "scenarios"


def test_a_good_scenario_loads_with_its_defaults() -> None:
    """What the file leaves out is filled in."""
    scenario = loads(GOOD)
    assert scenario.workspace.origin_m == (0.0, 0.0)
    assert scenario.communication.hop_latency_s == 0.005
    assert scenario.motion.position_tolerance_m == 0.02
    assert scenario.noise.linear == 0.0
    assert (scenario.faults.action_failure, scenario.faults.retries) == (0.0, 3)
    assert scenario.agents["two"].start == (0.75, 0.75, 0.0)


def test_by_default_the_radio_is_perfect_within_range() -> None:
    """Nothing is lost, late, doubled, limited or hidden unless the file says so."""
    radio = loads(GOOD).radio
    assert (radio.loss, radio.loss_at_range, radio.jitter_s, radio.duplication) == (0, None, 0, 0)
    assert radio.bandwidth_bps is None
    assert not radio.line_of_sight


def test_a_radio_that_needs_sight_must_start_with_it() -> None:
    """Agents at both sides of a wall are in range of each other, but not connected."""
    beside = (
        GOOD.replace("[0.25, 0.75, 0.0]", "[2.75, 2.75, 0.0]")
        .replace("[0.75, 0.75, 0]", "[3.45, 2.75, 0]")
        .replace("[2.25, 3.25]", "[2.75, 3.25]")
        .replace('"G F b"', '"G F drop"')
        .replace('"G F (a & pick)"', '"G F pick"')
    )
    beside = beside.replace("[3.0, 0.0, 3.2, 4.0]", "[3.1, 0.0, 3.2, 4.0]").replace(
        "cell_m: 0.5", "cell_m: 0.1"
    )
    loads(beside)
    with pytest.raises(
        ScenarioError, match=r"two\.start: .* isn't connected .* past all obstacles"
    ):
        loads(f"{beside}radio: {{line_of_sight: true}}\n")


def test_agents_override_the_team() -> None:
    """An agent's own fields win, the team's others stay."""
    scenario = loads(GOOD)
    assert scenario.drive_of("one").linear_mps == 1.0
    assert scenario.drive_of("two").linear_mps == 0.5
    assert scenario.drive_of("two").angular_radps == 1.5
    assert scenario.actions_of("one") == {"pick": 4.0}
    assert scenario.actions_of("two") == {"pick": 1.0, "drop": 2.0}


@pytest.mark.parametrize("name", ["plant", "corridor", "warehouse"])
def test_the_projects_scenarios_load_and_survive_a_round_trip(name: str) -> None:
    """Written out, each loads back equal, with the defaults visible."""
    scenario = load_scenario(SCENARIOS / f"{name}.yaml")
    assert scenario.name == name
    text = dumps(scenario)
    assert "hop_latency_s: 0.005" in text
    assert loads(text) == scenario


def test_tasks_and_a_soft_task_load_and_are_written_out() -> None:
    """All hard tasks count together; the soft one stays apart."""
    tasks = (
        'task: "G F b"\n    tasks: ["F a | b", "G !drop"]\n    soft: {task: F pick, weight_s: 2}'
    )
    scenario = loads(GOOD.replace('task: "G F b"', tasks))
    one, two = scenario.agents.values()
    assert (one.hard_tasks, one.whole_task) == (("G F (a & pick)",), "G F (a & pick)")
    assert two.whole_task == "(G F b) & (F a | b) & (G !drop)"
    assert two.soft is not None
    assert (two.soft.task, two.soft.weight_s) == ("F pick", 2.0)
    assert "weight_s: 2.0" in dumps(scenario)
    assert loads(dumps(scenario)) == scenario


def test_tasks_alone_are_enough() -> None:
    """An agent needs no task beside its tasks; a soft task alone isn't one."""
    scenario = loads(GOOD.replace('    task: "G F b"', '    tasks: ["G F b"]'))
    assert scenario.agents["two"].whole_task == "G F b"
    assert loads(dumps(scenario)) == scenario
    with pytest.raises(ScenarioError, match=r"agents\.two\.task: missing"):
        loads(GOOD.replace('    task: "G F b"', "    soft: {task: F b, weight_s: 1}"))


def test_only_what_must_be_done_must_be_reachable() -> None:
    """A soft task may name a region behind a wall, a hard one in the list may not."""
    walled = GOOD.replace("[2.25, 3.25]", "[3.75, 3.25]")
    loads(walled.replace('task: "G F b"', "task: G F a\n    soft: {task: F b, weight_s: 1}"))
    with pytest.raises(ScenarioError, match=r"agents\.two\.tasks\[0\]: region 'b' can't be"):
        loads(walled.replace('task: "G F b"', 'task: G F a\n    tasks: ["F b"]'))


# What to replace in GOOD, by what, the line of the error, and what it says.
BAD = [
    ("G F b", "G F c", 20, "agents.two.task: unknown region or action 'c'; expected one of"),
    ("a & pick", "a & pikc", 17, "agents.one.task: unknown region or action 'pikc'; did you mean"),
    ("G F b", "G F drop & pik", 20, "did you mean 'pick'?"),
    ("a & pick", "a & drop", 17, "agents.one.task: unknown region or action 'drop'"),
    ("G F b", "G F (b &", 20, "agents.two.task: column 9"),
    ("G F b", "", 20, "agents.two.task: column 1"),
    ("[0.25, 0.75, 0.0]", "[1.25, 1.75, 0.0]", 16,
     "agents.one.start: 1.25, 1.75 lies inside an obstacle; choose a free point"),
    ("[0.25, 0.75, 0.0]", "[3.4, 0.25, 0.0]", 16, "in a cell that an obstacle covers in part"),
    ("[0.25, 0.75, 0.0]", "[4.25, 0.25, 0.0]", 16,
     "agents.one.start: 4.25, 0.25 lies outside the workspace (x 0 to 4, y 0 to 4)"),
    ("[0.75, 0.75, 0]", "[2.75, 3.75, 0]", 19,
     "agents.two.start: 2.75, 3.75 isn't connected to 'one'"),
    ("duration_s: 5.0", "duration_s: 60.0", 11,
     "communication.duration_s: 60.0 isn't shorter than period_s (60.0); expected D_c < T_c"),
    ("duration_s: 5.0", "duration_s: 5.0, hop_latency_s: 5.0", 11, "communication.hop_latency_s"),
    ("motion: {linear", "radio: {loss: 1.3}\nmotion: {linear", 12,
     "radio.loss: found 1.3; expected less than or equal to 1"),
    ("motion: {linear", "radio: {loss_at_range: -0.1}\nmotion: {linear", 12,
     "radio.loss_at_range: found -0.1; expected greater than or equal to 0"),
    ("motion: {linear", "radio: {jitter: 0.1}\nmotion: {linear", 12,
     "radio.jitter: unknown field; did you mean 'jitter_s'?"),
    ("motion: {linear", "radio: {jitter_s: 4.995}\nmotion: {linear", 12,
     "radio.jitter_s: 4.995 more than hop_latency_s isn't shorter than duration_s (5.0)"),
    ("motion: {linear", "radio: {bandwidth_bps: 0}\nmotion: {linear", 12,
     "radio.bandwidth_bps: found 0; expected greater than 0"),
    ("motion: {linear", "radio: {line_of_sight: 1}\nmotion: {linear", 12,
     "radio.line_of_sight: found 1; expected a valid boolean"),
    ("duration_s: 5.0", "duration_s: 5.0, margin_s: 60.0", 11,
     "communication.margin_s: 60.0 isn't shorter than period_s (60.0)"),
    ("duration_s: 5.0", "duration_s: 5.0, margin_s: -1.0", 11,
     "communication.margin_s: found -1.0; expected greater than or equal to 0"),
    ("duration_s: 5.0", "duration_s: 5.0, resilience: 2", 11,
     "communication.resilience: found 2; expected less than or equal to 1"),
    ("duration_s: 5.0", "duration_s: 5.0, separation_m: 0.96", 11,
     "communication.separation_m: 0.96 isn't less than what links are planned with, 0.96 m"),
    ("duration_s: 5.0", "duration_s: 5.0, separation_m: 0.8", 11,
     "communication.separation_m: 0.8 leaves no 2 cells' centres, 0.5 m apart"),
    ("range_m: 1.0", "range_m: 0.04", 11, "communication.range_m: 0.04 isn't more than twice"),
    ("linear_mps: 1.0", "linear_mps: -1.0", 12,
     "motion.linear_mps: found -1.0; expected greater than or equal to 0.001"),
    ("linear_mps: 0.5", "linear_mps: 0.0", 21, "agents.two.motion.linear_mps: found 0.0"),
    ("drop: 2", "drop: -2", 22, "agents.two.actions.drop: found -2"),
    ("  two:", "  one:", 18, "agents.one: given twice; it first stands in line 15"),
    ("    b: {", "    a: {", 10, "workspace.regions.a: given twice"),
    ("[2.25, 3.25]", "[2.25, 4.25]", 10,
     "workspace.regions.b.at_m: 2.25, 4.25 lies outside the workspace"),
    ("[2.25, 3.25]", "[1.5, 1.5]", 10, "workspace.regions.b: no free cell's centre lies within"),
    ("[2.25, 3.25]", "[3.75, 3.25]", 20, "region 'b' can't be reached from the start 0.75, 0.75"),
    ("period_s: 60.0", "period_s: sixty", 11,
     "communication.period_s: found 'sixty'; expected a valid number"),
    ("period_s: 60.0", 'period_s: "60.0"', 11, "communication.period_s: found '60.0'"),
    ("period_s: 60.0", "period_s: true", 11, "communication.period_s: found True"),
    ("period_s: 60.0", "period_s: .inf", 11,
     "communication.period_s: found '.inf'; expected a finite number"),
    ("period_s: 60.0", "period_s: 1e12", 11, "communication.period_s: found 1000000000000.0"),
    ("period_s: 60.0, ", "", 11, "communication.period_s: missing"),
    ("period_s", "periods_s", 11,
     "communication.periods_s: unknown field; did you mean 'period_s'?"),
    ("actions: {pick: 4.0}", "actoins: {pick: 4.0}", 13,
     "actoins: unknown field; did you mean 'actions'?"),
    ("angular_radps: 1.5", "period_s: 1.5", 12,
     "motion.period_s: unknown field; expected one of angular_radps, linear_mps, position_"),
    ("radius_m", "size", 9,
     "workspace.regions.a.size: unknown field; expected one of at_m, radius_m"),
    ("cell_m: 0.5", "cell_m: 0.5\n  mapp: x", 5,
     "workspace.mapp: unknown field; did you mean 'map'?"),
    ("motion: {linear_mps: 1.0, angular_radps: 1.5}", "motion: fast", 12,
     "motion: found 'fast'; expected a mapping"),
    ("[0.25, 0.75, 0.0]", "[0.25, 0.75]", 16, "agents.one.start[2]: missing"),
    ("[0.25, 0.75, 0.0]", "[0.25, 0.75, 0.0, 1.0]", 16, "expected at most 3 items"),
    ("  two:", "  Agent-2:", 18, "agents.Agent-2: 'Agent-2' is no name; expected a letter"),
    ("  two:", "  two__2:", 18, "agents.two__2: 'two__2' is no name"),
    ("  two:", "  sim:", 18, "agents.sim: the name 'sim' is taken"),
    ("  two:", "  2:", 18, "agents: found 2 as a key; expected text"),
    ("actions: {pick: 4.0}", "actions: {pick: 4.0, b: 1.0}", 13,
     "actions.b: the name 'b' is a region's too"),
    ("actions: {pick: 4.0}", "actions: {pick: 4.0, true: 1.0}", 13, "True as a key"),
    ("actions: {pick: 4.0}", "actions: {pick: 4.0, not: 1.0}", 13,
     "actions.not: the name 'not' is an operator of formulas"),
    ("    b: {", "    U: {", 10, "workspace.regions.U: the name 'U' is an operator"),
    ("[1.0, 1.0, 2.0, 2.0]", "[1.0, 1.0, 1.0, 2.0]", 6, "workspace.obstacles_m[0]"),
    ("cell_m: 0.5", "cell_m: 0.001", 4, "workspace.cell_m: 0.001 makes 4000 x 4000 cells"),
    ("cell_m: 0.5", "cell_m: 5.0", 4, "workspace.cell_m: 5.0 makes 0.8 x 0.8 cells"),
    ("name: small", "name: ../../etc", 1, "name: found '../../etc'"),
    ("  size_m: [4.0, 4.0]\n", "", 2, "workspace.size_m: missing"),
    ('    task: "G F b"\n', "", 18,
     "agents.two.task: missing; expected a formula, here or in tasks"),
    ('    task: "G F b"', "    tasks: []", 18, "agents.two.task: missing"),
    ('    task: "G F b"', '    tasks: ["F b", "F c"]', 20,
     "agents.two.tasks[1]: unknown region or action 'c'"),
    ('    task: "G F b"', '    task: F b\n    tasks: ["F b & "]', 21,
     "agents.two.tasks[0]: column 7"),
    ('    task: "G F b"', "    tasks: F b", 20, "agents.two.tasks: found 'F b'"),
    ("    motion: {linear", '    soft: {task: "G !c", weight_s: 1}\n    motion: {linear', 21,
     "agents.two.soft.task: unknown region or action 'c'"),
    ("    motion: {linear", "    soft: {task: G (!a, weight_s: 1}\n    motion: {linear", 21,
     "agents.two.soft.task: column 6"),
    ("    motion: {linear", "    soft: {task: G !a, weigth_s: 1}\n    motion: {linear", 21,
     "agents.two.soft.weigth_s: unknown field; did you mean 'weight_s'?"),
    ("    motion: {linear", "    soft: {task: G !a}\n    motion: {linear", 21,
     "agents.two.soft.weight_s: missing"),
    ("    motion: {linear", "    soft: {task: G !a, weight_s: -1}\n    motion: {linear", 21,
     "agents.two.soft.weight_s: found -1; expected greater than or equal to 0"),
    ("    motion: {linear", "    soft: {task: G !a, weight_s: 1e6}\n    motion: {linear", 21,
     "agents.two.soft.weight_s: found 1000000.0"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  changes: [{at_s: 0, obstacles_m: []}]", 5,
     "workspace.changes[0].at_s: found 0; expected greater than 0"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  changes: [{at_s: 5}]", 5,
     "workspace.changes[0].obstacles_m: missing"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  changes: [{at_s: 5, obstacle_m: []}]", 5,
     "workspace.changes[0].obstacle_m: unknown field; did you mean 'obstacles_m'?"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  changes: [{at_s: 5, obstacles_m: [[1, 1, 1, 2]]}]", 5,
     "workspace.changes[0].obstacles_m[0]: [1.0, 1.0, 1.0, 2.0] is no box"),
    ("  cell_m: 0.5", f"  cell_m: 0.5\n  changes: [{_CHANGE}, {_CHANGE}]", 5,
     "workspace.changes[1].at_s: 5.0 isn't later than the change before (5.0)"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  changes: [{at_s: 5, obstacles_m: [[0, 0, 2, 2]]}]", 5,
     "workspace.changes[0].obstacles_m: from 5.0 s on no free cell's centre lies within region"),
    ("  cell_m: 0.5", "  cell_m: 0.5\n  map: x.yaml", 5, "workspace.map: given beside 'size_m'"),
]  # fmt: skip


@pytest.mark.parametrize(("good", "bad", "line", "expected"), BAD)
def test_a_bad_scenario_is_one_line_with_file_line_and_field(
    good: str, bad: str, line: int, expected: str
) -> None:
    """Each mistake alone is reported in its own line of the file, in one line of text."""
    assert GOOD.count(good) >= 1
    with pytest.raises(ScenarioError) as caught:
        loads(GOOD.replace(good, bad, 1), "bad.yaml")
    message = str(caught.value)
    assert message.startswith(f"bad.yaml:{line}: ")
    assert expected in message
    assert "\n" not in message
    assert len(message) < 300


def test_the_first_of_several_mistakes_is_reported() -> None:
    """By line, whatever the order in which fields are validated."""
    text = GOOD.removeprefix("name: small\n") + "name: ../x\n"
    text = text.replace("drop: 2", "drop: -2").replace("period_s: 60.0", "period_s: 0")
    with pytest.raises(ScenarioError, match=r"bad\.yaml:10: communication\.period_s"):
        loads(text, "bad.yaml")


def test_files_that_cant_be_read_say_so(tmp_path: Path) -> None:
    """A missing file and a folder give one line with the path."""
    for path, reason in ((tmp_path / "none.yaml", "No such file"), (tmp_path, "Is a directory")):
        with pytest.raises(ScenarioError, match=reason) as caught:
            load_scenario(path)
        assert str(caught.value).startswith(f"{path}: ")


def test_verify_names_the_scenario() -> None:
    """A scenario made in code is checked like a file."""
    scenario = loads(GOOD)
    assert verify(scenario) is scenario
    changed = scenario.model_copy(update={"actions": {}})
    with pytest.raises(ScenarioError, match=r"small: agents\.one\.task: unknown"):
        verify(changed)


WITH_MAP = GOOD.replace(
    """  size_m: [4.0, 4.0]
  cell_m: 0.5
  obstacles_m:
    - [1.0, 1.0, 2.0, 2.0]
    - [3.0, 0.0, 3.2, 4.0]
""",
    "  map: maps/hall.yaml\n  cell_m: 0.5\n",
)
MAP = """\
image: hall.pgm
resolution: 0.1
origin: [0.0, 0.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


@pytest.fixture(name="map_scenario")
def fixture_map_scenario(tmp_path: Path) -> Path:
    """A scenario whose map has the obstacle of GOOD's middle."""
    pixels = np.full((40, 40), 254, dtype=np.uint8)
    pixels[20:30, 10:20] = 0
    (tmp_path / "maps").mkdir()
    Image.fromarray(pixels, "L").save(tmp_path / "maps/hall.pgm")
    (tmp_path / "maps/hall.yaml").write_text(MAP)
    (tmp_path / "scenario.yaml").write_text(WITH_MAP)
    return tmp_path / "scenario.yaml"


def test_a_map_becomes_size_and_obstacles(map_scenario: Path) -> None:
    """Once loaded, a scenario no longer needs its map's files."""
    scenario = load_scenario(map_scenario)
    assert scenario.workspace.size_m == (4.0, 4.0)
    assert scenario.workspace.obstacles_m == ((1.0, 1.0, 2.0, 2.0),)
    assert loads(dumps(scenario)) == scenario


def test_changes_leave_what_a_map_shows(map_scenario: Path) -> None:
    """To the obstacles of each change, those of the map are added."""
    text = WITH_MAP.replace(
        "  cell_m: 0.5\n",
        """  cell_m: 0.5
  changes:
    - {at_s: 5, obstacles_m: [[3, 0, 3.2, 4]]}
    - {at_s: 9, obstacles_m: []}
""",
    )
    map_scenario.write_text(text)
    scenario = load_scenario(map_scenario)
    image = (1.0, 1.0, 2.0, 2.0)
    changes = [(change.at_s, change.obstacles_m) for change in scenario.workspace.changes]
    assert changes == [(5.0, ((3.0, 0.0, 3.2, 4.0), image)), (9.0, (image,))]
    assert loads(dumps(scenario)) == scenario


@pytest.mark.parametrize(
    ("good", "bad", "line", "expected"),
    [
        ("hall.pgm", "none.pgm", 1, "image: 'none.pgm' can't be read (No such file"),
        ("hall.pgm", "../../etc/passwd", 1, "isn't beside"),
        ("resolution: 0.1", "resolution: 0", 2, "resolution: found 0"),
        ("[0.0, 0.0, 0.0]", "[0.0, 0.0, 1.0]", 3, "origin: [0.0, 0.0, 1.0] turns the map"),
        ("negate: 0", "negate: 0\nmode: raw", 5, "mode: found 'raw'; expected 'trinary'"),
        ("resolution: 0.1\n", "", 1, "resolution: missing"),
    ],
)
def test_a_bad_map_is_one_line_of_the_maps_file(
    map_scenario: Path, good: str, bad: str, line: int, expected: str
) -> None:
    """Mistakes in the map's YAML name that file and its line."""
    path = map_scenario.parent / "maps/hall.yaml"
    path.write_text(MAP.replace(good, bad))
    with pytest.raises(ScenarioError) as caught:
        load_scenario(map_scenario)
    message = str(caught.value)
    assert message.startswith(f"{path}:{line}: ")
    assert expected in message
    assert "\n" not in message


def test_a_missing_map_names_its_path(map_scenario: Path) -> None:
    """The path is shown as looked for."""
    map_scenario.write_text(WITH_MAP.replace("hall.yaml", "none.yaml"))
    with pytest.raises(ScenarioError, match=r"maps/none\.yaml: can't be read: No such file"):
        load_scenario(map_scenario)
    map_scenario.write_text(WITH_MAP.replace("maps/hall.yaml", "[1]"))
    with pytest.raises(ScenarioError, match=r"workspace\.map: found \[1\]"):
        load_scenario(map_scenario)
