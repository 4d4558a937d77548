"""``carom fork``: from a frame of a recording on, what was, to the bit, and beside it what would have been."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from carom.ecs import Motion, state_hash
from carom.systems.observer import observed
from carom.tools.cli import main
from carom.tools.forking import fork
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.tools.replay import Replay
from carom.worlds import load_text, load_world

SLIDE = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/100}
run: {duration: 1.3 s}
entities:
  - {name: floor, collider: {plane: {}}, material: {friction: {value: 1, combine: multiply}}}
  - name: crate
    collider: {box: {size: [2, 0.1, 2]}}
    body: {mass: 2}
    material: {friction: {value: 0.4, combine: multiply}}
    transform: {position: [0, 0.05, 0]}
    motion: {linear: [10, 0, 0]}
"""


@pytest.fixture
def recording(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a recording of a crate that slides, pushed once from outside."""
    monkeypatch.chdir(tmp_path)
    Path("slide.yaml").write_text(SLIDE)
    loaded = load_world("slide.yaml")
    simulation, recorder = loaded.simulation, Recorder("slide.rrd", source=loaded.source_text)
    with observed(simulation, recorder):
        for frame in range(1, 131):
            if frame == 90:
                with simulation.world.edit(Motion) as motion:
                    motion.linear[simulation.world.row(simulation.world.find("crate")), 2] = 1.0
            simulation.step()
    return Path("slide.rrd")


def test_the_unchanged_branch_is_the_recording(recording: Path) -> None:
    """Bit for bit, what code outside did included: by itself, and as a branch that changes a number to itself."""
    forks = fork(Replay(recording), 50, [["crate.material.friction *= 1", "gravity.y += 0"]])
    assert forks.verdict.same and (forks.verdict.first, forks.verdict.last) == (50, 150)
    first, branch = forks.futures.futures
    alone = Replay(recording).simulation_at(130)
    assert branch.parting is None and branch.simulation.frame == 150
    alone.step(20)
    assert state_hash(first.simulation.world) == state_hash(branch.simulation.world) == state_hash(alone.world)


def test_half_the_friction_parts_from_that_frame_on_as_the_formula_says(recording: Path) -> None:
    """Decelerations mu g are 4 and 2 m/s2: (4 - 2) t^2 / 2 apart after t, from the frame on and not before."""
    forks = fork(Replay(recording), 50, [["crate.material.friction *= 0.5"]], until=0.89, out=Path("forks.rrd"))
    first, branch = forks.futures.futures
    assert branch.parting is not None
    assert (branch.parting.frame, branch.parting.entity) == (51, "crate")
    ahead = (branch.path() - first.path())[:, 0, 0]
    t = np.arange(40) * 0.01
    assert len(ahead) == 40 and ahead[0] == 0.0
    assert np.abs(ahead - t**2).max() < 2e-3
    speed = branch.simulation["crate"].motion.linear[0] - first.simulation["crate"].motion.linear[0]
    assert speed == pytest.approx(2 * 0.39, rel=2e-3)
    recorded = Recording(Path("forks.rrd"))
    assert (recorded.frames[0], recorded.frames[-1]) == (50, 89)
    assert Replay("forks.rrd").first == 50
    (group,) = {name for name, part in read(Path("forks.rrd")).series if "ghosts" in name and part == "ghost_of"}
    assert "friction" in group


def test_the_command_tells_where_they_part(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A table of what becomes of each, the command that opens it, and the same for programs."""
    words = ["fork", "slide.rrd", "--frame", "50", "--until", "0.8 s"]
    words += ["--set", "crate.mass *= 2", "--set", "gravity.y *= 0.5", "--branch", "crate.linear.z = 1 m/s; dt /= 2"]
    assert main([*words, "--out", "forks.rrd"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "slide.rrd: futures from frame 50 to 80; the unchanged one is the recording, bit for bit",
        "  crate.mass *= 2; gravity.y *= 0.5: parts in frame 51 at 0.51 s: 'crate' by 0.000125 m",
        "  crate.linear.z = 1 m/s; dt /= 2: parts in frame 51 at 0.51 s: 'crate' by 0.00997 m",
        "future                             energy     since the start  farthest from the recording",
        "the recording                      47.24 J    -17.8 J          -",
        "crate.mass *= 2; gravity.y *= 0.5  110.52 J   -18.5 J          0.09075 m, crate",
        "crate.linear.z = 1 m/s; dt /= 2    48.0906 J  -17.9 J          0.2776 m, crate",
        "open it with: carom view forks.rrd --frame 51",
    ]
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["frame"], told["last"], told["same"], told["out"]) == (50, 80, True, None)
    assert [future["name"] for future in told["futures"]] == ["the recording", "crate.mass *= 2; gravity.y *= 0.5", "crate.linear.z = 1 m/s; dt /= 2"]  # fmt: skip
    assert told["futures"][2]["parting"]["frame"] == 51


def test_a_body_that_lives_in_one_future_only_is_told_as_that(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Code outside adds and removes one: a recording shows what became of it, and branches do not have it done."""
    monkeypatch.chdir(tmp_path)
    for name, act in (
        ("comes", lambda simulation: simulation.add(name="coin", body={}, collider={"sphere": {"radius": 0.1}})),
        ("goes", lambda simulation: simulation.world.despawn(simulation.world.find("crate"))),
    ):
        loaded = load_text(SLIDE)
        simulation, recorder = loaded.simulation, Recorder(f"{name}.rrd", source=loaded.source_text)
        with observed(simulation, recorder):
            simulation.step(89)
            act(simulation)
            simulation.step(41)
    words = ["--frame", "50", "--set", "crate.friction *= 1", "--until", "1.3 s"]
    for name, told in (("comes", "'coin' does not live there"), ("goes", "'crate' lives only there")):
        assert main(["fork", f"{name}.rrd", *words]) == 1
        assert f"  crate.friction *= 1: parts in frame 90 at 0.9 s: {told}" in capsys.readouterr().out.splitlines()
    assert main(["fork", "goes.rrd", *words, "--json"]) == 1
    parting = json.loads(capsys.readouterr().out)["futures"][1]["parting"]
    assert parting == {"frame": 90, "time": pytest.approx(0.9), "entity": "crate", "metres": None, "lives": True}


def test_what_another_dt_leaves_out_is_told(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Steps of which code outside did something are not there; of others nothing is left out."""
    words = ["fork", "slide.rrd", "--frame", "50", "--branch", "dt /= 2", "--branch", "gravity.y *= 1"]
    assert main([*words, "--until", "1.3 s"]) == 0
    note = "dt /= 2: what code outside did before frame 90 is not done again there, since its steps are others"
    assert [line for line in capsys.readouterr().out.splitlines() if "note" in line] == [f"  note: {note}"]
    assert main([*words, "--until", "0.8 s", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["notes"] == []


def test_what_cannot_be_forked_is_refused(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With whole messages, before anything is written."""
    for words, message in (
        ("--frame 50", "--set: states what is changed, such as --set 'crate.material.friction *= 0.5'"),
        ("--frame 999 --set gravity.y=1", "slide.rrd does not hold frame 999, but frames 0 to 130"),
        ("--frame 50 --set gravity.y=1 --until 0.5s", "--until: must come after frame 50 at 0.5 s; received 0.5 s"),
        ("--frame 50 --set gravity.y=1 --out slide.rrd", "slide.rrd is the recording itself; write another file"),
        (
            "--frame 50 --set gravty.y=1 --out new.rrd",
            "--set: gravty.y=1: unknown entity; received 'gravty'; accepted: floor, crate; did you mean 'gravity'?",
        ),
    ):
        assert main(["fork", "slide.rrd", *words.split()]) == 2
        assert capsys.readouterr().err == f"{message}\n"
    assert not Path("new.rrd").exists()
