"""Renderer: pictures, depths and entity ids of batches, without a screen."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Integers
from carom.ecs.errors import CaromError
from carom.tools import offscreen
from carom.tools.batch import Batch
from carom.tools.cameras import Camera

SKY = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])  # covers the picture, in its own coordinates


class Renderer:
    """Draws batches into pictures of one size (px); `driver` says by what.

    Frames are the same to the last bit for the same batches, camera and driver. Meshes stay on the graphics side as
    long as the same vertex and face arrays come again. Close it when done, or use it in a ``with`` statement.
    """

    def __init__(self, width: int = 640, height: int = 480) -> None:
        if width < 1 or height < 1:
            raise CaromError(f"renderer: width and height must be at least 1 px, received {width} x {height}")
        self.width, self.height = width, height
        pyrender = offscreen.load()
        self._platform = offscreen.context(width, height)
        self.driver = offscreen.driver()

        from carom.tools.passes import Passes

        self._passes = Passes(width, height)
        self._flags = pyrender.RenderFlags
        self._mesh = pyrender.Mesh
        self._scene = pyrender.Scene()
        sun = pyrender.DirectionalLight()
        sun._generate_shadow_texture(self._passes.shadow_texels)
        self._scene.add(sun)
        self._eye = self._scene.add(pyrender.PerspectiveCamera(yfov=1.0))
        self._sky = self._scene.add(pyrender.Mesh([pyrender.Primitive(positions=SKY)]))
        self._drawn: dict[tuple[int, ...], tuple[Batch, Any]] = {}

    def picture(self, batches: Sequence[Batch], camera: Camera) -> npt.NDArray[np.uint8]:
        """Return the picture (height, width, 3), red green blue, first row on top."""
        colors: npt.NDArray[np.uint8] = self._draw(batches, camera, self._flags.SHADOWS_DIRECTIONAL)
        return colors

    def depth(self, batches: Sequence[Batch], camera: Camera) -> npt.NDArray[np.float32]:
        """Return how far (m, along the camera's -z) what each pixel's centre shows is, (height, width); else inf."""
        _, raw = self._draw(batches, camera, self._flags.SEG)
        near, far = camera.planes
        with np.errstate(divide="ignore"):
            metres = near * far / (far - raw.astype(np.float64) * (far - near))
        return np.where(raw < 1.0, metres, np.inf).astype(np.float32)

    def ids(self, batches: Sequence[Batch], camera: Camera) -> Integers:
        """Return the id (height, width) of what each pixel's centre shows; -1 for background."""
        bytes_, _ = self._draw(batches, camera, self._flags.SEG)
        numbers: Integers = (bytes_.view("<u4")[..., 0] & 0xFFFFFF).astype(np.int64) - 1
        return numbers

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

    def _draw(self, batches: Sequence[Batch], camera: Camera, flags: int) -> Any:
        if self._platform is None:
            raise CaromError("renderer: it was closed; make a new one")
        self._platform.make_current()
        solid, translucent = self._place(batches)
        sky = [] if flags == self._flags.SEG else [self._sky]
        nodes = [*solid, *sky, *translucent]
        bodies = (node.mesh.primitives[0] for node in solid)
        spread = max((body.spread(camera.target) for body in bodies if body.texcoord_0 is None), default=0.0)
        self._passes.see(nodes, camera, spread)
        self._scene.set_pose(self._eye, camera.pose())
        owners = dict.fromkeys(nodes, 0)  # pyrender draws ids of nodes in this map only; ours has them all
        return self._passes.render(self._scene, flags | self._flags.OFFSCREEN, owners)

    def _place(self, batches: Sequence[Batch]) -> tuple[list[Any], list[Any]]:
        """Bring the scene in line with ``batches``; return the solid and the translucent nodes in their order."""
        from carom.tools.instances import Instances

        drawn: dict[tuple[int, ...], tuple[Batch, Any]] = {}
        solid: list[Any] = []
        translucent: list[Any] = []
        for batch in batches:
            if not len(batch.ids):
                continue
            mesh = (id(batch.vertices), id(batch.faces), id(batch.floor), int(batch.smooth))
            key = next((*mesh, n) for n in count() if (*mesh, n) not in drawn)
            known = self._drawn.pop(key, None)
            if known is None:
                node = self._scene.add(self._mesh([Instances(batch)]))
            else:
                node = known[1]
                node.mesh.primitives[0].update(batch)
            drawn[key] = (batch, node)  # with the batch lives its array, so that no other array gets its id
            (translucent if node.mesh.primitives[0].translucent else solid).append(node)
        for _, gone in self._drawn.values():
            self._scene.remove_node(gone)
        self._drawn = drawn
        return solid, translucent
