"""``carom diff`` and ``carom bisect`` name the frame, the system, the entity and the column in which two runs part."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from plants import plant, spoil_system

from carom.ecs import Force, Motion, World
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.cli import main
from carom.tools.differing import compare
from carom.tools.parted import Comparison
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.tools.side import Side
from carom.worlds import load_text, load_world

WORLD = """
carom: 1
name: NAME
gravity: [0, -9.81, 0]
step: {dt: 1/100}
run: {duration: 3 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: ball
    collider: {sphere: {radius: 0.1}}
    body: {mass: 1}
    material: {restitution: 0.8}
    grid: {count: [3, 1, 1], spacing: 1, origin: [0, 5, 0]}
"""


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of ``sound.yaml`` and ``planted.yaml``, in which this test runs."""
    monkeypatch.chdir(tmp_path)
    for name in ("sound", "planted"):
        Path(f"{name}.yaml").write_text(WORLD.replace("NAME", name))
    return tmp_path


def record(name: str, frames: int = 300, push: int | None = None, speed: float = 1e-300) -> None:
    """Record a world file; one ball is pushed before frame ``push``."""
    loaded = load_world(f"{name}.yaml")
    simulation, recorder = loaded.simulation, Recorder(f"{name}.rrd", source=loaded.source_text)
    with observed(simulation, recorder):
        for frame in range(1, frames + 1):
            if frame == push:
                with simulation.world.edit(Motion) as motion:
                    motion.linear[simulation.world.row(simulation.world.find("ball[1,0,0]")), 0] = speed
            simulation.step()


def nudge(simulation: Simulation) -> None:
    """Let damping push one ball by 1 uN in frame 130 alone."""

    def push(world: World, dt: float) -> None:
        if world.frame == 130:
            world[Force].force[world.row(world.find("ball[2,0,0]")), 2] += 1e-6

    spoil_system(simulation, "apply_damping", after=push)


def test_two_runs_that_are_the_same_end_with_0(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """World against world, against its recording, recording against recording."""
    record("sound")
    for a, b in (("sound.yaml", "planted.yaml"), ("sound.rrd", "planted.yaml"), ("sound.rrd", "sound.rrd")):
        for command in ("diff", "bisect"):
            assert main([command, a, b]) == 0
            assert capsys.readouterr().out == f"{a} and {b}: frames 0 to 300: the same, bit for bit\n"


def test_a_bug_in_one_frame_is_named_with_its_system(
    files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its velocity grows for a whole bounce from what came in once; a recording of both is left."""
    plant(monkeypatch, nudge)
    assert main(["diff", "sound.yaml", "planted.yaml", "--out", "both.rrd"]) == 1
    ulps = int(np.float64(1e-6).view("i8"))
    what = f"Force.force[2] of entity 'ball[2,0,0]' is 0.0 in the first and 1e-06 in the second, {ulps} ulps apart"
    told = capsys.readouterr().out.splitlines()
    assert told[0] == "sound.yaml and planted.yaml: frames 0 to 300: differ; the same up to frame 129"
    assert told[1] == f"  first    frame 130, system 'apply_damping', run 1 in phase 'forces': {what}"
    assert told[2] == "  how      grew: it came in once; from the same state both stay alike in 8 later frames"
    # 1 uN for 10 ms on 1 kg is 1e-8 m/s, after half the way in the first frame for 70 more.
    assert told[3] == "  apart    5e-11 m in frame 130 ('ball[2,0,0]'), 7.05e-09 m in frame 200 ('ball[2,0,0]')"
    assert told[4:] == ["open it with: carom view both.rrd --frame 130"]
    recording = Recording("both.rrd")
    assert (recording.frames[0], recording.frames[-1]) == (100, 230)
    assert any(path.startswith("/world/ghosts/second/") for path, _ in recording._series)
    assert main(["bisect", "sound.yaml", "planted.yaml"]) == 1
    told = capsys.readouterr().out.splitlines()
    by = "system 'apply_damping', run 1 in phase 'forces', is the first after which sound.yaml and planted.yaml differ"
    assert told[:3] == [f"frame 130: {by}", f"  wrote    {what}", "  is in    both"]
    assert "  before   all is the same, up to system 'apply_quadratic_drag'" in told


def test_a_bug_of_every_frame_comes_in_again(files: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the world that has it is given the state of the other, it parts from it again."""

    def drift(simulation: Simulation) -> None:
        def push(world: World, dt: float) -> None:
            world[Force].force[world.row(world.find("ball[0,0,0]")), 0] += 1e-3 * (world.frame > 42)

        spoil_system(simulation, "apply_damping", after=push)

    plant(monkeypatch, drift)
    record("sound")
    record("planted")
    found = compare(Side("sound.rrd"), Side("planted.rrd"))
    assert found.difference is not None
    assert (found.good, found.start, found.difference.frame) == (42, 0, 43)
    assert (found.difference.system, found.difference.entity) == ("apply_damping", "ball[0,0,0]")
    assert found.how == "injected: from the same state both part again in 8 of 8 later frames"
    # 1 mN on 1 kg for 0.58 s is the half of a t^2, but for 0.5 ms after a bounce; friction takes of it later.
    assert [apart.frame for apart in found.apart] == [43, 100, 300]
    assert [apart.metres for apart in found.apart[:2]] == pytest.approx([0.5e-7, 0.5e-3 * 0.58**2], rel=1e-3)


def test_what_code_outside_wrote_is_told(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No system is to blame; what recordings hold of it is done again."""
    record("sound")
    record("planted", push=117)
    assert main(["diff", "sound.rrd", "planted.rrd"]) == 1
    told = capsys.readouterr().out.splitlines()
    ulps = int(np.float64(1e-300).view("i8"))
    assert told[0] == "sound.rrd and planted.rrd: frames 0 to 300: differ; the same up to frame 116"
    assert told[1] == (
        "  first    frame 116, set by code outside before frame 117: Motion.linear[0] of entity 'ball[1,0,0]' is 0.0 "
        f"in the first and 1e-300 in the second, {ulps} ulps apart"
    )
    assert told[2] == "  how      grew: it came in once; from the same state both stay alike in 8 later frames"


def test_what_code_outside_wrote_is_in_the_recording_of_both(files: Path) -> None:
    """The ghost of the second goes where its recording has it: 0.2 m/s from before frame 117 on, in the air."""
    record("sound")
    record("planted", push=117, speed=0.2)
    assert main(["diff", "sound.rrd", "planted.rrd", "--out", "both.rrd"]) == 1
    ghosts = {part: rows for (path, part), rows in read(Path("both.rrd")).series.items() if "ghosts" in path}
    frame, whose = ghosts["ghost_of"].at(200)
    planted = Recording("planted.rrd").poses(200)
    assert frame <= 200
    places = ghosts["InstancePoses3D:translations"].at(200)
    assert places[0] == 200
    assert np.array_equal(places[1], [planted[int(entity)].position for entity in whose])
    pushed = Side("planted.rrd").simulation.world.find("ball[1,0,0]")
    assert planted[pushed].position[0] == pytest.approx(1 + 0.2 * 0.84, rel=1e-6)


def test_a_recording_of_other_code_is_told_where_it_comes_out_otherwise(
    files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As `git bisect run` asks: a recording of sound code against the world by the code of today."""
    loaded = load_text(WORLD)
    nudge(loaded.simulation)
    with observed(loaded.simulation, Recorder("old.rrd", source=loaded.source_text)):
        loaded.simulation.step(300)
    assert main(["diff", "old.rrd", "sound.yaml", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["good"], found["same"], found["reproduced"]) == (100, False, False)
    assert (found["difference"]["frame"], found["difference"]["entity"]) == (200, "ball[2,0,0]")
    assert found["how"] == (
        "not by rules that are here: from frame 100 both go on alike, so that no system can be named; that takes the "
        "code by which they differ, installed where this is run"
    )
    assert found["notes"] == ["old.rrd comes out otherwise here from frame 130 on, where 'ball[2,0,0]' is elsewhere"]


def test_worlds_that_begin_otherwise_differ_from_the_start(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Also what they were told to simulate by is told."""
    text = Path("planted.yaml").read_text()
    Path("planted.yaml").write_text(text.replace("mass: 1", "mass: 2").replace("-9.81", "-9.8"))
    assert main(["diff", "sound.yaml", "planted.yaml", "--out", "both.rrd"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told[0] == "sound.yaml and planted.yaml: frames 0 to 300: differ; they begin otherwise"
    assert told[1].startswith(
        "  first    frame 0: RigidBody.mass of entity 'ball[0,0,0]' is 1.0 in the first and 2.0 in"
    )
    assert told[2:] == [
        "  how      there from the start",
        "  note     gravity is (0.0, -9.81, 0.0) in the first and (0.0, -9.8, 0.0) in the second",
        "neither parts from the other here, so that both.rrd is not written",
    ]


def test_what_is_no_run_ends_with_2(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """So that `git bisect run` does not take it for a difference."""
    assert main(["diff", "sound.yaml", "none.rrd"]) == 2
    assert capsys.readouterr().err == (
        "no recording at none.rrd; make one with: carom run billiards --record none.rrd\n"
    )
    assert isinstance(compare(Side("sound.yaml"), Side("sound.yaml")), Comparison)
