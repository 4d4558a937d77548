"""Towers of cubes stand up to the height at which a column as stiff as their contacts buckles under its own weight."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import RigidBody, Transform
from carom.systems.constants import CONTACT_PERIODS
from carom.systems.simulation import Simulation

DT, GRAVITY = 1.0 / 60.0, 9.81
LEAN = 1e-3  # part of their size by which each stands aside of the one below: one that is upright to rounding stays so


def highest(size: float, substeps: int) -> float:
    """Return how many cubes stand one on the other: Greenhill's column, with n^3 s m g = 7.84 k.

    A. G. Greenhill, Proc. Camb. Phil. Soc. 4, 65 (1881). The contact of two cubes resists a tilt with k = m w^2 s^2 / 8
    (N m): four springs of frequency w at its corners, where an eighth of the mass counts.
    """
    frequency = 2.0 * math.pi * CONTACT_PERIODS * substeps / DT
    return (7.84 / 8.0 * frequency**2 * size / GRAVITY) ** (1.0 / 3.0)


def is_standing(count: int, size: float, substeps: int) -> bool:
    """Tell whether the uppermost of so many cubes is near where it was after 20 s."""
    simulation = Simulation(dt=DT, substeps=substeps, sleeping=False, gravity=(0.0, -GRAVITY, 0.0))
    simulation.add(collider={"plane": {}})
    for k in range(count):
        place = {"position": (LEAN * size * k, size * (0.5 + k), 0.0)}
        simulation.add(collider={"box": {"size": (size, size, size)}}, body={}, transform=place)
    simulation.step(int(20.0 / DT))
    top = simulation.world[Transform].position[simulation.world.row_numbers(RigidBody)][-1]
    return bool(np.linalg.norm(top - [0.0, size * (count - 0.5), 0.0]) < 0.5 * size)


@pytest.mark.parametrize(("size", "substeps"), [(0.1, 4), (0.03, 8), (0.01, 16)])
def test_a_tower_stands_up_to_the_height_at_which_it_buckles(size: float, substeps: int) -> None:
    """Within an eighth of it: a tower that is hardly too high leans so slowly that it has not fallen after 20 s."""
    most = highest(size, substeps)
    assert is_standing(math.floor(most / 1.125), size, substeps)
    assert not is_standing(math.ceil(1.125 * most), size, substeps)
