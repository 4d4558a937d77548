"""Renderer: pictures, depths and entity ids of batches, without a screen."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import count
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Integers
from carom.ecs.errors import CaromError
from carom.tools import offscreen
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.detail import in_detail
from carom.tools.marks import Mark
from carom.tools.picture_size import refuse_size
from carom.tools.view import View

SKY = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])  # covers the picture, in its own coordinates


class Renderer:
    """Draws batches into pictures of one size (px); `driver` says by what.

    Frames are the same to the last bit for the same batches, camera and driver. Meshes stay on the graphics side as
    long as the same vertex and face arrays come again. Without ``shadows`` or ``antialiasing`` pictures take about half
    the time each. Close it when done, or use it in a ``with`` statement.
    """

    def __init__(self, width: int = 640, height: int = 480, *, shadows: bool = True, antialiasing: bool = True) -> None:
        pyrender = offscreen.load()
        self._platform = offscreen.context()
        self.driver = offscreen.driver()
        try:
            refuse_size(width, height, offscreen.largest())
        except CaromError:
            self._platform.delete_context()
            raise
        self.width, self.height = width, height

        from carom.tools.passes import Passes

        self._passes = Passes(width, height, antialiasing=antialiasing)
        if not self._passes.reserve():
            self.close()
            raise CaromError(f"renderer: the driver has no room for {width} x {height} px; ask for a smaller picture")
        self._flags = pyrender.RenderFlags
        self._lights = self._flags.SHADOWS_DIRECTIONAL if shadows else self._flags.NONE
        self._mesh = pyrender.Mesh
        self._scene = pyrender.Scene()
        sun = pyrender.DirectionalLight()
        sun._generate_shadow_texture(self._passes.shadow_texels)
        self._scene.add(sun)
        self._eye = self._scene.add(pyrender.PerspectiveCamera(yfov=1.0))
        self._sky = self._scene.add(pyrender.Mesh([pyrender.Primitive(positions=SKY)]))
        self._drawn: dict[tuple[int, ...], tuple[Batch, Any]] = {}

    def picture(self, batches: Sequence[Batch], camera: Camera, marks: Sequence[Mark] = ()) -> npt.NDArray[np.uint8]:
        """Return the picture (height, width, 3), red green blue, first row on top; ``marks`` are drawn over it."""
        return self.pictures(batches, [camera], [marks])[0]

    def pictures(
        self, batches: Sequence[Batch], cameras: Sequence[Camera], marks: Sequence[Sequence[Mark]] | None = None
    ) -> list[npt.NDArray[np.uint8]]:
        """Return for each camera the `picture` that it would take alone; meshes are brought to the graphics once.

        Where nothing is small enough to be drawn coarser, shadows are drawn once for cameras after each other that see
        as much around one target. ``marks`` are those of each camera.
        """
        pictures: list[npt.NDArray[np.uint8]] = []
        placed: list[Batch] | None = None
        for camera in cameras:
            parts = self._in_detail(batches, camera)
            if parts != placed:
                nodes, placed = self._place(parts), parts
            pictures.append(self._draw(nodes, camera, self._lights))
        for colors, camera, over in zip(pictures, cameras, marks or [()] * len(cameras), strict=True):
            if over:
                from carom.tools.drawing import draw

                draw(colors, View(camera, self.width, self.height), over, partial(self._survey, batches, camera))
        return pictures

    def depth(self, batches: Sequence[Batch], camera: Camera) -> npt.NDArray[np.float32]:
        """Return how far (m, along the camera's -z) what each pixel's centre shows is, (height, width); else inf."""
        _, raw = self._survey(batches, camera)
        return np.where(raw < 1.0, camera.metres(raw), np.inf).astype(np.float32)

    def ids(self, batches: Sequence[Batch], camera: Camera) -> Integers:
        """Return the id (height, width) of what each pixel's centre shows; -1 for background."""
        return self._survey(batches, camera)[0]

    def close(self) -> None:
        """Free the context and all that was drawn in it."""
        if self._platform is not None:
            self._platform.make_current()
            self._passes.delete()
            self._platform.delete_context()
            self._platform = None

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *fault: object) -> None:
        self.close()

    def _survey(self, batches: Sequence[Batch], camera: Camera) -> tuple[Integers, npt.NDArray[np.float32]]:
        """Return the ids and the raw depths, 0 near and 1 far."""
        bytes_, raw = self._draw(self._place(self._in_detail(batches, camera)), camera, self._flags.SEG)
        return (bytes_.view("<u4")[..., 0] & 0xFFFFFF).astype(np.int64) - 1, raw

    def _draw(self, nodes: Sequence[Any], camera: Camera, flags: int) -> Any:
        """Draw what stands nearest first, since it hides most of the rest, then sky, then what shines through."""
        solid: list[Any] = []
        floors: list[Any] = []
        translucent: list[Any] = []
        for node in nodes:
            instances = node.mesh.primitives[0]
            instances.arrange(camera)
            (translucent if instances.translucent else solid if instances.texcoord_0 is None else floors).append(node)
        translucent.sort(key=lambda node: -node.mesh.primitives[0].away)
        sky = [] if flags == self._flags.SEG else [self._sky]
        ordered = [*solid, *floors, *sky, *translucent]
        self._passes.see(ordered, camera)
        self._scene.set_pose(self._eye, camera.pose())
        owners = dict.fromkeys(ordered, 0)  # pyrender draws ids of nodes in this map only; ours has them all
        return self._passes.render(self._scene, flags | self._flags.OFFSCREEN, owners)

    def _in_detail(self, batches: Sequence[Batch], camera: Camera) -> list[Batch]:
        return [part for batch in batches for part in in_detail(batch, camera, self.height)]

    def _place(self, batches: Sequence[Batch]) -> list[Any]:
        """Make the context current, bring the scene in line with ``batches`` and return their nodes."""
        if self._platform is None:
            raise CaromError("renderer: it was closed; make a new one")
        self._platform.make_current()
        from carom.tools.instances import Instances

        drawn: dict[tuple[int, ...], tuple[Batch, Any]] = {}
        for batch in batches:
            if not len(batch.ids):
                continue
            mesh = (id(batch.vertices), id(batch.faces), id(batch.floor), id(batch.finish), int(batch.smooth))
            key = next((*mesh, n) for n in count() if (*mesh, n) not in drawn)
            known = self._drawn.pop(key, None)
            if known is None:
                node = self._scene.add(self._mesh([Instances(batch)]))
            else:
                node = known[1]
                node.mesh.primitives[0].take(batch)
            drawn[key] = (batch, node)  # with the batch lives its array, so that no other array gets its id
        for _, gone in self._drawn.values():
            self._scene.remove_node(gone)
        self._drawn = drawn
        self._passes.cast()
        return [node for _, node in drawn.values()]
