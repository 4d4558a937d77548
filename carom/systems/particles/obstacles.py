"""Obstacles: what particles bounce off."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, Material, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.relations.particle import PLACE, VELOCITY, Particle
from carom.ecs.spatial import vector
from carom.systems.bodies import centers_of_mass
from carom.systems.constants import PARTICLE_SKIN
from carom.systems.kernels.particle_flight import NORMAL, OFFSET, PLANE_COLUMNS
from carom.systems.kernels.particle_planes import combine_materials, place_planes
from carom.systems.kernels.rays import FIRST, face_hits
from carom.systems.queries.rays import meet
from carom.systems.queries.scene import Scene
from carom.systems.shapes.plane import Plane

NO_PLANES: Floats = np.zeros((0, PLANE_COLUMNS))
BOUNCES = 2  # of a particle off colliders in one step; after the last it waits for the next step


def obstacles(world: World) -> Integers:
    """Return the rows of colliders that are there to be touched."""
    rows, collider = world.row_numbers(Collider, Transform), world[Collider]
    return np.asarray(rows[~collider.sensor[rows] & (collider.layer[rows] != 0)])


def planes(world: World, row: int) -> Floats:
    """Return the planes that the particles of the emitter in a row bounce off, as `fly` takes them."""
    rows, collider, transform = obstacles(world), world[Collider], world[Transform]
    rows = rows[collider.shape[rows] == Plane.number]
    if not len(rows):
        return NO_PLANES
    found = np.empty((len(rows), PLANE_COLUMNS))
    place_planes(
        rows, collider.size, transform.position, transform.rotation, collider.position, collider.rotation,
        *combined_with(world, row, rows), found,
    )  # fmt: skip
    return found


def combined_with(world: World, row: int, rows: Integers) -> tuple[Floats, Floats]:
    """Return restitution and friction (n,) of the emitter in a row with colliders."""
    material, restitution, friction = world[Material], np.empty(len(rows)), np.empty(len(rows))
    combine_materials(
        row, rows, material.restitution, material.friction, material.restitution_combine, material.friction_combine,
        restitution, friction,
    )  # fmt: skip
    return restitution, friction


def bounce_off_colliders(world: World, row: int, rows: slice, before: Floats, times: Floats, beside: Floats) -> None:
    """Let particles, which were at ``before`` (n, 3) and flew for ``times`` (n,), bounce off what was in their way.

    Their way is straight, their velocity that at its end. Planes are not in it, but ``beside`` them are those that none
    is pushed through. Nor is the body in it that the emitter is on; what a particle is inside of it leaves freely.
    """
    particle, scene = world[Particle], world[Scene].of_now(world)
    takes = np.zeros(world.used(), np.bool_)
    takes[obstacles(world)] = True
    takes[world[Collider].shape[: len(takes)] == Plane.number] = False
    own = scene.body[row] if scene.body[row] >= 0 else row
    takes[: len(scene.body)] &= scene.body != own
    takes[own] = False
    who = np.arange(rows.start, rows.stop)
    origin, left = before, times
    for _ in range(BOUNCES):
        way = particle.position(who) - origin
        length = vector.length(way)
        moves = np.nonzero(length > 0.0)[0]
        direction = way[moves] / length[moves, None]
        ray, met, distance, face = meet(scene, takes, FIRST, origin[moves], direction, length[moves])
        order = np.argsort(ray, kind="stable")
        ray, met, distance, face = ray[order], met[order], distance[order], face[order]
        normal = np.empty((len(ray), 3))
        face_hits(origin[moves], direction, ray, met, distance, *scene.colliders, face, normal)
        outside = face >= 0
        ray, met, distance, normal = ray[outside], met[outside], distance[outside], normal[outside]
        if not len(ray):
            return
        hit = moves[ray]
        who, left = who[hit], left[hit] * (1.0 - distance / length[hit])
        origin = origin[hit] + distance[:, None] * direction[ray] + PARTICLE_SKIN * normal
        velocity = _reflected(world, row, who, met, origin, normal)
        for k in range(3):
            getattr(particle, PLACE[k])[who] = origin[:, k] + left * velocity[:, k]
        _keep_above(particle, who, beside)
    for k in range(3):
        getattr(particle, PLACE[k])[who] = origin[:, k]
    _keep_above(particle, who, beside)


def _keep_above(particle: Particle, who: Integers, planes: Floats) -> None:
    """Put those of ``who`` that are below planes onto them, and let them go no deeper."""
    for plane in planes:
        normal = plane[NORMAL : NORMAL + 3]
        depth = np.minimum(0.0, vector.dot(particle.position(who), normal) - plane[OFFSET])
        closing = np.where(depth < 0.0, np.minimum(0.0, vector.dot(particle.velocity(who), normal)), 0.0)
        for k in range(3):
            getattr(particle, PLACE[k])[who] -= depth * normal[k]
            getattr(particle, VELOCITY[k])[who] -= closing * normal[k]


def _reflected(world: World, row: int, who: Integers, met: Integers, point: Floats, normal: Floats) -> Floats:
    """Give particles the velocity after an impact with colliders (rows) that may move, and return it."""
    particle = world[Particle]
    velocity = particle.velocity(who)
    surface, body = np.zeros_like(velocity), world[Scene].body[met]
    moving = np.nonzero(body >= 0)[0]
    if len(moving):
        by, motion = body[moving], world[Motion]
        lever = point[moving] - centers_of_mass(world, by)
        surface[moving] = motion.linear[by] + vector.cross(motion.angular[by], lever)
    velocity -= surface
    restitution, friction = combined_with(world, row, met)
    closing = np.minimum(0.0, vector.dot(velocity, normal))
    push = -(1.0 + restitution) * closing
    along = velocity - vector.dot(velocity, normal)[:, None] * normal
    size = vector.length(along)
    rubbed = np.minimum(1.0, friction * push / np.where(size > 0.0, size, 1.0))
    velocity += push[:, None] * normal - rubbed[:, None] * along + surface
    for k in range(3):
        getattr(particle, VELOCITY[k])[who] = velocity[:, k]
    return velocity


READ_BY_OBSTACLES = (Collider, Material, Motion, RigidBody, Transform)
