"""Ghosts stand where an oracle says, in pictures and in recordings, and errors against it are plotted."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from carom.ecs import Transform
from carom.systems.simulation import Simulation
from carom.tools.filming import photograph, shot_of
from carom.tools.painter import Painter
from carom.tools.reading import read
from carom.tools.recorder.of_world import recorder_of
from carom.tools.recording import Recording
from carom.tools.session import run
from carom.tools.view import View
from carom.worlds import load_text

WORLD = """carom: 1
gravity: [0, 0, 0]
run: {frames: 30}
step: {dt: 1/60}
entities:
  - {name: crate, collider: {box: {size: [0.4, 0.4, 0.4]}}, body: {}, material: {color: red}, motion: {linear: [1, 0, 0], angular: [0, 1, 0]}}
  - {name: lid, collider: {sphere: {radius: 0.1}}, parent: {entity: crate, position: [0, 0.3, 0]}}
  - {name: post, collider: {sphere: {radius: 0.2}}, transform: {position: [0, 0, -2]}}
oracle:
  crate: {position: [1 m/s * t, 2 m * t / 1 s, 0]}
cameras: {main: {position: [0.5, 0.5, 5], target: [0.5, 0.5, 0]}}
render: {width: 160, height: 120}
"""  # noqa: E501


def test_copies_are_moved_with_all_that_belongs_to_a_body() -> None:
    """After half a second 1 m above, turned as the crate is, in its colours but paler; at the start they hide."""
    loaded = load_text(WORLD)
    painter = Painter(loaded.simulation, shot_of(loaded).look)
    world = loaded.simulation.world
    assert drawn(painter, loaded.simulation) == []
    loaded.simulation.step(30)
    found = {world.name(world.entity(row)): (pose, color) for row, pose, color in drawn(painter, loaded.simulation)}
    assert sorted(found) == ["crate", "lid"]
    here = {row: pose for batch in painter.batches() for row, pose in zip(batch.ids, batch.poses, strict=True)}
    for name, (pose, color) in found.items():
        own = here[world.row(world.find(name))]
        assert pose[:3, 3] - own[:3, 3] == pytest.approx((0.0, 1.0, 0.0), abs=1e-12)
        assert (pose[:3, :3] == own[:3, :3]).all()
        assert color[3] == pytest.approx(0.45)


def drawn(painter: Painter, simulation: Simulation) -> list[tuple[int, np.ndarray, np.ndarray]]:
    """Return row, pose and colour of each copy that a picture has."""
    ghosts = painter.ghosts(simulation.world[Transform], simulation.time, 0.005)
    return [item for batch in ghosts for item in zip(batch.ids.tolist(), batch.poses, batch.colors, strict=True)]


def test_a_picture_shows_the_copy(tmp_path: Path) -> None:
    """Where it stands a picture is redder than without an oracle, and hardly anywhere else another."""
    pictures = []
    for text in (WORLD, WORLD.replace("oracle:\n  crate: {position: [1 m/s * t, 2 m * t / 1 s, 0]}\n", "")):
        loaded = load_text(text)
        loaded.simulation.step(30)
        shot = shot_of(loaded)
        photograph(shot, loaded.simulation, tmp_path / "picture.png")
        pictures.append(np.asarray(Image.open(tmp_path / "picture.png"), np.int64))
    changed = np.abs(pictures[0] - pictures[1]).max(axis=2) > 16
    camera = shot.camera(loaded.simulation.world)
    x, y = View(camera, 160, 120).pixels(np.array([[0.5, 1.0, 0.0]]))[0, :2].astype(int)
    assert changed[y, x]
    redder = (pictures[0] - pictures[1])[y, x]
    assert redder[0] - redder[2] > 40
    rows, columns = np.nonzero(changed)
    assert np.mean((abs(rows - y) < 20) & (abs(columns - x) < 20)) > 0.9  # and a little shadow


def test_recorded_copies_and_errors_are_what_formulas_say(tmp_path: Path) -> None:
    """Poses below the oracle's name as Rerun keeps them, and the error of every frame; no table counts them twice."""
    loaded = load_text(WORLD)
    path = tmp_path / "run.rrd"
    run(loaded, [recorder_of(loaded, shot_of(loaded), path)])
    recording = Recording(path)
    crate = int(loaded.simulation.world.find("crate"))
    errors = recording.plot("plots/error/crate")
    assert errors == pytest.approx({frame: 2.0 * frame / 60.0 for frame in range(31)}, abs=1e-12)
    series = read(path).series
    for frame in (0, 12, 30):
        places = series["/world/ghosts/oracle/box/crate", "InstancePoses3D:translations"].at(frame)[1]
        assert places == pytest.approx(np.array([[frame / 60.0, 2.0 * frame / 60.0, 0.0]]), abs=1e-6)
        assert recording.poses(frame)[crate].position == pytest.approx((frame / 60.0, 0.0, 0.0), abs=1e-6)
    assert series["/world/ghosts/oracle/box/crate", "ghost_of"].at(30)[1].tolist() == [crate]
    assert set(recording.names(30).values()) == {"crate", "lid", "post"}


def test_a_world_without_an_oracle_records_none(tmp_path: Path) -> None:
    """Neither copies nor errors, nor a plot for them."""
    loaded = load_text(WORLD.replace("oracle:\n  crate: {position: [1 m/s * t, 2 m * t / 1 s, 0]}\n", ""))
    path = tmp_path / "run.rrd"
    run(loaded, [recorder_of(loaded, shot_of(loaded), path)], frames=3)
    assert not [name for name, _ in read(path).series if "ghost" in name or "error" in name]
