"""Scene: what of a world is seen, as batches for the renderer."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from carom.ecs import Transform, Visual, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.shapes import BY_NUMBER
from carom.systems.shapes.geometry import Geometries
from carom.tools.batch import Batch

SPREAD = 100.0  # an endless surface is drawn this many times as wide as its sample, so that its edge lies in the haze


class Mesh(NamedTuple):
    """The mesh of a shape, as in a `Batch`."""

    vertices: Floats
    faces: Integers
    smooth: bool
    floor: Floats | None


class Scene:
    """The visible entities of a world: every row with a Transform and a visible Visual, one batch per mesh.

    The id of an instance is the row of its entity. Meshes are made once per shape and size.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._meshes: dict[bytes, Mesh] = {}

    def batches(self) -> list[Batch]:
        """Return the batches as the world is now, in the order of their first rows."""
        world = self._world
        visual, transform = world[Visual], world[Transform]
        rows = world.row_numbers(Visual, Transform)
        rows = rows[visual.visible[rows]]
        if not len(rows):
            return []
        rotation = transform.rotation[rows]
        poses = np.zeros((len(rows), 4, 4))
        poses[:, 3, 3] = 1.0
        poses[:, :3, :3] = quaternion.matrix(quaternion.multiply(rotation, visual.rotation[rows]))
        poses[:, :3, 3] = transform.position[rows] + quaternion.rotate(rotation, visual.position[rows])
        colors = visual.color[rows]
        looks = np.column_stack([visual.shape[rows], visual.geometry[rows], visual.size[rows]])
        _, first, group = np.unique(looks, axis=0, return_index=True, return_inverse=True)
        batches = []
        for number in np.argsort(first):
            members = np.nonzero(group.ravel() == number)[0]
            mesh = self._mesh(int(rows[members[0]]), looks[members[0]].tobytes())
            place = (poses[members], colors[members], rows[members])
            batches.append(Batch(mesh.vertices, mesh.faces, *place, mesh.smooth, mesh.floor))
        return batches

    def _mesh(self, row: int, look: bytes) -> Mesh:
        found = self._meshes.get(look)
        if found is None:
            visual = self._world[Visual]
            number = int(visual.geometry[row])
            geometry = self._world[Geometries].items[number] if number >= 0 else None
            shape = BY_NUMBER[int(visual.shape[row])].from_size(visual.size[row], geometry)
            surface = shape.surface()
            if math.isinf(max(shape.bounds().half)):
                found = endless(surface.vertices, surface.faces)
            else:
                found = Mesh(surface.vertices, surface.faces, surface.smooth, None)
            self._meshes[look] = found
        return found


def endless(vertices: Floats, faces: Integers) -> Mesh:
    """Return a flat sample of an endless surface, widened, with coordinates (m) along it for a pattern of squares."""
    middle = vertices.mean(axis=0)
    along = vertices[1] - vertices[0]
    along = along / np.linalg.norm(along)
    normal = np.cross(vertices[faces[0, 1]] - vertices[faces[0, 0]], vertices[faces[0, 2]] - vertices[faces[0, 0]])
    across = np.cross(normal / np.linalg.norm(normal), along)
    spread = (vertices - middle) * SPREAD
    return Mesh(middle + spread, faces, False, np.stack([spread @ along, spread @ across], axis=1))
