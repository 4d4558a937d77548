"""What the snapshot kit does for a whole run: unused goldens, workers, other plugins, world files, no graphics."""

from __future__ import annotations

import pytest

from carom.systems.simulation import Simulation
from carom.tools import offscreen
from carom.tools.recording import Recording

pytest_plugins = "pytester"
pytestmark = pytest.mark.usefixtures("loaded")

TESTS = """
import pytest
from carom.systems.simulation import Simulation

SPEED = 1.0

def ball(steps):
    simulation = Simulation(dt=1 / 60, gravity=(0, 0, 0))
    simulation.add(name="ball", collider={"sphere": {"radius": 0.3}}, body={}, motion={"linear": (SPEED, 0, 0)})
    simulation.step(steps)
    return simulation

@pytest.mark.parametrize("steps", [1, 40])
def test_ball(steps, carom_snapshot):
    carom_snapshot.check(ball(steps), f"after_{steps}")
"""
WORLD = """
carom: 1
gravity: [0, 0, 0]
run: {frames: 3}
render: {width: 64, height: 48}
entities:
  - {name: ball, collider: {sphere: {radius: 0.5}}, body: {}, motion: {linear: [6, 0, 0]}}
cameras: {main: {position: [0, 0, 5], target: [0, 0, 0]}}
expect:
  - {at: 0.05 s, ball.position.x: {is: 0.3, within: 1 um}}
"""
ALONE = ("-p", "no:hypothesispytest")  # whose import takes longer than such a run
UNUSED = "carom: goldens that no test uses; remove them:"


@pytest.fixture
def kit(pytester: pytest.Pytester) -> pytest.Pytester:
    """Return a folder with two accepted goldens, one that nobody uses any more, and those of a file that is gone."""
    pytester.makepyfile(test_ball=TESTS)
    pytester.runpytest_inprocess("--carom-update").assert_outcomes(passed=2)
    for old in ("test_ball/old", "test_gone/start"):
        golden = pytester.path / "__carom__" / f"{old}.json"
        golden.parent.mkdir(exist_ok=True)
        golden.write_text("{}")
    return pytester


def unused(result: pytest.RunResult) -> list[str]:
    """Return what a run lists as unused."""
    lines = result.outlines
    if UNUSED not in lines:
        return []
    found = lines[lines.index(UNUSED) + 1 :]
    return [line.strip() for line in found[: next(k for k, line in enumerate(found) if not line.startswith("  "))]]


def test_goldens_that_no_test_uses_are_listed(kit: pytest.Pytester) -> None:
    """Those of files that are gone as well."""
    assert unused(kit.runpytest_inprocess()) == ["__carom__/test_ball/old.json", "__carom__/test_gone/start.json"]


@pytest.mark.parametrize(
    "words", [["-k", "40"], ["test_ball.py::test_ball[1]"], ["--deselect", "test_ball.py::test_ball[1]"]]
)
def test_of_a_file_that_is_run_in_part_nothing_is_listed(kit: pytest.Pytester, words: list[str]) -> None:
    """The tests left out may use them."""
    result = kit.runpytest_inprocess(*words)
    result.assert_outcomes(passed=1, deselected=result.parseoutcomes().get("deselected", 0))
    assert unused(result) == []


def test_of_a_file_with_a_failure_nothing_is_listed(kit: pytest.Pytester) -> None:
    """A test may have failed before it came to its golden."""
    path = kit.path / "test_ball.py"
    path.write_text(path.read_text().replace("def ball(steps):", "def ball(steps):\n    assert steps == 1"))
    result = kit.runpytest_inprocess()
    result.assert_outcomes(passed=1, failed=1)
    assert unused(result) == []


def test_workers_of_xdist_report_to_their_controller(kit: pytest.Pytester) -> None:
    """Each runs one of the two tests: what changes and what is unused is said once, by one."""
    path = kit.path / "test_ball.py"
    path.write_text(path.read_text().replace("SPEED = 1.0", "SPEED = 2.0"))
    result = kit.runpytest_subprocess("-n", "2", "--carom-update", *ALONE)
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(
        [
            "goldens to change:",
            "  __carom__/test_ball/after_1: physics: transform.position of entity 'ball' is [[]0.0333*",
            "  __carom__/test_ball/after_40: physics: transform.position of entity 'ball' is [[]1.333*",
        ]
    )
    assert unused(result) == ["__carom__/test_ball/old.json", "__carom__/test_gone/start.json"]
    kit.runpytest_inprocess().assert_outcomes(passed=2)


def test_syrupy_keeps_its_own_snapshots(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both in one test: each updates, compares and lists what is unused of its own."""
    monkeypatch.delenv("PYTEST_XDIST_WORKER", raising=False)  # where it is set syrupy leaves the telling to others
    both = TESTS.replace("carom_snapshot):", "carom_snapshot, snapshot):\n    assert steps == snapshot")
    pytester.makepyfile(test_ball=both)
    result = pytester.runpytest_subprocess("--snapshot-update", "--carom-update", *ALONE)
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["2 snapshots generated."])
    result = pytester.runpytest_subprocess(*ALONE)
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["2 snapshots passed."])
    assert unused(result) == []
    kept = {path.name for path in pytester.path.glob("__*__")} - {"__pycache__"}  # unless Python is told to keep none
    assert kept == {"__carom__", "__snapshots__"}


def test_the_last_frames_are_those_that_led_there(kit: pytest.Pytester) -> None:
    """Also where the test itself changed the world between two steps."""
    path = kit.path / "test_ball.py"
    changed = "    simulation.step(steps)\n    simulation['ball'].transform.position = (steps, 0, 0)\n"
    path.write_text(path.read_text().replace("    simulation.step(steps)\n", f"{changed}    simulation.step(5)\n"))
    kit.runpytest_inprocess("-k", "40").assert_outcomes(failed=1, deselected=1)
    (file,) = (kit.path / "carom-report").rglob("recording.rrd")
    recording = Recording(file)
    assert recording.frames == list(range(46))
    places = [float(pose.position[0]) for frame in (16, 40, 41, 45) for pose in recording.poses(frame).values()]
    assert places == pytest.approx([16 / 60, 40 / 60, 40 + 1 / 60, 40 + 5 / 60], abs=1e-5)


def test_two_checks_that_share_a_golden_and_differ_update_nothing(pytester: pytest.Pytester) -> None:
    """Whichever came last would win, and the other would fail from then on."""
    pytester.makepyfile(test_ball=TESTS.replace('f"after_{steps}"', '"after"'))
    result = pytester.runpytest_inprocess("--carom-update")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(
        [
            "no golden was changed:",
            "__carom__/test_ball/after: test_ball.py::test_ball[[]1[]] and *[[]40[]] share it and differ; give each *",
        ]
    )
    assert not (pytester.path / "__carom__").exists()


def test_ci_shows_what_did_not_pass_on_the_page_of_the_run(
    kit: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the file that the variable names, behind what others wrote there."""
    path, summary = kit.path / "test_ball.py", kit.path / "summary.md"
    summary.write_text("# All\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    kit.runpytest_inprocess().assert_outcomes(passed=2)
    assert summary.read_text() == "# All\n"
    path.write_text(path.read_text().replace("SPEED = 1.0", "SPEED = 2.0"))
    kit.runpytest_inprocess("--carom-report", "elsewhere").assert_outcomes(failed=2)
    text = summary.read_text()
    assert text.startswith("# All\n## Snapshots that do not pass\n") and text.count("| physics | ") == 2
    assert (kit.path / "elsewhere" / "index.html").is_file()


def test_world_files_are_tests(pytester: pytest.Pytester) -> None:
    """They hold what they expect, and state and picture at their end, by their own camera and size."""
    pytester.makeini("[pytest]\ncarom_worlds = worlds/*.yaml\n")
    world = pytester.mkdir("worlds") / "flight.yaml"
    world.write_text(WORLD)
    (pytester.path / "other.yaml").write_text("carom: 1\n")
    result = pytester.runpytest_inprocess("-v", "--carom-update")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["worlds/flight.yaml::world PASSED*", "  worlds/__carom__/flight.yaml/end: new"])
    pytester.runpytest_inprocess().assert_outcomes(passed=1)

    world.write_text(WORLD.replace("radius: 0.5", "radius: 0.6"))
    result = pytester.runpytest_inprocess("worlds/flight.yaml::world")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        ["physics: poses and velocities agree, but not *", "  again: pytest *flight.yaml::wor*"]
    )

    world.write_text(WORLD.replace("[6, 0, 0]", "[7, 0, 0]"))
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            f"{world}:10:5: failed in frame 3 at 0.05 s: *",
            f"  {world}:7:5: 'ball'",
            "  open it with: carom run worlds/flight.yaml --break 'frame 3' --pdb",
        ]
    )

    world.write_text(WORLD.replace("radius: 0.5", "radius: -1"))
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*flight.yaml:*: entities*radius: must be above 0*"])


def test_without_graphics_a_picture_fails(kit: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    """Never a skip; states are held as before."""
    monkeypatch.setattr(offscreen, "LIBRARIES", {"osmesa": (("libNowhere.so",),)})
    kit.runpytest_inprocess().assert_outcomes(passed=2)
    path = kit.path / "test_ball.py"
    camera = 'f"after_{steps}", camera=Camera((0, 0, 5)), size=(16, 16)'
    path.write_text(path.read_text().replace('f"after_{steps}"', camera) + "\nfrom carom.tools.cameras import Camera\n")
    result = kit.runpytest_inprocess()
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["the picture cannot be drawn: pictures need software OpenGL, and neither *"])


@pytest.mark.parametrize("name", ["", "../outside", ".hidden", "a/b"])
def test_a_golden_has_a_plain_name(pytester: pytest.Pytester, name: str) -> None:
    """It is a file in the folder of its test file."""
    pytester.makepyfile(test_ball=TESTS.replace('f"after_{steps}"', repr(name)))
    result = pytester.runpytest_inprocess("--carom-update")
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines([f"a golden is named by letters and digits, received {name!r}"])


def test_step_is_what_it_was_when_a_test_is_over(kit: pytest.Pytester) -> None:
    """The last frames are kept only while a test with the fixture runs."""
    before = Simulation.step
    kit.runpytest_inprocess().assert_outcomes(passed=2)
    assert Simulation.step is before


def test_reports_stay_out_of_repositories(kit: pytest.Pytester) -> None:
    """The folder says so itself, and the next run empties it."""
    report = kit.path / "carom-report"
    assert (report / ".gitignore").read_text() == "*\n"
    kit.runpytest_inprocess().assert_outcomes(passed=2)
    assert [path.name for path in report.rglob("*") if path.is_file()] == [".gitignore"]
