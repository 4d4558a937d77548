"""Motors press joints against their limits and nothing moves, however hard a body is to turn about itself."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.systems.simulation import Simulation


def arm(turned_by: float, joint: dict[str, Any], **settings: Any) -> Simulation:
    """Return 2 kg at 0.5 m from a joint to the world, with a moment of inertia about its own centre."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), **settings)
    body = {"mass": 2.0, "inertia": (turned_by,) * 3}
    simulation.add(name="arm", transform={"position": (0.5, 0.0, 0.0)}, body=body)
    simulation.add(name="joint", joint=joint)
    return simulation


@pytest.mark.parametrize("own", [1e-4, 0.008, 0.1])
@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 240])
def test_a_motor_holds_a_joint_at_its_limit(own: float, dt: float) -> None:
    """Of its inertia all, or next to none, is that of turning about itself: it comes to the limit and stays."""
    motor = {"speed": 2.0, "most": 3.0}
    hinge = {"b": "arm", "at": (0.0, 0.0, 0.0), "axis": (0.0, 1.0, 0.0), "limits": (-0.1, 0.2), "motor": motor}
    simulation = arm(own, {"hinge": hinge}, dt=dt)
    simulation.step(round(1.0 / dt))
    for _ in range(30):
        simulation.step()
        joint = simulation["joint"].joint
        assert joint.position[3] == pytest.approx(0.2, abs=1e-9)
        assert joint.velocity[3] == pytest.approx(0.0, abs=1e-9)
        assert joint.effort[3] == pytest.approx(3.0, rel=1e-9)
        assert joint.gap < 1e-9


def test_several_ways_at_their_limits_at_once() -> None:
    """Pushed out along x and turned about y and z, each stays at its own limit."""
    push, turn = {"speed": 1.0, "most": 5.0}, {"speed": 1.0, "most": 2.0}
    generic = {
        "b": "arm", "at": (0.0, 0.0, 0.0),
        "x": {"limits": (-0.1, 0.05), "motor": push},
        "rotation_y": {"limits": (-0.2, 0.3), "motor": turn},
        "rotation_z": {"limits": (-0.4, 0.1), "motor": turn},
    }  # fmt: skip
    simulation = arm(0.01, {"generic": generic}, dt=1 / 120)
    simulation.step(240)
    joint = simulation["joint"].joint
    assert joint.position[[0, 4, 5]] == pytest.approx([0.05, 0.3, 0.1], abs=1e-6)
    assert np.abs(joint.velocity).max() < 1e-6
    assert joint.limit.tolist() == [1, 0, 0, 0, 1, 1]


def test_a_limit_without_restitution_takes_all_of_the_speed() -> None:
    """A hinge that comes at 1 rad/s stays where its limit is, and keeps so."""
    hinge = {"b": "arm", "at": (0.0, 0.0, 0.0), "axis": (0.0, 1.0, 0.0), "limits": (-0.1, math.radians(15.0))}
    simulation = arm(0.008, {"hinge": hinge}, dt=1 / 60)
    simulation["arm"].motion.linear, simulation["arm"].motion.angular = (0.0, 0.0, -0.5), (0.0, 1.0, 0.0)
    simulation.step(120)
    assert simulation["joint"].joint.position[3] == pytest.approx(math.radians(15.0), abs=1e-4)
