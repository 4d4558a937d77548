"""Columns that land without restitution do not bounce: what lands on each other is solved until all have stopped."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform, state_hash
from carom.ecs.column import Floats
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

DT, SUBSTEPS, GRAVITY, FALL = 1.0 / 60.0, 4, 9.81, 0.37


def columns(count: int, size: float, speed: float, places: int = 1, threads: int = 1) -> Simulation:
    """Return columns of so many cubes, side by side without touching, that fall onto the ground."""
    simulation = Simulation(sleeping=False, checked=False, gravity=(0.0, -GRAVITY, 0.0), threads=threads)
    simulation.add(collider={"plane": {}})
    for place in range(places):
        for k in range(count):
            simulation.add(
                collider={"box": {"size": (size, size, size)}},
                body={"mass": 1.0},
                transform={"position": (2.0 * size * place, FALL + size * (k + 0.5), 0.0)},
                motion={"linear": (0.0, -speed, 0.0)},
            )
    return simulation


def heights(simulation: Simulation, size: float) -> Floats:
    """Return how far (m) each cube of one column is above its place in one that stands."""
    found = simulation.world[Transform].position[simulation.world.row_numbers(RigidBody), 1]
    return np.asarray(found - size * (np.arange(len(found)) + 0.5))


@pytest.mark.parametrize("speed", [1.0, 3.0, 6.0, 12.0])
@pytest.mark.parametrize(("count", "size"), [(2, 1.0), (5, 1.0), (10, 1.0), (5, 0.3), (10, 0.3), (5, 0.1)])
def test_a_column_that_lands_stays_down(count: int, size: float, speed: float) -> None:
    """Nobody rises above his place from half a second after the first has landed, or is moved aside by a tenth.

    Two cubes overlap by no more than they close within a substep at the speed of the fall: impacts find when they meet,
    and from the substep after that they are held.
    """
    simulation, fastest = columns(count, size, speed), np.sqrt(speed**2 + 2.0 * GRAVITY * FALL) + GRAVITY * DT
    overlap, rise = 0.0, 0.0
    for step in range(120):
        simulation.step()
        height = heights(simulation, size)
        overlap = max(overlap, -np.diff(height).min())
        rise = max(rise, height.max() if step > (FALL / speed + 0.5) / DT else 0.0)
    place = simulation.world[Transform].position[simulation.world.row_numbers(RigidBody)]
    assert overlap <= fastest * DT / SUBSTEPS
    assert rise <= 1e-3
    assert np.abs(place[:, [0, 2]]).max() < 0.1 * size
    assert np.abs(heights(simulation, size)).max() < 0.012


@pytest.mark.parametrize("speed", [0.5, 6.0])
@pytest.mark.parametrize(
    ("count", "size", "grown"),
    [
        (1, (1.0, 1.0, 1.0), 1.0),
        (1, (0.1, 0.3, 0.05), 1.0),
        (2, (2.0, 0.5, 0.7), 1.0),
        (2, (0.1, 0.3, 0.05), 1.0),
        (3, (1.0, 1.0, 1.0), 1.0),
        (3, (2.0, 0.5, 0.7), 1.0),
        (5, (1.0, 1.0, 1.0), 10.0),  # five cubes are so slender that what they lean by grows
        (5, (0.5, 0.2, 0.5), 1.0),
    ],
)
def test_what_lands_squarely_does_not_turn(
    count: int, speed: float, size: tuple[float, float, float], grown: float
) -> None:
    """To rounding, however it is turned about the vertical; who turned a little when he landed does so hardly more.

    All corners bear alike what all lack: one after the other, they left 0.04 m/s and 0.07 rad/s. And how a contact
    yields goes over from gaps to overlap without a step: with one, a billionth made a thousandth in columns of five.
    """
    for turning in (0.0, 1e-9):
        simulation, half_turn = columns(0, 1.0, 0.0), 0.15
        for k in range(count):
            simulation.add(
                collider={"box": {"size": size}},
                body={},
                transform={
                    "position": (0.0, FALL + size[1] * (k + 0.5), 0.0),
                    "rotation": (0.0, np.sin(half_turn), 0.0, np.cos(half_turn)),
                },
                motion={"linear": (0.0, -speed, 0.0), "angular": (turning, 0.0, 0.7 * turning)},
            )
        rows, motion = simulation.world.row_numbers(RigidBody), simulation.world[Motion]
        for _ in range(60):
            simulation.step()
            assert np.abs(motion.linear[rows][:, [0, 2]]).max() <= grown * (1e-11 + 100.0 * turning)
            assert np.abs(motion.angular[rows]).max() <= grown * (1e-11 + 100.0 * turning)


@pytest.mark.parametrize("other", ["heard", "two threads"])
def test_columns_land_alike_whoever_listens_and_however_many_solve(other: str) -> None:
    """To the bit, with sweeps beyond those that each substep has anyway."""
    simulations = [columns(9, 0.5, 6.0, 128), columns(9, 0.5, 6.0, 128, threads=2 if other == "two threads" else 1)]
    sweeps: list[int] = []
    simulations[1].world[Resting].hearers += [lambda _, number: sweeps.append(number)] if other == "heard" else []
    for _ in range(12):
        for simulation in simulations:
            simulation.step()
    assert state_hash(simulations[0].world) == state_hash(simulations[1].world)
    assert not sweeps or max(sweeps) > 2


def test_a_column_lands_alike_where_a_joint_holds_somebody_else() -> None:
    """To the bit: contacts and joints are swept in turns there, and contacts alone where sweeps go on."""
    alone, beside = columns(9, 0.5, 6.0), columns(9, 0.5, 6.0)
    bob = beside.add(collider={"sphere": {"radius": 0.1}}, body={}, transform={"position": (9.0, 5.0, 0.0)})
    beside.add(joint={"ball": {"b": bob, "at": (9.5, 5.0, 0.0)}})
    for _ in range(12):
        alone.step()
        beside.step()
        found = [one.world[Transform].position[one.world.row_numbers(RigidBody)[:9]] for one in (alone, beside)]
        np.testing.assert_array_equal(*found)
