"""Scene: what of a world is seen, as batches for the renderer."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from carom.ecs import Transform, Visual, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.compound import shape_at
from carom.systems.shapes.finish import Finish
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Surface
from carom.tools.batch import Batch
from carom.tools.coloring import Coloring
from carom.tools.particles import particle_batches
from carom.tools.visible import visible_rows

SPREAD = 100.0  # an endless surface is drawn this many times as wide as its sample, so that its edge lies in the haze


class Mesh(NamedTuple):
    """The mesh of a shape, as in a `Batch`."""

    vertices: Floats
    faces: Integers
    smooth: bool
    floor: Floats | None
    finish: Finish | None = None
    coarser: tuple[Surface, ...] = ()


class Scene:
    """The visible entities of a world: every row with a Transform and a visible Visual, one batch per mesh.

    What a model file paints in several ways is a mesh for each. The id of an instance is the row of its entity. Meshes
    are made once per shape and size.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._meshes: dict[bytes, list[Mesh]] = {}

    def batches(self, transform: Transform | None = None, coloring: Coloring | None = None) -> list[Batch]:
        """Return the batches as the world is now, in the order of their first rows; at other poses where stated.

        Their colours are their own, or those of a mode.
        """
        world = self._world
        visual, transform = world[Visual], world[Transform] if transform is None else transform
        rows, solids = visible_rows(world), particle_batches(world)
        if not len(rows):
            return solids
        rotation = transform.rotation[rows]
        poses = np.zeros((len(rows), 4, 4))
        poses[:, 3, 3] = 1.0
        poses[:, :3, :3] = quaternion.matrix(quaternion.multiply(rotation, visual.rotation[rows]))
        poses[:, :3, 3] = transform.position[rows] + quaternion.rotate(rotation, visual.position[rows])
        colors = visual.color[rows] if coloring is None else coloring.colors(world, rows)
        looks = np.column_stack([visual.shape[rows], visual.geometry[rows], visual.size[rows]])
        _, first, group = np.unique(looks, axis=0, return_index=True, return_inverse=True)
        batches = []
        for number in np.argsort(first):
            members = np.nonzero(group.ravel() == number)[0]
            place = (poses[members], colors[members], rows[members])
            for mesh in self._meshes_of(int(rows[members[0]]), looks[members[0]].tobytes()):
                finish = mesh.finish if coloring is None or coloring.keeps_looks else None
                batches.append(Batch(mesh.vertices, mesh.faces, *place, mesh.smooth, mesh.floor, finish, mesh.coarser))
        return batches + solids

    def _meshes_of(self, row: int, look: bytes) -> list[Mesh]:
        found = self._meshes.get(look)
        if found is None:
            visual = self._world[Visual]
            number = int(visual.geometry[row])
            geometry = self._world[Geometries].items[number] if number >= 0 else None
            shape = shape_at(self._world, row, Visual)
            surface = shape.surface()
            if math.isinf(max(shape.bounds().half)):
                found = [endless(surface.vertices, surface.faces)]
            elif geometry is not None and geometry.parts:
                found = [Mesh(part.vertices, part.faces, surface.smooth, None, part.finish) for part in geometry.parts]
            else:
                coarser = shape.coarser_surfaces()
                found = [Mesh(surface.vertices, surface.faces, surface.smooth, None, coarser=coarser)]
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
