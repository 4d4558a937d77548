"""Pairs that the broad phase finds, and those of brute force."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, ColliderPose, Transform, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.spatial import quaternion
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import overlapping
from carom.systems.shapes.plane import Plane
from carom.systems.simulation import Simulation
from carom.systems.stream import Stream

DT = 1 / 60


def pairs_now(world: World) -> Integers:
    """Place all colliders and return the pairs of the broad phase."""
    with world.faces(None):
        reach_within(world, DT)
        return overlapping(world)


def brute_force(world: World) -> Integers:
    """Return what must be found, every row tested against every other."""
    collider, pose, rows = world[Collider], world[ColliderPose], world.row_numbers(Collider)
    lower, upper, body = pose.lower[rows], pose.upper[rows], pose.body_row[rows]
    layer, mask, sensor = collider.layer[rows], collider.mask[rows], collider.sensor[rows]
    meets: Booleans = np.ones((len(rows), len(rows)), np.bool_)
    for k in range(3):
        below = lower[:, k, None] <= upper[None, :, k]
        meets &= below & below.T
    for k in np.nonzero(collider.shape[rows] == Plane.number)[0]:
        normal = quaternion.rotate(pose.rotation[rows[k]], collider.size[rows[k], :3])
        corners = np.where(normal > 0.0, lower, upper) - pose.position[rows[k]]
        along = np.where(normal == 0.0, 0.0, corners) * normal
        meets[k] = meets[:, k] = along.sum(axis=1) <= collider.size[rows[k], 3] + world[Stream].passes
    accepted = (mask[:, None] & layer[None]) != 0
    meets &= accepted & accepted.T & (body[:, None] != body[None]) & ~(sensor[:, None] & sensor[None])
    a, b = np.nonzero(np.triu(meets, 1))
    return np.stack((rows[a], rows[b]), axis=1)


def agree(world: World) -> Integers:
    """Return the pairs of the broad phase, which must be those of brute force."""
    found = pairs_now(world)
    assert found.tolist() == brute_force(world).tolist()
    return found


def crowd(count: int, *, spread: float, seed: int = 0) -> Simulation:
    """Return balls of half a metre, jittered about a lattice of this spacing."""
    simulation = Simulation(checked=False)
    edge = int(np.ceil(count ** (1 / 3)))
    lattice = np.stack(np.unravel_index(np.arange(count), (edge, edge, edge)), axis=1).astype(np.float64)
    places = (lattice + np.random.default_rng(seed).uniform(-0.15, 0.15, (count, 3))) * spread
    simulation.add_many(places, collider={"sphere": {"radius": 0.5}}, body={}, visual=False)
    return simulation


def move(simulation: Simulation, rows: Any, by: Any) -> None:
    """Shift rows."""
    with simulation.world.edit(Transform) as transform:
        transform.position[rows] += by
