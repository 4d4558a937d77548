"""Joints: pendulums, tops, hanging chains and ropes, against closed forms."""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np
import pytest
from hinges import BALL, UNIT, G, weightless

from carom.ecs import Motion, Transform
from carom.ecs.components.joint import Joint
from carom.ecs.spatial import quaternion
from carom.systems.energy import kinetic_energy, potential_energies
from carom.systems.simulation import Simulation


def energy(simulation: Simulation) -> float:
    """Return the total energy (J)."""
    return kinetic_energy(simulation.world) + sum(potential_energies(simulation.world).values())


def test_a_pendulum_keeps_its_period_its_energy_and_its_length() -> None:
    """A ball 1 m from its pivot, let go at 90 degrees: 4 K(sin 45) sqrt(L (1 + 2/5 (r/L)^2) / g) a swing."""
    simulation = Simulation(dt=1 / 240, sleeping=False, checked=False)  # twice as fast
    simulation.add(name="bob", collider=BALL, body={"mass": 1.0}, transform={"position": (1.0, 0.0, 0.0)})
    simulation.add(name="pivot", joint={"ball": {"b": "bob", "at": (0.0, 0.0, 0.0)}})
    row, joint = simulation.world.row(simulation.world.find("bob")), simulation.world.find("pivot")
    angles, energies, gaps = [], [], []
    for _ in range(4800):
        simulation.step()
        x, y, _ = simulation.world[Transform].position[row]
        angles.append(np.arctan2(x, -y))
        if simulation.frame % 8 == 0:
            energies.append(energy(simulation))
            gaps.append(float(simulation[joint].joint.gap))
    angle = np.array(angles)
    down = np.nonzero((angle[:-1] > 0.0) & (angle[1:] <= 0.0))[0]
    times = (down + 1 + angle[down] / (angle[down] - angle[down + 1])) / 240
    assert len(times) >= 8
    # The issue asks for 5e-3; the error is of second order in the substep.
    assert np.abs(np.diff(times) - 2.3690256).max() < 1e-4
    assert np.abs(energies).max() < 0.002 * G  # swings about the true one by half a kick: 0.15 %
    assert abs(np.mean(energies[-30:]) - np.mean(energies[:30])) < 2e-4 * G  # and does not drift
    assert max(gaps) < 0.03e-3


def test_a_top_precesses() -> None:
    """Steady precession W of a top: I3 s W = M g l + (I1 - I3) W^2 cos(30 deg), I1 about the point (Goldstein, 5.7)."""
    rate, tilt, spin = 1.57953, radians(30.0), 100.0
    axis = np.array((sin(tilt), cos(tilt), 0.0))
    angular = spin * axis + rate * (np.array((0.0, 1.0, 0.0)) - axis * axis[1])
    simulation = Simulation(dt=1 / 240, sleeping=False, checked=False)
    place = {"position": tuple(0.3 * axis), "rotation": (0.0, 0.0, -sin(tilt / 2), cos(tilt / 2))}
    motion = {"linear": tuple(np.cross(angular, 0.3 * axis)), "angular": tuple(angular)}
    body = {"mass": 1.0, "inertia": (0.01, 0.02, 0.01)}
    simulation.add(name="top", collider=BALL, body=body, transform=place, motion=motion)
    simulation.add(joint={"ball": {"b": "top", "at": (0.0, 0.0, 0.0)}})
    row, turned, tilts = simulation.world.row(simulation.world.find("top")), [], []
    for _ in range(2400):
        simulation.step()
        x, y, z = simulation.world[Transform].position[row]
        turned.append(np.arctan2(-z, x))
        tilts.append(np.arccos(y / 0.3))
    turned = np.unwrap(turned)
    assert (turned[-1] - turned[0]) / (2399 / 240) == pytest.approx(rate, rel=2e-4)  # the issue asks for 2 %
    assert np.abs(np.degrees(tilts) - 30.0).max() < 0.05


@pytest.mark.parametrize(("end", "part"), [(1.0, 0.0012), (100.0, 0.009)])
def test_a_chain_hangs_together(end: float, part: float) -> None:
    """The gaps of 32 links of 0.2 m and 1 kg, the last heavier, sum up to little from the first step on."""
    simulation = Simulation(dt=1 / 240, sleeping=False)
    for n in range(32):
        place = {"position": (0.0, -0.1 - 0.2 * n, 0.0)}
        shape = {"capsule": {"radius": 0.03, "length": 0.14}}
        simulation.add(name=f"{n}", collider=shape, body={"mass": 1.0 if n < 31 else end}, transform=place)
        joint = {"b": f"{n}", "at": (0.0, -0.2 * n, 0.0)} | ({"a": f"{n - 1}"} if n else {})
        simulation.add(joint={"ball": joint})
    joint, rows = simulation.world[Joint], simulation.world.row_numbers(Joint)
    gaps = []
    for _ in range(720):
        simulation.step()
        gaps.append(joint.gap[rows].sum())
    assert max(gaps) < part * 6.4
    assert np.abs(simulation.world[Motion].linear).max() < 0.05
    if end == 1.0:  # with 100 kg it takes its time to come to rest
        assert joint.force[rows, 1] == pytest.approx((32 - np.arange(32)) * G, rel=1e-6)  # on b, which is below


def test_a_spring_that_is_too_stiff_for_the_step_only_settles() -> None:
    """A soft spring of 1e5 N/m on 1 kg, by dt 1/60, never stretches further than it was let go."""
    simulation = weightless(dt=1 / 60)
    simulation.add(name="mass", collider=BALL, body=UNIT, transform={"position": (1.1, 0.0, 0.0)})
    words = {"b": "mass", "anchor_a": (0.0, 0.0, 0.0), "anchor_b": (0.0, 0.0, 0.0), "stiffness": 1e5, "length": 1.0}
    joint = simulation.add(joint={"spring": words})
    stretch = []
    for _ in range(600):
        simulation.step()
        stretch.append(abs(float(simulation[joint].joint.position[0]) - 1.0))
    assert max(stretch) < 0.1
    assert stretch[-1] < 1e-9


@pytest.mark.parametrize("beside", [False, True])
def test_a_rope_that_hangs_slack_is_not_felt(beside: bool) -> None:
    """A ball below its knot falls as if there were no rope, to the last bit, until the rope is taut; then it hangs.

    So it does where another hangs on a spring.
    """
    places = []
    for rope in (False, True):
        simulation = Simulation(dt=1 / 240, sleeping=False)
        place = {"position": (0.0, -0.5, 0.0)}
        simulation.add(name="ball", collider=BALL, body={"mass": 1.0}, transform=place)
        if rope:
            words = {"b": "ball", "anchor_a": (0.0, 0.0, 0.0), "anchor_b": (0.0, 0.0, 0.0), "length": 1.0}
            joint = simulation.add(joint={"rope": words})
        if beside:
            simulation.add(name="other", collider=BALL, body={"mass": 1.0}, transform={"position": (9.0, -0.5, 0.0)})
            spring = {"b": "other", "anchor_a": (9.0, 0.0, 0.0), "stiffness": 50.0, "damping": 1.0}
            simulation.add(joint={"spring": spring})
        simulation.step(60)
        places.append(simulation["ball"].transform.position.tolist())
    assert places[0] == places[1]
    assert not simulation[joint].joint.force.any()
    simulation.step(480)
    assert simulation[joint].joint.force == pytest.approx((0.0, G, 0.0), abs=1e-6)
    assert simulation[joint].joint.position[0] == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("aside", [0.0, 0.5])
@pytest.mark.parametrize("also", [(), ("rotation_x",), ("rotation_z",)])
def test_a_generic_joint_turns_on_beyond_a_quarter_turn(also: tuple[str, ...], aside: float) -> None:
    """A box turns twice about the second of three axes, through where the first and the third are one.

    It gains no energy there, and loses less than a ten-thousandth.
    """
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0), sleeping=False)
    spin = (0.0, aside, -3.0)
    motion = {"linear": tuple(np.cross(spin, (0.3, 0.0, 0.0)).tolist()), "angular": spin}
    collider = {"box": {"size": (0.4, 0.2, 0.1)}}
    simulation.add(name="box", collider=collider, body={"mass": 1}, motion=motion, transform={"position": (0.3, 0, 0)})
    frame = {"b": "box", "at": (0.0, 0.0, 0.0), "axis": (1.0, 0.0, 0.0), "second_axis": (0.0, 1.0, 0.0)}
    joint = simulation.add(joint={"generic": frame | dict.fromkeys(("rotation_y", *also), "free")})
    simulation.step()
    energies = [energy(simulation)]
    for _ in range(239):
        simulation.step()
        energies.append(energy(simulation))
        assert simulation[joint].joint.gap < 1e-4
    assert max(energies) < (1.0 + 1e-6) * energies[0]
    assert energies[-1] > 0.9999 * energies[0]
    angle = simulation[joint].joint.position[4]
    assert angle == pytest.approx(12.0, rel=1e-3) if not (aside and "rotation_z" in also) else angle > 12.0


def test_a_turned_world_swings_alike() -> None:
    """A double pendulum and the same turned by any rotation end in the same pose, turned."""
    ends = []
    about = quaternion.from_axis_angle((1.0, 2.0, -0.5), 1.3)
    for turn in (np.array((0.0, 0.0, 0.0, 1.0)), about):
        gravity = tuple(quaternion.rotate(turn, np.array((0.0, -G, 0.0))).tolist())
        simulation = Simulation(dt=1 / 240, sleeping=False, gravity=gravity)
        for n in range(2):
            place = quaternion.rotate(turn, np.array((0.5 + n, 0.0, 0.0)))
            shape, pose = {"box": {"size": (0.8, 0.1, 0.1)}}, {"position": place, "rotation": turn}
            simulation.add(name=f"{n}", collider=shape, body={"mass": 1.0}, transform=pose)
            words = {"b": f"{n}", "at": quaternion.rotate(turn, np.array((float(n), 0.0, 0.0)))}
            words |= {"axis": quaternion.rotate(turn, np.array((0.0, 0.0, 1.0)))} | ({"a": "0"} if n else {})
            simulation.add(joint={"hinge": words})
        simulation.step(240)
        ends.append(quaternion.rotate(quaternion.conjugate(turn), simulation["1"].transform.position))
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)  # a double pendulum makes more of rounding
