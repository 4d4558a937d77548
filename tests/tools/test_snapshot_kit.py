"""The snapshot kit holds a world to its golden, and says whether physics or rendering broke it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from carom.ecs.component import Record
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.goldens import state_golden, write_picture
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene

pytest_plugins = "pytester"

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


@pytest.fixture(scope="module", autouse=True)
def loaded(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Import all the inner runs need: each forgets what it imported itself, and NumPy and OpenGL load only once."""
    simulation = Simulation()
    simulation.add(collider={"sphere": {"radius": 0.3}}, body={})
    simulation.step()
    with Renderer(16, 16) as renderer:
        picture = renderer.picture(Scene(simulation.world).batches(), Camera((0.0, 0.0, 1.0)))
    write_picture(tmp_path_factory.mktemp("loaded") / "a.png", picture)


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


def test_the_same_world_passes_and_leaves_no_pictures_behind(kit: pytest.Pytester) -> None:
    """Only the goldens are there."""
    kit.runpytest_inprocess().assert_outcomes(passed=1)
    assert sorted(path.name for path in golden(kit, "").iterdir()) == ["falling.json", "falling.png"]


def test_a_missing_golden_fails_with_the_command_that_accepts(pytester: pytest.Pytester) -> None:
    """Goldens are never written by the way."""
    pytester.makepyfile(test_balls=WORLD)
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    folder = pytester.path / "__carom__" / "test_balls"
    result.stdout.fnmatch_lines(
        [
            f"no golden falling.json, falling.png in {folder}",
            '  to accept what is now: pytest "test_balls.py::test_two_balls" --carom-update',
        ]
    )
    assert not folder.exists()


def test_a_body_moved_by_one_percent_fails_as_physics(kit: pytest.Pytester) -> None:
    """The state tells which entity and column; the pictures are left to look at."""
    edit(kit, "MOVED, LEFT, RIGHT = 1.0", "MOVED, LEFT, RIGHT = 1.01")
    result = kit.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "physics: transform.position of entity 'left' is [[]-0.505, *[]], expected exactly [[]-0.5, *[]]",
            f"  picture: {golden(kit, 'falling.actual.png')}",
            f"  difference: {golden(kit, 'falling.difference.png')}",
            '  to accept what is now: pytest "test_balls.py::test_two_balls" --carom-update',
        ]
    )
    assert golden(kit, "falling.actual.png").exists()
    assert golden(kit, "falling.difference.png").exists()


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
        ["rendering: *% of the pixels differ by more than 16 of 255, at most 0.02% may on the driver * state agrees"]
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
    """And accepting takes the pictures of the failure away."""
    edit(kit, "MOVED, LEFT, RIGHT = 1.0", "MOVED, LEFT, RIGHT = 1.01")
    kit.runpytest_inprocess().assert_outcomes(failed=1)
    kit.runpytest_inprocess("--carom-update").assert_outcomes(passed=1)
    kit.runpytest_inprocess().assert_outcomes(passed=1)
    assert not golden(kit, "falling.actual.png").exists()


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


def test_the_plugin_imports_nothing_of_weight() -> None:
    """It is loaded in every pytest run of the environment."""
    heavy = "{'numpy', 'numba', 'pyrender', 'rerun', 'fcl', 'OpenGL', 'PIL'}"
    code = f"import sys, carom.tools.snapshot_kit; print(sorted({heavy} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"
