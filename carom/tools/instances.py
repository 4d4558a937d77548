"""Instances: one mesh on the graphics side, drawn many times with a pose, a colour and an id for each.

Import this only after `carom.tools.offscreen.load`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pyrender
from OpenGL import GL
from pyrender.material import Material

from carom.tools.batch import Batch, shading
from carom.tools.cameras import Camera

# pyrender numbers its own vertex attributes from 0 to 8 at most; the shaders name these two by number.
COLOR_ATTRIBUTE = 12
ID_ATTRIBUTE = 13
POLISHED = 0.2  # roughness of curved things, which look turned; the shader lets other materials reflect nothing
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
            texcoord_1=None if batch.finish is None else batch.finish.coordinates[shaded.source],
            material=material_of(batch),
        )
        self.take(batch)

    def take(self, batch: Batch) -> None:
        """Take poses, colours and ids of ``batch``, whose mesh is this one."""
        self._batch = batch
        self.poses = batch.poses
        self.translucent = bool((batch.colors[:, 3] < 1.0).any()) or (
            batch.finish is not None and batch.finish.translucent
        )

    def arrange(self, camera: Camera) -> None:
        """Put the nearest instance first or, of what shines through, the farthest; the context must be current."""
        apart = self._batch.poses[:, :3, 3] - camera.position
        away = np.einsum("ij,ij->i", apart, apart)
        self.away = float(away.max())
        self._order = np.argsort(-away if self.translucent else away, kind="stable")
        if self._in_context():
            self._upload()

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

    def _upload(self) -> None:
        # The ids are the last of pyrender's list of buffers, the colours the one before.
        batch, order = self._batch, self._order
        fill(self._buffers[POSE_BUFFER], np.ascontiguousarray(batch.poses[order].transpose(0, 2, 1), np.float32))
        fill(self._buffers[-2], batch.colors[order].astype(np.float32))
        fill(self._buffers[-1], batch.ids[order].astype(np.uint32) + np.uint32(1))


def material_of(batch: Batch) -> Any:
    """Return the material that pyrender binds."""
    if batch.finish is None and not batch.smooth:
        return Material(alphaMode="BLEND")
    if batch.finish is None:
        return pyrender.MetallicRoughnessMaterial(alphaMode="BLEND", roughnessFactor=POLISHED)
    return pyrender.MetallicRoughnessMaterial(
        alphaMode="BLEND",
        doubleSided=batch.finish.two_sided,
        baseColorTexture=pyrender.Texture(source=batch.finish.image, source_channels="RGBA"),
        metallicFactor=batch.finish.metallic,
        roughnessFactor=batch.finish.roughness,
    )


def fill(buffer: int, data: npt.NDArray[Any]) -> None:
    """Replace the content of an OpenGL buffer by ``data``."""
    GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
    GL.glBufferData(GL.GL_ARRAY_BUFFER, data.nbytes, data, GL.GL_DYNAMIC_DRAW)
