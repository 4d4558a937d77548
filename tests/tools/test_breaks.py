"""``carom run --break`` stops before the bad step, tells who and where, and leaves a recording or opens a prompt."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from carom.systems.breakpoints import StoppedError
from carom.systems.simulation import Simulation
from carom.tools.cli import main
from carom.tools.recording import Recording
from carom.tools.replay import Replay
from carom.worlds import load_text
from carom.worlds.breaks import break_when

WORLD = """
carom: 1
name: drop
step: {dt: 1/100}
run: {duration: 3 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: ball
    collider: {sphere: {radius: 0.1}}
    body: {mass: 1}
    material: {restitution: 0.8}
    transform: {position: [0, 5, 0]}
"""
FALLS = "ball.position.y < 2"  # g t^2 / 2 = 3 m at 0.782 s
STOPPED = f"frame 79 at 0.79 s: {FALLS}: ball.position.y = 1.9387895 m; the world stands at frame 78, before that step"
WHO = "'ball' at [0, 1.93879, 0] m, moving at [0, -7.7499, 0] m/s"


def test_a_break_tells_who_where_and_the_command_that_opens_it(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a recording that is a prompt on the world; options of the run are among its words."""
    assert main(["run", str(world), "--break", FALLS, "--seed", "3"]) == 1
    command = f"carom run {world} --break '{FALLS}' --seed 3 --pdb"
    assert capsys.readouterr().out == f"{STOPPED}\n  {world}:8:5: {WHO}\nopen it with: {command}\n"


@pytest.mark.parametrize("ring", [[], ["--ring", "0.3 s"]])
def test_the_step_that_broke_is_the_last_that_is_recorded(
    ring: list[str], world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Though an odd frame is none of the 60 a second; the recording is replayed bit for bit."""
    path = tmp_path / "rec.rrd"
    assert main(["run", str(world), "--break", FALLS, "--record", str(path), *ring]) == 1
    assert capsys.readouterr().out.endswith(f"\nopen it with: carom view {path} --frame 79 --select ball\n")
    recording = Recording(path)
    assert recording.frames[-1] == 79
    assert (recording.frames[0] >= 30) is bool(ring)
    height = recording.table("bodies").polars().filter(name="ball", frame=79)["position.y"].item()
    assert height == pytest.approx(1.9387895, rel=1e-6)
    assert main(["replay", str(path)]) == 0
    assert Replay(path).last == 79


def test_a_break_is_told_to_programs(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With all its parts."""
    assert main(["run", str(world), "--break", FALLS, "--json"]) == 1
    assert json.loads(capsys.readouterr().out) == {
        "stopped": {
            "condition": FALLS,
            "frame": 79,
            "time": 0.79,
            "values": "ball.position.y = 1.9387895 m",
            "entities": ["ball"],
            "files": [f"{world}:8:5"],
            "command": f"carom run {world} --break '{FALLS}' --pdb",
        }
    }


def test_a_prompt_goes_back_and_on(
    world: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By frames, up to the break, and past it; the world is at hand."""
    lines = ["rewind(10); print(simulation.frame)", "step(20); print(simulation.frame)", "go_on(1)"]
    lines += ["print(simulation.frame, stopped.frame, round(world['ball'].transform.position[1], 4), ring.frames)"]
    lines[-1] = lines[-1].replace("world['ball']", "simulation['ball']")
    monkeypatch.setattr("sys.stdin", io.StringIO("\n".join(lines) + "\n"))
    assert main(["run", str(world), "--break", FALLS, "--pdb"]) == 1
    out, err = capsys.readouterr()
    assert out.replace(">>> ", "") == f"68\n{STOPPED}\n78\n79 79 1.9388 [0, 79]\n"
    assert err.startswith(f"{STOPPED}\n  {world}:8:5: {WHO}\n")


def test_a_prompt_opens_before_the_step_that_makes_a_nan(
    world: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the world is still sound; the step again tells the same."""
    world.write_text(WORLD + "forces: [{constant_push: {force: [1e308, 0, 0]}}]")
    monkeypatch.setattr("sys.stdin", io.StringIO("print(simulation.frame + 1 == stopped.frame); step()\n"))
    assert main(["run", str(world), "--break", "not finite", "--pdb"]) == 1
    out, err = capsys.readouterr()
    told = err.splitlines()[0]
    assert told.startswith("frame ")
    assert ", written by system '" in told
    assert out.replace(">>> ", "") == f"True\n{told}\n"


def broken_by(simulation: Simulation, *texts: str) -> StoppedError:
    """Return what a simulation is stopped by."""
    break_when(simulation, *texts)
    with pytest.raises(StoppedError) as stop:
        simulation.step(500)
    return stop.value


def test_overlap_names_both_sides() -> None:
    """A ball pressed into the floor by 1 m/s and no way out is seen at the depth asked for, or it is not."""
    simulation = load_text(WORLD.replace("[0, 5, 0]", "[0, 0.08, 0]")).simulation
    stop = broken_by(simulation, "overlap > 1 cm")
    assert (stop.frame, stop.names) == (1, ["floor", "ball"])
    assert stop.met.values.endswith("m between 'floor' and 'ball'")


def test_energy_that_rises_is_told_with_how_much() -> None:
    """A force of 2 N from frame 51 on pushes down by as much as the ball falls."""
    simulation = load_text(WORLD).simulation
    simulation.force_function(lambda world, rows: [[0.0, -2.0 * (world.frame > 50), 0.0]], "push")
    stop = broken_by(simulation, "energy rises 1 J")
    # Work of 2 N: in frame n (50 + k) the ball has gone g (0.5 k h + ...) further; more than 1 J after 0.5 m.
    fallen = [9.81 * (n * 0.01) ** 2 / 2 for n in range(200)]
    first = next(n for n in range(51, 200) if 2.0 * (fallen[n] - fallen[50]) + 2.0 * ((n - 50) * 0.01) ** 2 > 1.0)
    assert stop.frame == first
    assert stop.names == []
    assert "J above the lowest so far" in stop.met.values


def test_the_first_of_several_entities_is_named() -> None:
    """A pattern means one condition for each."""
    text = WORLD.replace("  - name: ball", "  - name: ball\n    grid: {count: [3, 1, 1], spacing: 1}")
    stop = broken_by(load_text(text).simulation, "ball[*].position.x > 0.5 and ball[*].position.y < 4")
    assert (stop.names, stop.frame) == (["ball[1,0,0]"], 46)


LENGTHS = "a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi"
WRONG = {
    "--pdb": "--pdb: goes with --break CONDITION, at which it opens",
    "overlap > 1 kg": f"must be a length; received '1 kg', which is a mass; accepted: {LENGTHS}",
    "ball.position.w > 1": "position has no w; received 'ball.position.w'; accepted: x, y, z",
    "visible(ball) > 3 px": (
        "asks for a picture in every step; received 'visible(ball) > 3 px'; accepted: conditions on columns"
    ),
}


@pytest.mark.parametrize("words", WRONG)
def test_wrong_words_are_told(words: str, world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With what is accepted, and exit status 2."""
    alone = words == "--pdb"
    assert main(["run", str(world), *([words] if alone else ["--break", words])]) == 2
    assert capsys.readouterr().err == f"{'' if alone else '--break: '}{WRONG[words]}\n"
