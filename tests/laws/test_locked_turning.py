"""A body that may not turn about some axes turns about the others as rigid bodies do."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from locked import ROTATIONS, askew

from carom.ecs import Entity
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.energy import angular_momentum, kinetic_energy
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("axis", range(3))
def test_a_body_with_one_free_axis_turns_by_its_moment_about_it(axis: int) -> None:
    """Its speed is torque t / (e . I e), however askew its principal axes are, and its energy the work, to rounding."""
    generator = np.random.default_rng(axis)
    rotation, torque, size = askew(generator), 0.3, np.array([0.2, 0.5, 1.1])
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    locked = [name for k, name in enumerate(ROTATIONS) if k != axis]
    wheel = simulation.add(
        collider={"box": {"size": tuple(size)}},
        body={"mass": 2.0, "locked": locked},
        transform={"rotation": rotation},
    )
    spun = np.zeros(3)
    for _ in range(120):
        simulation[wheel].external_force.torque = (torque, torque, torque)
        simulation.step()
    turn = quaternion.matrix(rotation)
    moments = 2.0 / 12.0 * (size @ size - size * size)
    spun[axis] = torque * 0.5 / (turn @ np.diag(moments) @ turn.T)[axis, axis]
    assert simulation[wheel].motion.angular == pytest.approx(spun, rel=1e-11)
    angle = 0.5 * spun[axis] * 0.5
    energy = kinetic_energy(simulation.world)
    assert energy == pytest.approx(torque * angle, rel=1e-11)
    turned = quaternion.multiply(simulation[wheel].transform.rotation, quaternion.conjugate(rotation))
    assert 2.0 * math.atan2(turned[axis], turned[3]) == pytest.approx(angle, rel=1e-3)


@pytest.mark.parametrize("locked", range(3))
def test_a_gyroscope_with_one_locked_axis(locked: int) -> None:
    """Its momentum about the free axes is kept to rounding, its energy error is bounded and of second order.

    The lock makes its velocity w = I_free^-1 L_free, which turns it: that equation, solved by the fourth order of Runge
    and Kutta in steps 16 times as fine, tells where it goes, to 1e-9.
    """
    rotation, free = askew(np.random.default_rng(11)), np.arange(3) != locked
    spin = np.where(free, [3.0, -2.0, 4.0], 0.0)
    turn = quaternion.matrix(rotation)
    wanted = turned_under_a_lock(turn, (turn * MOMENTS) @ turn.T @ spin, free, 2.0)
    errors, places = [], []
    for dt in (1 / 30, 1 / 60):
        simulation, top = gyroscope(dt, rotation, spin, [ROTATIONS[locked]])
        momenta, energy = angular_momentum(simulation.world), kinetic_energy(simulation.world)
        worst = []
        for _ in range(round(2.0 / dt)):
            simulation.step()
            assert simulation[top].motion.angular[locked] == 0.0
            assert angular_momentum(simulation.world)[free] == pytest.approx(momenta[free], rel=1e-12)
            worst.append(abs(kinetic_energy(simulation.world) / energy - 1.0))
        assert max(worst[-10:]) < 2.0 * max(worst[: len(worst) // 2])
        errors.append(max(worst))
        places.append(np.abs(quaternion.matrix(simulation[top].transform.rotation) - wanted).max())
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.2)
    assert math.log2(places[0] / places[1]) == pytest.approx(2.0, abs=0.3)
    assert errors[0] < 1e-2
    assert places[1] < 1e-2


MOMENTS = np.array([0.05, 0.11, 0.14])


def gyroscope(dt: float, rotation: Floats, spin: Floats, locked: list[str]) -> tuple[Simulation, Entity]:
    """Return a free body with three moments of its own."""
    simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
    body = {"mass": 1.0, "inertia": tuple(MOMENTS), "locked": locked}
    return simulation, simulation.add(body=body, transform={"rotation": rotation}, motion={"angular": spin})


def turned_under_a_lock(turn: Floats, momenta: Floats, free: Any, duration: float) -> Floats:
    """Return the orientation (3, 3) after some seconds at these momenta (kg m2/s) about the free axes."""

    def rate(turn: Floats) -> Floats:
        inertia = (turn * MOMENTS) @ turn.T
        velocity = np.zeros(3)
        velocity[free] = np.linalg.solve(inertia[np.ix_(free, free)], momenta[free])
        return np.asarray(np.cross(velocity, turn.T).T)

    steps = 2_000
    h = duration / steps
    for _ in range(steps):
        one = rate(turn)
        two = rate(turn + 0.5 * h * one)
        three = rate(turn + 0.5 * h * two)
        four = rate(turn + h * three)
        turn = turn + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    return np.asarray(turn)
