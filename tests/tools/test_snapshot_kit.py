"""The snapshot kit holds a world to its golden, and says whether physics or rendering broke it."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from carom.ecs.component import Record
from carom.systems.simulation import Simulation
from carom.tools import viewer
from carom.tools.cli import main
from carom.tools.snapshot_kit.state import StateGolden, state_fault, state_golden, this_machine

pytest_plugins = "pytester"
pytestmark = pytest.mark.usefixtures("loaded")

WORLD = """
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera

MOVED, LEFT, RIGHT = 1.0, (0.9, 0.1, 0.1), (0.1, 0.2, 0.9)

def test_two_balls(carom_snapshot):
    simulation = Simulation(dt=1 / 60)
    simulation.add(name="floor", collider={"plane": {}})
    for name, x, color in (("left", -0.5 * MOVED, LEFT), ("right", 0.5, RIGHT)):
        simulation.add(
            name=name, transform={"position": (x, 1.0, 0.0)}, collider={"sphere": {"radius": 0.3}}, body={},
            material={"color": color},
        )
    simulation.step(10)
    carom_snapshot.check(simulation, "falling", camera=Camera((0.0, 1.0, 3.0), (0.0, 0.7, 0.0)))
"""


@pytest.fixture
def kit(pytester: pytest.Pytester) -> pytest.Pytester:
    """Return a folder with one test and its accepted goldens."""
    pytester.makepyfile(test_balls=WORLD)
    pytester.runpytest_inprocess("--carom-update").assert_outcomes(passed=1)
    return pytester


def edit(kit: pytest.Pytester, before: str, after: str) -> None:
    """Change the test's world."""
    path = kit.path / "test_balls.py"
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after))


def golden(kit: pytest.Pytester, name: str) -> Path:
    """Return the path of a golden."""
    return kit.path / "__carom__" / "test_balls" / name


def left(kit: pytest.Pytester) -> Path:
    """Return the folder of the one check that did not pass."""
    (folder,) = (kit.path / "carom-report" / "carom-cases").iterdir()
    return folder


def shown(kit: pytest.Pytester) -> str:
    """Return the same as messages say it."""
    return left(kit).relative_to(kit.path).as_posix()


def test_the_same_world_passes_and_leaves_nothing_behind(kit: pytest.Pytester) -> None:
    """Only the goldens are there."""
    kit.runpytest_inprocess().assert_outcomes(passed=1)
    assert sorted(path.name for path in golden(kit, "").iterdir()) == ["falling.json", "falling.png"]
    assert list((kit.path / "carom-report").glob("*/*")) == []


def test_a_missing_golden_fails_with_the_command_that_accepts(pytester: pytest.Pytester) -> None:
    """Goldens are never written by the way."""
    pytester.makepyfile(test_balls=WORLD)
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    folder = pytester.path / "__carom__" / "test_balls"
    result.stdout.fnmatch_lines(
        [
            "no golden falling.json, falling.png in __carom__/test_balls",
            f"  frame 10, golden __carom__/test_balls/falling, left in {shown(pytester)}",
            f"  open it with: carom view {shown(pytester)}/recording.rrd --frame 10",
            '  again: pytest "test_balls.py::test_two_balls"',
            '  to accept what is now: pytest "test_balls.py::test_two_balls" --carom-update',
        ]
    )
    assert not folder.exists()


def test_a_body_moved_by_one_percent_fails_as_physics(
    kit: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The state tells which entity and column; the pictures are left to look at, and the command opens it there."""
    edit(kit, "MOVED, LEFT, RIGHT = 1.0", "MOVED, LEFT, RIGHT = 1.01")
    result = kit.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "physics: transform.position of entity 'left' is [[]-0.505, *[]], expected exactly [[]-0.5, *[]]",
            f"  frame 10, golden __carom__/test_balls/falling, left in {shown(kit)}",
            f"  open it with: carom view {shown(kit)}/recording.rrd --frame 10 --select left",
            '  again: pytest "test_balls.py::test_two_balls"',
            '  to accept what is now: pytest "test_balls.py::test_two_balls" --carom-update',
            "carom: expected and actual, side by side: carom-report/index.html",
        ]
    )
    assert sorted(path.name for path in left(kit).iterdir()) == [
        "actual.json", "actual.png", "case.json", "difference.png", "expected.json", "expected.png", "recording.rrd",
    ]  # fmt: skip
    case = json.loads((left(kit) / "case.json").read_text())
    assert (case["entity"], case["column"], case["frame"]) == ("left", "transform.position", 10)
    assert case["expected"].startswith("[-0.5, ") and case["actual"].startswith("[-0.505, ")
    # Pytest says it once more in its summary where the variable CI is set.
    (command,) = {line.partition(": carom ")[2] for line in result.outlines if line.startswith("  open it with")}
    monkeypatch.setattr(viewer, "has_display", lambda: True)
    capsys.readouterr()
    assert main([*command.split(), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told == {"file": f"{shown(kit)}/recording.rrd", "frame": 10, "selected": "/world/sphere/left"}


def test_swapped_colours_fail_as_rendering(kit: pytest.Pytester) -> None:
    """Colours are no physics."""
    edit(
        kit,
        '("left", -0.5 * MOVED, LEFT), ("right", 0.5, RIGHT)',
        '("left", -0.5 * MOVED, RIGHT), ("right", 0.5, LEFT)',
    )
    result = kit.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        ["rendering: 4 x 4 px from (*, *) on differ by * of 255, at most 2.5 may *; the state agrees"]
    )


def test_elsewhere_poses_need_agree_only_within_the_tolerance(kit: pytest.Pytester) -> None:
    """Elsewhere: on another processor, with another numpy or numba."""
    path = golden(kit, "falling.json")
    values = json.loads(path.read_text())
    values["machine"]["processor"] = "another"
    values["keys"]["left"]["transform.position"][0] += 5e-7
    path.write_text(json.dumps(values))
    kit.runpytest_inprocess().assert_outcomes(passed=1)
    values["keys"]["left"]["transform.position"][0] += 5e-6
    path.write_text(json.dumps(values))
    result = kit.runpytest_inprocess()
    result.stdout.fnmatch_lines(["physics: transform.position of entity 'left' is *, expected within 1e-06 *"])


def test_an_accepted_change_passes_again(kit: pytest.Pytester) -> None:
    """And the next run leaves no report."""
    edit(kit, "MOVED, LEFT, RIGHT = 1.0", "MOVED, LEFT, RIGHT = 1.01")
    kit.runpytest_inprocess().assert_outcomes(failed=1)
    result = kit.runpytest_inprocess("--carom-update")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(
        [
            "goldens to change:",
            "  __carom__/test_balls/falling: physics: transform.position of entity 'left' is *, expected exactly *",
        ]
    )
    kit.runpytest_inprocess().assert_outcomes(passed=1)
    assert list((kit.path / "carom-report").glob("*/*")) == []


def test_only_state_is_held() -> None:
    """What every step derives anew is no state, also where it stands beside what is: a contact's rows, for one."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": 0.3}}, body={}, transform={"position": (0.0, 0.3, 0.0)})
    simulation.step()
    digests = state_golden(simulation.world).digests
    roles = {Record.registry[key].columns[name].role for key, _, name in (path.partition(".") for path in digests)}
    assert {"contact.normal", "transform.position"} <= digests.keys()
    assert roles == {"state", "input"}


def test_without_tolerance_every_bit_counts_elsewhere_too() -> None:
    """Also of columns that are not compared by their numbers."""
    here, elsewhere = this_machine(), replace(this_machine(), processor="another")
    golden = StateGolden(elsewhere, 1, {"contact.depth": "0a", "transform.position": "01"}, {})
    actual = StateGolden(here, 1, {"contact.depth": "0b", "transform.position": "01"}, {})
    assert state_fault(actual, golden, 1e-6) is None
    fault = state_fault(actual, golden, 0.0)
    assert fault and fault.what == "poses and velocities agree, but not contact.depth"


@pytest.mark.parametrize(
    ("held", "is_now", "what"),
    [
        (5, 6, "purse.points of entity 'marble' is 6, expected within 1e-06 5"),
        (True, False, "purse.points of entity 'marble' is False, expected within 1e-06 True"),
        ("gold", "copper", "purse.points of entity 'marble' is copper, expected within 1e-06 gold"),
        ([1.0, 2.0], [1.0, 2.1], "purse.points of entity 'marble' is [1.0, 2.1], expected within 1e-06 [1.0, 2.0]"),
        ([1.0, 2.0], [1.0, 2.0 + 1e-7], None),
        (5, None, "entity 'marble' has no purse.points any more"),
    ],
)
def test_what_components_of_a_game_hold_counts_elsewhere_too(held: object, is_now: object, what: str | None) -> None:
    """Numbers within the tolerance, all else as it is."""
    here = this_machine()
    golden = StateGolden(replace(here, numba="another"), 1, {}, {"marble": {"purse.points": held}})
    actual = StateGolden(here, 1, {}, {"marble": {"purse.points": is_now}})
    fault = state_fault(actual, golden, 1e-6)
    assert (fault and fault.what) == what


def test_the_plugin_imports_nothing_of_weight() -> None:
    """It is loaded in every pytest run of the environment."""
    heavy = "{'numpy', 'numba', 'pyrender', 'rerun', 'fcl', 'OpenGL', 'PIL'}"
    code = f"import sys, carom.tools.snapshot_kit; print(sorted({heavy} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"
