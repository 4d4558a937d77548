"""Immersion: what of bodies is below a surface, of all their colliders together."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from carom.ecs import Collider, Parent, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.hierarchy import carry
from carom.systems.compound import bodies_of
from carom.systems.kernels.buoyancy import look_down, look_up
from carom.systems.kernels.submersion import FOUND
from carom.systems.settings import Settings
from carom.systems.shapes import BY_NUMBER
from carom.systems.shapes.geometry import Geometries

MOST_SHAPES = 1 << 33  # numbers of shapes are below


class Surface(NamedTuple):
    """Where a medium ends: ``height`` (m) along ``up`` from the origin; ``weight`` (m/s2) is how strong gravity is."""

    up: tuple[float, float, float]
    height: float
    weight: float

    @classmethod
    def at(cls, world: World, level: float) -> Surface:
        """Return the surface at a level: across gravity; without gravity there is none, and a medium is everywhere."""
        gravity = world[Settings].gravity
        weight = math.sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2])
        if weight == 0.0:
            return cls((0.0, 1.0, 0.0), math.inf, 0.0)
        return cls((-gravity[0] / weight, -gravity[1] / weight, -gravity[2] / weight), level, weight)


class Immersion(NamedTuple):
    """Colliders of bodies (rows): the volume (n,) in m3 below the surface, its centre (n, 3) in m, world frame.

    ``depth`` (n,) in m is how far below the surface the centre is, ``whole`` (n,) the volume of all of the collider.
    """

    body: Integers
    volume: Floats
    center: Floats
    depth: Floats
    whole: Floats


def immersed(world: World, bodies: Booleans, surface: Surface) -> Immersion:
    """Return what of bodies (a mask over rows) is below a surface, as things are now; sensors displace nothing.

    Raises DeclarationError for a shape of which that is not known.
    """
    transform, collider = world[Transform], world[Collider]
    position, rotation = transform.position, transform.rotation
    owner, rows = bodies_of(world), world.row_numbers(Collider)
    rows = rows[(owner[rows] >= 0) & bodies[owner[rows]] & ~collider.sensor[rows]]
    count = len(rows)
    if (owner[rows] != rows).any():
        position, rotation = +position, +rotation  # in the middle of a substep those carried lag behind
        carry(world, world.row_numbers(Parent, Transform), position, rotation)
    place, turn = np.empty((count, 3)), np.empty((count, 4))
    normal, below, found = np.empty((count, 3)), np.empty(count), np.empty((count, FOUND))
    look_down(
        rows, position, rotation, collider.position, collider.rotation, *surface.up, surface.height,
        place, turn, normal, below,
    )  # fmt: skip
    shape, geometry = collider.shape[rows], collider.geometry[rows]
    _, first, kind_of = np.unique(MOST_SHAPES * geometry + shape, return_index=True, return_inverse=True)
    for number, one in enumerate(first.tolist()):
        alike = np.nonzero(kind_of == number)[0]
        triangles = world[Geometries].items[geometry[one]] if geometry[one] >= 0 else None
        kind, size = BY_NUMBER[int(shape[one])], collider.size[rows[alike]]
        found[alike] = kind.submerged(size, triangles, normal[alike], below[alike])
    volume, center, depth, whole = np.empty(count), np.empty((count, 3)), np.empty(count), np.empty(count)
    look_up(found, place, turn, *surface.up, surface.height, volume, center, depth, whole)
    return Immersion(owner[rows], volume, center, depth, whole)
