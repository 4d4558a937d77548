"""Friction of a ball joint resists turning about its axis and across it."""

from __future__ import annotations

import numpy as np
import pytest

from carom.systems.simulation import Simulation


@pytest.mark.parametrize("axis", range(3))
def test_friction_slows_turns_about_the_axis_and_across_it(axis: int) -> None:
    """A torque of 1 N m takes 1 rad/s in a second from 1 kg m2, about x, y or z, as it swings on and on.

    A swing of 0 has no axis yet, which turns the first step's friction aside: hence not to rounding.
    """
    simulation = Simulation(dt=1 / 240, gravity=(0, 0, 0), sleeping=False)
    spin = np.eye(3)[axis]
    simulation.add(name="arm", body={"mass": 1, "inertia": (1, 1, 1)}, motion={"angular": 2.0 * spin})
    ball = {"b": "arm", "at": (0, 0, 0), "axis": (1, 0, 0), "friction": 1.0}
    simulation.add(name="socket", joint={"ball": ball})
    simulation.step(240)
    np.testing.assert_allclose(simulation["arm"].motion.angular, spin, rtol=0, atol=2e-3)
    simulation.step(300)
    np.testing.assert_allclose(simulation["arm"].motion.angular, 0.0, rtol=0, atol=1e-9)
