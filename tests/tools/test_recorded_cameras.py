"""All cameras of a world file are recorded as they move: pinholes where their pictures are taken from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.tools.filming import shot_of
from carom.tools.recorder.of_world import recorder_of
from carom.tools.recording import Recording
from carom.tools.rigs import rigs_of
from carom.tools.session import run
from carom.worlds.builder import load_text

WORLD = """
carom: 1
run: {frames: 40}
step: {dt: 1/60}
gravity: [0, 0, 0]
entities:
  - {name: ball, collider: {sphere: {radius: 0.3}}, body: {}, motion: {linear: [1, 2, 0], angular: [0, 3, 0]}}
cameras:
  main: {position: [0, 1, 5], target: [0, 0, 0], fov: 40 deg}
  chase: {follow: {entity: ball, offset: [0, 1, 3], frame: body}}
  round: {orbit: {around: ball, distance: 4, rate: 90 deg/s}}
  side: {position: [9, 0, 0], height: 4}
  zoom: {keyframes: [{at: 0, position: [0, 2, 5], target: [0, 0, 1]}, {at: 9 s, fov: 20 deg}]}
  flight: {keyframes: [{at: 0, position: [0, 1, 5]}, {at: 0.4 s, position: [3, 1, 4]}, {at: 9 s, position: [3, 4, 1]}]}
"""


class Stands:
    """Where every camera is in every frame, as pictures are taken from; the ball goes in frame 31."""

    def __init__(self, rigs: list) -> None:  # type: ignore[type-arg]
        self.rigs, self.poses = rigs, {}

    def begin(self, simulation: Simulation) -> None:
        """See the start."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep the poses of all that can be somewhere."""
        world = simulation.world
        for rig in self.rigs if simulation.frame < 31 else [self.rigs[0], *self.rigs[3:]]:
            self.poses[simulation.frame, rig.name] = rig.camera(world).pose()
        if simulation.frame == 30:
            world.despawn(world.find("ball"))

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""


@pytest.fixture(scope="module")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[tuple[int, str], np.ndarray]]:
    """Return a recording with the poses its cameras had."""
    path = tmp_path_factory.mktemp("cameras") / "run.rrd"
    loaded = load_text(WORLD)
    stands = Stands(rigs_of(loaded))
    run(loaded, [recorder_of(loaded, shot_of(loaded), path), stands])
    return path, stands.poses


def test_every_camera_is_where_pictures_are_taken_from(
    filmed: tuple[Path, dict[tuple[int, str], np.ndarray]],
) -> None:
    """In every frame in which it moved, as long as whom it follows is there."""
    path, poses = filmed
    table = Recording(path).table("cameras").arrow().to_pylist()
    recorded = {(row["frame"], row["camera"]): row for row in table}
    moved = {(frame, name) for frame, name in poses if frame == 0 or name in ("chase", "round", "zoom", "flight")}
    assert recorded.keys() == moved and (30, "chase") in moved and (31, "chase") not in moved
    for key in moved:
        row, pose = recorded[key], poses[key]
        assert [row[f"position.{axis}"] for axis in "xyz"] == pose[:3, 3].tolist()
        turned = quaternion.matrix([row[f"rotation.{axis}"] for axis in "xyzw"])
        assert turned == pytest.approx(pose[:3, :3], abs=1e-12)


def test_each_is_drawn_as_what_it_sees(filmed: tuple[Path, dict[tuple[int, str], np.ndarray]]) -> None:
    """A pinhole with the file's lens, a box where light is parallel, gone with whom it follows."""
    from carom.tools.reading import read

    series = read(filmed[0]).series
    for name in ("main", "chase", "round"):
        (projection,) = series[f"/world/cameras/{name}", "Pinhole:image_from_camera"].values
        (resolution,) = series[f"/world/cameras/{name}", "Pinhole:resolution"].values
        vertical = 2.0 * np.arctan(resolution[0][1] / 2.0 / projection[0][4])
        assert np.degrees(vertical) == pytest.approx(40.0 if name == "main" else 50.0, abs=1e-4)
        assert resolution[0][0] / resolution[0][1] == pytest.approx(4 / 3)
        moved = series[f"/world/cameras/{name}", "Transform3D:translation"]
        at = filmed[1][20, name][:3, 3].astype(np.float32)
        assert np.array_equal(moved.at(20)[1][0], at)
    lenses = series["/world/cameras/zoom", "Pinhole:image_from_camera"]
    heights = series["/world/cameras/zoom", "Pinhole:resolution"]
    assert lenses.frames == list(range(41))
    rig = next(rig for rig in rigs_of(load_text(WORLD)) if rig.name == "zoom")
    vertical = 2.0 * np.arctan(heights.at(20)[1][0][1] / 2.0 / lenses.at(20)[1][0][4])
    assert vertical == pytest.approx(rig.camera(load_text(WORLD).simulation.world, 20 / 60).fov, rel=1e-6)
    (half,) = series["/world/cameras/side", "Boxes3D:half_sizes"].values
    assert half[0] == pytest.approx([4 / 3 * 2.0, 2.0, 4.5])
    assert [series[f"/world/cameras/{name}", "Clear:is_recursive"].frames for name in ("main", "chase", "round")] == [
        [],
        [31],
        [31],
    ]
