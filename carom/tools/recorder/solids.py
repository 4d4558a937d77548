"""Solids: the shapes Rerun draws many of at one path, each with its own size and colour; meshes have one of all."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.compound import bound_centers
from carom.systems.shapes import BY_NUMBER, Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.sphere import Sphere

Fields = dict[str, npt.NDArray[Any]]
Y_FROM_Z = np.array([-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])  # Rerun's capsules and cylinders are along z


class Solid(NamedTuple):
    """Rerun's archetype for some shapes: how large and where colliders (rows) are, in its words."""

    archetype: str
    shapes: tuple[type[Shape], ...]
    sizes: Callable[[World, Integers], Fields]
    poses: Callable[[World, Integers], Fields]
    fill: str = "solid"


def _pose(world: World, rows: Integers) -> tuple[Floats, Floats]:
    transform, collider = world[Transform], world[Collider]
    turned = transform.rotation[rows]
    position = transform.position[rows] + quaternion.rotate(turned, collider.position[rows])
    return position, quaternion.multiply(turned, collider.rotation[rows])


def _centered(world: World, rows: Integers) -> Fields:
    position, rotation = _pose(world, rows)
    return {"centers": position, "quaternions": rotation}


def _upright(world: World, rows: Integers) -> Fields:
    position, rotation = _pose(world, rows)
    return {"centers": position, "quaternions": quaternion.multiply(rotation, np.tile(Y_FROM_Z, (len(rows), 1)))}


def _from_one_end(world: World, rows: Integers) -> Fields:
    """Return poses of capsules, which Rerun draws from 0 to their length along z."""
    fields, length = _upright(world, rows), world[Collider].size[rows, 1]
    down = np.stack([np.zeros(len(rows)), np.zeros(len(rows)), -0.5 * length], axis=1)
    start = fields["centers"] + quaternion.rotate(fields["quaternions"], down)
    return {"translations": start, "quaternions": fields["quaternions"]}


def _bounding(world: World, rows: Integers) -> Fields:
    return {"centers": bound_centers(world, rows), "quaternions": world[Transform].rotation[rows]}


def _bounds(world: World, rows: Integers) -> Fields:
    return {"half_sizes": world[Collider].bound_half[rows] + world[Collider].bound_radius[rows, None]}


def _radii(world: World, rows: Integers) -> Fields:
    size = world[Collider].size[rows, :3]
    round_ = world[Collider].shape[rows] == Sphere.number
    return {"half_sizes": np.where(round_[:, None], size[:, :1], size)}


def _half_edges(world: World, rows: Integers) -> Fields:
    return {"half_sizes": 0.5 * world[Collider].size[rows, :3]}


def _lengths(world: World, rows: Integers) -> Fields:
    size = world[Collider].size[rows]
    return {"radii": size[:, 0], "lengths": size[:, 1]}


#: By the last word of their paths; bounding boxes are of whatever has no solid of its own, but stands not.
SOLIDS = {
    "balls": Solid("Ellipsoids3D", (Sphere, Ellipsoid), _radii, _centered),
    "boxes": Solid("Boxes3D", (Box,), _half_edges, _centered),
    "capsules": Solid("Capsules3D", (Capsule,), _lengths, _from_one_end),
    "cylinders": Solid("Cylinders3D", (Cylinder,), _lengths, _upright),
    "bounding_boxes": Solid("Boxes3D", (), _bounds, _bounding, "majorwireframe"),
}


def solid_of(shape: type[Shape]) -> str | None:
    """Return which of the solids draws a shape; None for what only stands, such as planes."""
    drawn = next((name for name, solid in SOLIDS.items() if shape in solid.shapes), None)
    return drawn or (None if shape.static else "bounding_boxes")


def by_solid(world: World, rows: Integers) -> dict[str, Integers]:
    """Return the colliders (rows) that each of the solids draws."""
    numbers = world[Collider].shape[rows]
    drawn = {number: solid_of(BY_NUMBER[number]) for number in np.unique(numbers).tolist()}
    return {name: rows[np.isin(numbers, [number for number in drawn if drawn[number] == name])] for name in SOLIDS}
