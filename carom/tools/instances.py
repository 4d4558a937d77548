"""Instances: one mesh on the graphics side, drawn many times with a pose, a colour and an id for each.

Import this only after `carom.tools.offscreen.load`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pyrender
from OpenGL import GL

from carom.tools.batch import Batch, shading

# pyrender numbers its own vertex attributes from 0 to 8 at most; the shaders name these two by number.
COLOR_ATTRIBUTE = 12
ID_ATTRIBUTE = 13
SMOOTH, DULL = 0.2, 1.0  # roughness, 1 without any reflection: curved things look turned and polished
POSE_BUFFER = 1  # the place of the poses in pyrender's list of buffers


class Instances(pyrender.Primitive):  # type: ignore[misc]
    """A pyrender primitive with a colour and an id per instance; its poses can change from picture to picture."""

    def __init__(self, batch: Batch) -> None:
        shaded = shading(batch.vertices, batch.faces, batch.smooth)
        super().__init__(
            positions=shaded.positions,
            normals=shaded.normals,
            indices=shaded.indices,
            texcoord_0=None if batch.floor is None else batch.floor[shaded.source],
            material=pyrender.MetallicRoughnessMaterial(
                alphaMode="BLEND", roughnessFactor=SMOOTH if batch.smooth else DULL
            ),
        )
        self._radius = float(np.linalg.norm(shaded.positions, axis=1).max(initial=0.0))
        self._take(batch)

    def spread(self, target: tuple[float, float, float]) -> float:
        """Return the radius (m) of a ball around ``target`` that holds every instance."""
        return float(np.linalg.norm(self.poses[:, :3, 3] - target, axis=1).max()) + self._radius

    def _take(self, batch: Batch) -> None:
        self.poses = batch.poses
        self.colors = np.ascontiguousarray(batch.colors, np.float32)
        self.ids = np.ascontiguousarray(batch.ids, np.uint32) + np.uint32(1)
        self.translucent = bool((self.colors[:, 3] < 1.0).any())

    def _add_to_context(self) -> None:
        """Upload everything; pyrender calls this when the mesh is first drawn."""
        super()._add_to_context()
        GL.glBindVertexArray(self._vaid)
        for attribute, kind, width in ((COLOR_ATTRIBUTE, GL.GL_FLOAT, 16), (ID_ATTRIBUTE, GL.GL_UNSIGNED_BYTE, 4)):
            buffer = GL.glGenBuffers(1)
            self._buffers.append(buffer)
            GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
            GL.glEnableVertexAttribArray(attribute)
            GL.glVertexAttribPointer(attribute, 4, kind, True, width, None)
            GL.glVertexAttribDivisor(attribute, 1)
        GL.glBindVertexArray(0)
        self._upload()

    def update(self, batch: Batch) -> None:
        """Take poses, colours and ids of ``batch``, whose mesh is this one; the context must be current."""
        self._take(batch)
        if self._in_context():
            self._upload()

    def _upload(self) -> None:
        # The ids are the last of pyrender's list of buffers, the colours the one before.
        fill(self._buffers[POSE_BUFFER], np.ascontiguousarray(self.poses.transpose(0, 2, 1)))
        fill(self._buffers[-2], self.colors)
        fill(self._buffers[-1], self.ids)


def fill(buffer: int, data: npt.NDArray[Any]) -> None:
    """Replace the content of an OpenGL buffer by ``data``."""
    GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
    GL.glBufferData(GL.GL_ARRAY_BUFFER, data.nbytes, data, GL.GL_DYNAMIC_DRAW)
