"""Cameras: those of the world file, fixed and moving, as what they see in every frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Column
from carom.ecs.errors import CaromError
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, text
from carom.tools.recorder.stream import Stamp, Stream, own_path
from carom.tools.rigs import Rig

ROOT = "world/cameras"
COLOR = (150, 190, 255)
STANDS = ("position", "target", "up")
NEAR = 0.15  # of the distance to the target, at which the picture of a camera is drawn


class Cameras(RowTrack):
    """A pinhole for each camera, or for parallel light the box it sees; one whose entity is gone is cleared.

    There are rows of those that moved. They are hidden at first, since the view of the world begins at one of them.
    """

    key: ClassVar[str] = "cameras"
    path: ClassVar[str] = "cameras"
    sparse: ClassVar[bool] = True
    columns: ClassVar[Mapping[str, Column]] = {
        "camera": text("its name in the world file"),
        "position": Transform.columns["position"],
        "rotation": Transform.columns["rotation"],
    }

    def __init__(self, rigs: Sequence[Rig] = (), aspect: float = 4 / 3) -> None:
        super().__init__()
        self._rigs, self._aspect = rigs, aspect
        self._found: dict[str, Camera] = {}
        self._moved: list[str] = []

    def silent(self, simulation: Simulation) -> bool:
        """Tell whether there are none."""
        return not self._rigs

    def lay_out(self, world: World, layout: Layout) -> None:
        """Hide them."""
        if self._rigs:
            layout.hide(ROOT)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep where each camera is; write the lens of one that is new or zooms, and clear one that is no more."""
        import rerun

        before, self._found = self._found, {}
        for rig in self._rigs:
            with suppress(CaromError):  # who it follows is gone
                still = None if rig.moves else before.get(rig.name)
                self._found[rig.name] = still or rig.camera(simulation.world)
        for name, camera in self._found.items():
            if name not in before or (camera.fov, camera.height) != (before[name].fov, before[name].height):
                stream.row(place(name), stamp, *self._lens(camera))
        for name in before.keys() - self._found.keys():
            stream.row(place(name), stamp, rerun.Clear(recursive=False))
        self._moved = [name for name, camera in self._found.items() if camera != before.get(name)]
        super().sample(simulation, stamp, stream)

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return where the cameras are that have moved."""
        if not self._moved:
            return None
        moved = [self._found[name] for name in self._moved]
        position, target, up = (np.array([getattr(camera, key) for camera in moved]) for key in STANDS)
        rotation = quaternion.look_at(target - position, up)
        return {"camera": np.array(self._moved), "position": position, "rotation": rotation}

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Write the pose of each at its own path."""
        import rerun

        names, stamps = block.columns["camera"], np.repeat(np.arange(len(block.stamps)), block.counts)
        for name in np.unique(names).tolist():
            rows = np.nonzero(names == name)[0]
            columns = rerun.Transform3D.columns(
                translation=block.columns["position"][rows], quaternion=block.columns["rotation"][rows]
            )
            stream.rows(place(name), [block.stamps[stamp] for stamp in stamps[rows]], columns)
        return ()

    def _lens(self, camera: Camera) -> list[Any]:
        """Return what a camera sees, in its own frame: it looks along -z."""
        import rerun

        if camera.height is None:
            lens = rerun.Pinhole(
                fov_y=camera.fov,
                aspect_ratio=self._aspect,
                camera_xyz=rerun.ViewCoordinates.RUB,
                image_plane_distance=NEAR * camera.distance,
                color=COLOR,
            )
            return [lens]
        half = camera.reach * self._aspect, camera.reach, camera.distance / 2.0
        return [rerun.Boxes3D(centers=[(0.0, 0.0, -half[2])], half_sizes=[half], colors=[COLOR])]


def place(name: str) -> str:
    """Return the path of a camera."""
    return own_path(ROOT, name)
