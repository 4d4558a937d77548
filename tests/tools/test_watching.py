"""Worlds that run anew when they are saved; what cannot be loaded is told, and what runs goes on."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Timer

import pytest

from carom.tools.cli import main
from carom.tools.session import run
from carom.tools.watching import INTERVAL, RenewedError, Watching, keep_running
from carom.worlds import LoadedWorld, load_world

WORLD = """carom: 1
include: [parts.yaml]
run: {frames: 20}
entities: [{name: ball, collider: {sphere: {radius: 0.1}}, body: {}, transform: {position: [0, HEIGHT, 0]}}]
"""
PARTS = "carom: 1\nmaterials: {stone: {density: DENSITY}}\n"
KEPT = "what was loaded before is kept"
PATIENCE = 120.0  # s until a process of a test has done what it is waited for


class Hands:
    """A clock that only goes on while somebody sleeps, and hands that do one thing after another then."""

    def __init__(self, *deeds: Callable[[], object]) -> None:
        self.now, self.deeds = 0.0, [*deeds]

    def sleep(self, seconds: float) -> None:
        """Let time go by and do the next thing; nothing is left to wait for when all is done."""
        self.now += seconds
        if self.now > 100.0 * INTERVAL:
            raise AssertionError("waited for nothing")
        if self.deeds:
            self.deeds.pop(0)()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with a world of two files."""
    (tmp_path / "w.yaml").write_text(WORLD.replace("HEIGHT", "1"))
    (tmp_path / "parts.yaml").write_text(PARTS.replace("DENSITY", "2000"))
    return tmp_path


def watched(folder: Path, hands: Hands) -> Watching:
    """Return a watched world that is loaded."""
    path = folder / "w.yaml"
    watching = Watching(path, lambda: load_world(path), clock=lambda: hands.now, sleep=hands.sleep)
    watching.wait()
    return watching


def height(loaded: LoadedWorld) -> float:
    """Return where the ball is, m."""
    return float(loaded.simulation["ball"].transform.position[1])


def test_a_saved_world_is_loaded_anew(folder: Path) -> None:
    """Once it is whole: a file that is another at each look is still being written."""
    path, hands = folder / "w.yaml", Hands()
    watching = watched(folder, hands)
    assert watching.look() is None
    assert watching.look() is None
    path.write_text(WORLD.replace("HEIGHT", "22"))
    assert watching.look() is None
    path.write_text(WORLD.replace("HEIGHT", "333"))
    assert watching.look() is None
    loaded = watching.look()
    assert loaded is not None
    assert height(loaded) == 333.0
    assert watching.look() is None


def test_included_files_and_those_that_are_missing_are_watched(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The world that names a file which is not there is told of, and loaded when it comes."""
    hands = Hands()
    watching = watched(folder, hands)
    assert watching.told() == f"watching {folder / 'w.yaml'} and 1 file that it names; Ctrl-C ends"
    hands.deeds = [lambda: (folder / "parts.yaml").write_text(PARTS.replace("DENSITY", "55"))]
    assert watching.wait().simulation.world is not None
    hands.deeds = [
        lambda: (folder / "w.yaml").write_text(WORLD.replace("HEIGHT", "1").replace("[parts", "[more.yaml, parts")),
        *[lambda: None] * 5,
        lambda: (folder / "more.yaml").write_text("carom: 1\ngravity: [0, -1, 0]\n"),
    ]
    assert watching.wait().simulation.settings.gravity == (0.0, -1.0, 0.0)
    told = f"include.0: file {folder / 'more.yaml'} does not exist; received 'more.yaml'\n{KEPT}\n"
    assert capsys.readouterr().err.partition(": ")[2] == told


def test_a_run_goes_on_under_a_broken_file_and_ends_for_a_good_one(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The simulation is not touched by who looks; the fault is told with file, line and column."""
    path, hands = folder / "w.yaml", Hands()
    watching = watched(folder, hands)
    loaded = load_world(path)
    steps = {
        3: lambda: path.write_text(WORLD.replace("HEIGHT", "high")),
        9: lambda: path.write_text(WORLD.replace("HEIGHT", "5")),
    }

    class Saving:
        """Somebody who saves the file while the world runs, a look at files a step."""

        def begin(self, simulation: object) -> None:
            """Wait."""

        def observe(self, simulation: object) -> None:
            """Save it."""
            hands.now += 2.0 * INTERVAL
            steps.get(loaded.simulation.frame, lambda: 0)()

        def end(self, simulation: object) -> None:
            """Wait."""

    with pytest.raises(RenewedError) as renewed:
        run(loaded, [Saving(), watching])
    assert loaded.simulation.frame == 10
    assert height(renewed.value.loaded) == 5.0
    fault = "entities.0.transform.position.1: is not a length; received 'high'; accepted: a number in m"
    assert f"w.yaml:4:96: {fault}" in capsys.readouterr().err


def test_runs_follow_each_other_until_ctrl_c(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each of what was saved last; ending is no failure."""
    hands, heights = Hands(), list[float]()
    path = folder / "w.yaml"
    watching = Watching(path, lambda: load_world(path), clock=lambda: hands.now, sleep=hands.sleep)

    def leave() -> None:
        raise KeyboardInterrupt

    hands.deeds = [
        lambda: None,
        lambda: path.write_text(WORLD.replace("HEIGHT", "2.5")),
        lambda: None,
        lambda: None,
        leave,
    ]

    def run_it(loaded: LoadedWorld) -> int:
        heights.append(height(loaded))
        return 0

    assert keep_running(watching, run_it) == 0
    assert heights == [1.0, 2.5]
    assert capsys.readouterr().err == 2 * f"watching {path} and 1 file that it names; Ctrl-C ends\n"


def test_a_world_that_is_broken_at_first_is_waited_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing is kept then, and nothing ends."""
    path = folder / "w.yaml"
    path.write_text("carom: 1\nspeed: 3\n")
    hands = Hands(lambda: None, lambda: None, lambda: path.write_text(WORLD.replace("HEIGHT", "4")))
    watching = Watching(path, lambda: load_world(path), clock=lambda: hands.now, sleep=hands.sleep)
    assert height(watching.wait()) == 4.0
    told = capsys.readouterr().err.split("\n")
    assert told[0].startswith(f"{path}:2:1: speed: unknown key; received 'speed'; accepted: carom, name, ")
    assert told[1:] == ["it is tried again when it is saved", ""]


def test_watching_and_comparing_do_not_go_together(capsys: pytest.CaptureFixture[str]) -> None:
    """Said in one line."""
    assert main(["run", "bounce", "--watch", "--compare", "integrator=euler,verlet"]) == 2
    told = "--compare: shows futures of a world that stays as it is; leave out --watch\n"
    assert capsys.readouterr().err == told


def test_the_command_shows_what_is_saved(folder: Path) -> None:
    """From one process to its end: it runs, the file is saved, it runs anew, Ctrl-C ends it."""
    world, out = folder / "w.yaml", folder / "out.yaml"
    words = [
        sys.executable,
        "-m",
        "carom.tools.cli",
        "run",
        str(world),
        "--watch",
        "--frames",
        "2",
        "--write",
        str(out),
    ]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        late = Timer(PATIENCE, process.kill)
        late.start()
        try:
            until_it_waits(process)
            world.write_text(WORLD.replace("HEIGHT", "7"))
            until_it_waits(process)
            process.send_signal(signal.SIGINT)
            assert process.wait() == 0
        finally:
            late.cancel()
            process.kill()
    assert abs(height(load_world(out)) - 7.0) < 0.01


def until_it_waits(process: subprocess.Popen[str]) -> None:
    """Return when a process waits for its world to be saved."""
    assert process.stderr is not None
    assert any(line.startswith("watching ") for line in iter(process.stderr.readline, "")), "it has ended"
