"""Explosions: momentum that goes out from a point in all directions, and what bodies in its way take of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache, reduce
from math import pi

import numpy as np

from carom.ecs import Collider, RigidBody, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.angles import sines_cosines
from carom.systems.bodies import centers_of_mass
from carom.systems.declared import Stated, flag
from carom.systems.parameters import parameter, vector
from carom.systems.pushes import Pushes
from carom.systems.queries.rays import cast_rays_all
from carom.systems.queries.scene import Scene

NAME = "explosion"
RINGS, QUARTER = 20, 6  # of rays towards a collider: so many rings, and so many rays in a quarter of each
GOLDEN = 0.6180339887498949
FURTHER = 1.0 + 1e-9  # of the way to the far side, against rounding


@dataclass(frozen=True)
class Explosion(Stated):
    """Momentum P goes out evenly in all directions: P / (4 pi r^2) in N s on each m2 that it meets head on.

    So it is close to a charge, whose blast is what was thrown: P = sqrt(2 E M) of an energy E and a mass M (Baker,
    Prediction and scaling of reflected impulse from strong blast waves, Int. J. Mech. Sci. 9, 45, 1967). A body takes
    what goes into the part of the sky, as seen from the point, that it covers: of a ball of radius R, P R^2 / (4 r^2).
    """

    impulse: float = parameter(unit="N s", doc="momentum P that goes out, of all directions together", above=0.0)
    position: tuple[float, float, float] = vector(unit="m", doc="where", default=(0.0, 0.0, 0.0))
    blocked: bool = flag(doc="whether what no force moves, such as walls, keeps it off")


def blast(world: World, explosion: Explosion) -> Pushes:
    """Return what an explosion gives dynamic bodies that take any of it.

    Rays go out to the ball about each collider, evenly spread over its part of the sky: exact for balls, and within 4 %
    for a cube that shows one face. The rays of colliders that mirror each other mirror each other to the bit.
    """
    scene, collider, body = world[Scene].of_now(world), world[Collider], world[RigidBody]
    origin = np.array(explosion.position, np.float64)
    rows = scene.rows[scene.body[scene.rows] >= 0]
    rows = rows[(body.inverse_mass[scene.body[rows]] > 0.0) & ~collider.sensor[rows]]
    middle = scene.position[rows] + quaternion.rotate(scene.rotation[rows], collider.bound_center[rows])
    half = collider.bound_half[rows]
    radius = np.sqrt((half * half).sum(axis=1)) + collider.bound_radius[rows]
    directions, spread, reach = _rays(middle - origin, radius)
    caught = directions * _taken(world, rows, origin, directions, reach, explosion.blocked)[..., None]
    # First the four rays that mirror each other, so that sums are the same whichever of them comes first.
    fours = (caught[:, :, 0] + caught[:, :, 1]) + (caught[:, :, 2] + caught[:, :, 3])
    share = 0.5 * spread / (4 * RINGS * QUARTER)  # of the whole sky, by ray
    summed = np.zeros((world.used(), 3))
    np.add.at(summed, scene.body[rows], (explosion.impulse * share)[:, None] * reduce(np.add, np.moveaxis(fours, 1, 0)))
    bodies = np.nonzero(summed.any(axis=1))[0]
    impulse, away = summed[bodies], centers_of_mass(world, bodies) - origin
    along = (away * impulse).sum(axis=1) / (impulse * impulse).sum(axis=1)
    return Pushes(NAME, bodies, impulse, np.cross(impulse, away), origin + along[:, None] * impulse)


@lru_cache(1)
def _around() -> Floats:
    """Return (RINGS, QUARTER, 4, 2) cosines and sines of angles in a quarter, and of those that mirror them.

    Each ring is turned against the one before by the golden share of what lies between two rays.
    """
    turned = (0.5 + GOLDEN * np.arange(RINGS)) % 1.0
    sine, cosine = sines_cosines(0.5 * pi * (np.arange(QUARTER) + turned[:, None]) / QUARTER)
    signs = np.array([(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)])
    return np.asarray(np.stack([cosine, sine], axis=-1)[:, :, None] * signs)


def _rays(away: Floats, radius: Floats) -> tuple[Floats, Floats, Floats]:
    """Return unit vectors (n, RINGS * QUARTER, 4, 3) to balls (n, 3) of a radius (n,), m, evenly over what is seen.

    With them 1 - cos of the angle that each ball appears under, 2 from within, and how far away it ends.
    """
    distance = np.sqrt((away * away).sum(axis=1))
    outside = distance > radius
    sine = np.where(outside, radius / np.where(outside, distance, 1.0), 0.0)
    spread = np.where(outside, sine * sine / (1.0 + np.sqrt(1.0 - sine * sine)), 2.0)
    axis = np.where(distance[:, None] > 0.0, away / np.where(distance > 0.0, distance, 1.0)[:, None], (0.0, 1.0, 0.0))
    level = np.sqrt(axis[:, 0] * axis[:, 0] + axis[:, 2] * axis[:, 2])[:, None]
    across = np.stack([axis[:, 2], np.zeros(len(axis)), -axis[:, 0]], axis=1)  # y x axis
    across = np.where(level > 0.0, across / np.where(level > 0.0, level, 1.0), (1.0, 0.0, 0.0))
    frame = np.stack([across, np.cross(axis, across)], axis=1)
    less = spread[:, None] * (np.arange(RINGS) + 0.5) / RINGS  # 1 - cos of the angle between ring and axis
    ring = np.sqrt(less * (2.0 - less))
    sideways = _around()[..., :1] * frame[:, None, None, None, 0] + _around()[..., 1:] * frame[:, None, None, None, 1]
    along = (1.0 - less)[:, :, None, None, None] * axis[:, None, None, None]
    directions = along + ring[:, :, None, None, None] * sideways
    return directions.reshape(len(away), -1, 4, 3), spread, FURTHER * (distance + radius)


def _taken(world: World, rows: Integers, origin: Floats, directions: Floats, reach: Floats, blocked: bool) -> Booleans:
    """Tell of each ray whether it comes to its collider, and, if it can be blocked, to nothing that stands before."""
    shape = directions.shape[:3]
    of_ray = np.repeat(np.arange(len(rows)), shape[1] * shape[2])
    taken, wall = np.zeros(len(of_ray), np.bool_), np.full(len(of_ray), np.inf)
    if len(of_ray):
        hits = cast_rays_all(world, origin, directions.reshape(-1, 3), reach[of_ray], tag=NAME)
        if blocked:
            hit = world.slots.rows(hits.entity)
            moves = world.table(RigidBody).present[hit]
            moves &= world[RigidBody].inverse_mass[hit] > 0.0
            np.minimum.at(wall, hits.ray[~moves], hits.distance[~moves])
        own = hits.collider == world.entities(rows)[of_ray[hits.ray]]
        taken[hits.ray[own]] = hits.distance[own] <= wall[hits.ray[own]]
    return taken.reshape(shape)
