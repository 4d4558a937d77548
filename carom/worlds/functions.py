"""Functions that expectations know: of one entity, of several together, and of two."""

from __future__ import annotations

from collections.abc import Callable
from math import dist
from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import Joint
from carom.systems.bodies import centers_of_mass
from carom.systems.energy import kinetic_energies
from carom.systems.queries.space import Space
from carom.worlds.oracle import errors


def _lengths(vectors: Floats) -> Floats:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", vectors, vectors)))  # np.linalg.norm takes twice as long for a few


def _speed(world: World, rows: Integers) -> Floats:
    return _lengths(world[Motion].linear[rows])


def _spin(world: World, rows: Integers) -> Floats:
    return _lengths(world[Motion].angular[rows])


def _energy(world: World, rows: Integers) -> Floats:
    return kinetic_energies(world, rows)


def _load(world: World, rows: Integers) -> Floats:
    return _lengths(world[Joint].force[rows])


def _center_of_mass(world: World, rows: Integers) -> Floats:
    mass = world[RigidBody].mass[rows]
    if not mass.any():
        return np.full(3, np.nan)
    return np.asarray((mass[:, None] * centers_of_mass(world, rows)).sum(axis=0) / mass.sum())


def _distance(world: World, rows: Integers) -> float:
    return dist(*world[Transform].position[rows].tolist())


def _sees(world: World, rows: Integers) -> float:
    """Return 1 where nothing stands on the straight line between two origins but the two themselves, else 0."""
    first, second = world[Transform].position[rows]
    reach = _distance(world, rows)
    pair = world.entities(rows)
    return float(not reach or not Space(world).cast_rays_any(first, second - first, reach, without=pair)[0])


class OfAll(NamedTuple):
    """A function of several together, of those among them that are ``bodies``; of ``nobody`` it may be a value too."""

    unit: str
    size: int
    measure: Callable[[World, Integers], Floats]
    bodies: bool = True
    nobody: bool = False


CALLS: dict[str, tuple[str, str, Callable[[World, Integers], Floats]]] = {  # unit, a column who is asked must have
    "speed": ("m/s", "linear", _speed),
    "spin": ("rad/s", "linear", _spin),
    "kinetic_energy": ("J", "linear", _energy),
    "load": ("N", "break_force", _load),
    "error": ("m", "position", errors),
}
OF_ALL = {
    "center_of_mass": OfAll("m", 3, _center_of_mass),
    "count": OfAll("1", 1, lambda world, rows: np.array([float(len(rows))]), bodies=False, nobody=True),
}
PAIRS: dict[str, tuple[str, Callable[[World, Integers], float]]] = {"distance": ("m", _distance), "sees": ("1", _sees)}
