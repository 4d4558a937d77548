"""Recordings are simulated again bit for bit, from themselves alone."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh
from replays import BALLS, record, replayed

from carom.ecs import Motion, state_hash
from carom.tools.cli import main
from carom.tools.replay import Replay
from carom.worlds import library, load_text, load_world

SHORT = {"billiards": 0.5, "bowling": 0.1, "dominoes": 0.4}  # s; more of them takes a minute
QUICK = ("billiards", "robot_arm", "trap")  # the other worlds take longer
ALL = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in library.names()]


@pytest.mark.parametrize("name", ALL)
def test_every_library_world_is_replayed_bit_for_bit(name: str, tmp_path: Path) -> None:
    """From its beginning, and from any snapshot on."""
    loaded = load_world(name)
    frames = min(loaded.run.frames, round(SHORT.get(name, 2.0) / loaded.simulation.settings.dt))
    hashes = record(loaded, tmp_path / "a.rrd", frames)
    verdict = replayed(tmp_path / "a.rrd")
    assert (verdict.same, verdict.full, verdict.changes, verdict.notes) == (True, frames, [], [])
    replay = Replay(tmp_path / "a.rrd")
    assert {0, frames} <= replay.states.keys()
    for frame in replay.states.keys() - {frames}:
        simulation = replay.simulation_at(frame)
        simulation.step(min(3, frames - frame))
        assert state_hash(simulation.world) == hashes[simulation.frame]


def test_any_frame_can_be_gone_to_and_on_from(tmp_path: Path) -> None:
    """Also those between snapshots and between recorded frames, and with sleepers."""
    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 300)
    for frame in (0, 1, 119, 120, 121, 299, 300):
        simulation = Replay(tmp_path / "a.rrd").simulation_at(frame)
        assert state_hash(simulation.world) == hashes[frame]
    simulation = Replay(tmp_path / "a.rrd").simulation_at(250)
    assert simulation["right"].motion.asleep
    simulation.step(50)
    assert state_hash(simulation.world) == hashes[300]


def test_settings_of_the_command_line_are_replayed(tmp_path: Path) -> None:
    """With them the world is another than its file alone makes."""
    loaded = load_text(BALLS, dt=1 / 90, collision="fcl", integrator="semi_implicit", seed=7, gravity=(0.0, -1.6, 0.0))
    record(loaded, tmp_path / "a.rrd", 60)
    assert replayed(tmp_path / "a.rrd").same
    assert Replay(tmp_path / "a.rrd").loaded().simulation.settings == loaded.simulation.settings


def test_nothing_beside_the_recording_is_needed(tmp_path: Path) -> None:
    """The files a world names travel along, wherever they lay; nothing of them is written beside the recording."""
    box = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "worlds").mkdir()
    (tmp_path / "tip.obj").write_text(box)
    body = "{name: tip, collider: {convex: {file: ../tip.obj}}, body: {}, transform: {position: [0, 1, 0]}}"
    (tmp_path / "worlds" / "a.yaml").write_text(f"carom: 1\nentities: [{body}]\n")
    record(load_world(tmp_path / "worlds" / "a.yaml"), tmp_path / "a.rrd", 70)
    (tmp_path / "tip.obj").unlink()
    (tmp_path / "worlds" / "a.yaml").unlink()
    assert Replay(tmp_path / "a.rrd").files == {"../tip.obj": box.encode()}
    assert replayed(tmp_path / "a.rrd").same
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.rrd", "worlds"]


def test_files_that_named_files_name_travel_along(tmp_path: Path) -> None:
    """A .gltf with its buffer and a picture beside it, in a folder whose name has a blank."""
    folder = tmp_path / "a model"
    folder.mkdir()
    for name, content in trimesh.exchange.gltf.export_gltf(trimesh.Scene(trimesh.creation.icosphere(2))).items():
        (folder / name).write_bytes(content)
    model = json.loads((folder / "model.gltf").read_text())
    model["images"] = [{"uri": "a%20picture.png"}, {"uri": "gone.png"}]
    (folder / "a picture.png").write_bytes(b"picture")
    (folder / "model.gltf").write_text(json.dumps(model))
    body = "{name: ball, collider: {convex: {file: a model/model.gltf}}, body: {}, transform: {position: [0, 2, 0]}}"
    (tmp_path / "a.yaml").write_text(f"carom: 1\nentities: [{body}, {{name: floor, collider: {{plane: {{}}}}}}]\n")
    record(load_world(tmp_path / "a.yaml"), tmp_path / "a.rrd", 70)
    shutil.rmtree(folder)
    held = json.loads(Replay(tmp_path / "a.rrd").files["a model/model.gltf"])
    assert [image["uri"] for image in held["images"]] == ["data:image/png;base64,cGljdHVyZQ==", "gone.png"]
    assert replayed(tmp_path / "a.rrd").same


def test_some_frames_are_recorded_again_in_every_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What comes out is a recording like any other, which begins in the middle."""
    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 300)
    part = tmp_path / "made" / "part.rrd"
    assert main(["replay", str(tmp_path / "a.rrd"), "--from", "130", "--to", "142", "--out", str(part)]) == 0
    assert capsys.readouterr().out == (
        f"{tmp_path / 'a.rrd'}: frames 130 to 142 simulated again: the same, "
        f"bit for bit up to frame 130, then in every recorded pose, rounded to float32\n  recording  {part}\n"
    )
    again = Replay(part)
    assert again.recording.frames == list(range(130, 143))
    assert (again.title, again.source) == ("two balls", BALLS)
    assert [(saved.frame, saved.hash) for saved in again.states.values()] == [(130, hashes[130]), (142, hashes[142])]
    assert main(["replay", str(part)]) == 0
    assert capsys.readouterr().out == f"{part}: frames 130 to 142 simulated again: the same, bit for bit\n"


def test_the_replay_stays_free_of_the_recording(tmp_path: Path) -> None:
    """A simulation of it is the user's own."""
    record(load_text(BALLS), tmp_path / "a.rrd", 40)
    replay = Replay(tmp_path / "a.rrd")
    mine = replay.simulation_at(20)
    mine["left"].motion.linear = (9.0, 0.0, 0.0)
    mine.step(20)
    other = replay.simulation_at(40)
    assert not np.array_equal(mine.world[Motion].linear, other.world[Motion].linear)
