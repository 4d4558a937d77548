"""Scene: where all colliders are now, in a tree."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, Parent, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.hierarchy import carry
from carom.systems.compound import bodies_of, shape_at
from carom.systems.detection.fcl_pairs import HAS_CORE
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import Meshes, PackedMeshes
from carom.systems.kernels.broad import place_bounds
from carom.systems.queries.eights import over_boxes, over_meshes
from carom.systems.shapes.geometry import Geometries, Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.plane import Plane

PLACED_BY = ("shape", "size", "geometry", "position", "rotation", "bound_center", "bound_half", "bound_radius")


class Scene(Resource):
    """The colliders of a world by row, as they are now, not as the last step saw them; a cache, droppable at any time.

    What was placed is compared with what is there at every query, so that nobody has to tell it of a change. Colliders
    that are nowhere, since a number of their pose is not finite, are not in it.
    """

    def __init__(self) -> None:
        self._known: list[Any] = []
        self.meshes: Meshes | None = None

    def of_now(self, world: World) -> Scene:
        """Return the scene, with every collider where its entity is now and carried ones where their carriers are."""
        rows, numbers = world.rows(Collider, Transform), world.row_numbers(Collider, Transform)
        position, rotation, collider = world[Transform].position, world[Transform].rotation, world[Collider]
        if len(children := world.row_numbers(Parent, Transform)):
            position, rotation = position.copy(), rotation.copy()
            carry(world, children, position, rotation)
        columns = position, rotation, *(getattr(collider, name) for name in PLACED_BY)
        known = [numbers, bodies_of(world), *(column[rows] for column in columns)]
        if len(known) != len(self._known) or not all(map(np.array_equal, known, self._known)):
            self._known = [column.copy() for column in known]
            self.body = self._known[1]
            self._place(world, numbers, position, rotation)
        return self

    def _place(self, world: World, rows: Integers, position: Floats, rotation: Floats) -> None:
        collider, n = world[Collider], len(position)
        still, nobody = np.zeros((n, 3)), np.full(n, -1)
        self.position, self.rotation = np.zeros((n, 3)), np.zeros((n, 4))
        self.lower, self.upper = np.zeros((n, 3)), np.zeros((n, 3))
        place_bounds(
            rows, 0.0, nobody, still, still[:, 0].copy(), 0.0, still, position, rotation, collider.position,
            collider.rotation, collider.bound_center, collider.bound_half, collider.bound_radius,
            self.position, self.rotation, self.lower, self.upper, np.empty(n), np.empty(n, np.int64),
            np.empty(n, np.bool_),
        )  # fmt: skip
        somewhere = np.isfinite(self.position[rows]).all(axis=1) & np.isfinite(self.rotation[rows]).all(axis=1)
        self.rows = rows = rows[somewhere]
        ends = np.isfinite(self.lower[rows]).all(axis=1) & np.isfinite(self.upper[rows]).all(axis=1)
        ends &= collider.shape[rows] != HeightField.number  # they are solid down to the end
        ending, self.endless = rows[ends], rows[~ends]
        flat = collider.shape == Plane.number
        low, high = (np.where(flat[:, None], self.position, corner) for corner in (self.lower, self.upper))
        self.middle = 0.5 * (low + high)
        across = 2.0 * (np.linalg.norm(collider.bound_half, axis=1) + collider.bound_radius)
        self.width = np.where(flat, np.abs(collider.size[:, 3]), across)
        self.tree, order = over_boxes(self.lower[ending], self.upper[ending])
        self.members = ending[order]
        self._take_drawn(world, rows)

    def _take_drawn(self, world: World, rows: Integers) -> None:
        """Take shapes that are not carom's own as meshes of the triangles they draw."""
        collider = world[Collider]
        self.shape, self.size, self.geometry = collider.shape.copy(), collider.size.copy(), collider.geometry.copy()
        known = np.append(HAS_CORE, False)
        known[[Mesh.number, HeightField.number]] = True
        drawn: dict[int, Geometry] = {}
        first, numbers = len(world[Geometries].items), dict[tuple[float, ...], int]()
        for row in rows[~known[np.minimum(self.shape[rows], len(known) - 1)]].tolist():
            form = (float(self.shape[row]), float(self.geometry[row]), *collider.size[row].tolist())
            number = numbers.setdefault(form, first + len(numbers))
            if number not in drawn:
                surface = shape_at(world, row).surface()
                drawn[number] = Geometry(np.asarray(surface.vertices, np.float64), surface.faces)
            self.shape[row], self.geometry[row] = Mesh.number, number
        self.hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
        if drawn:
            meshes = world[PackedMeshes].and_further(drawn)
        if meshes is not self.meshes:
            self.meshes, self.mesh_tree = meshes, over_meshes(meshes)
        self.colliders = (
            self.shape, self.size, self.geometry, self.position, self.rotation, self.hulls, self.meshes,
        )  # fmt: skip

    def entities(self, world: World, rows: Integers) -> tuple[Integers, Integers]:
        """Return the entities that colliders (rows) belong to, bodies or themselves where they stand, and their own."""
        body = self.body[rows]
        return world.entities(np.where(body >= 0, body, rows)), world.entities(rows)
