"""One suite for every kind of joint: random bodies under random loads, and what nobody pushes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.components.joint import FREE, LOCKED, Joint
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

AT = (0.3, 0.2, -0.1)
AXIS = {"axis": (1.0, 2.0, -1.0)}
KINDS: dict[str, dict[str, Any]] = {
    "ball": {"at": AT},
    "ball with limits": {"at": AT, "axis": (1.0, 2.0, -1.0), "swing": 0.6, "twist": (-0.3, 0.5)},
    "hinge": {"at": AT} | AXIS,
    "hinge with limits": {"at": AT, "limits": (-0.4, 0.7)} | AXIS,
    "slider": {"at": AT} | AXIS,
    "slider with limits": {"at": AT, "limits": (-0.2, 0.3)} | AXIS,
    "fixed": {"at": AT},
    "universal": {"at": AT, "second_axis": (2.0, -1.0, 0.0)} | AXIS,
    "distance": {"anchor_a": (0.1, 0.0, 0.0), "anchor_b": (0.0, 0.2, 0.0)},
    "rope": {"anchor_a": (0.1, 0.0, 0.0), "anchor_b": (0.0, 0.2, 0.0)},
    "generic": {"at": AT, "x": {"limits": (-0.1, 0.2)}, "rotation_z": "free"},
}


def pair(words: str, seed: int, *, world: bool = False) -> tuple[Simulation, int]:
    """Return two random bodies, or one and the world, on a joint without gravity, and the joint."""
    chance = np.random.default_rng(seed)
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    for name, place in (("a", (0.0, 0.0, 0.0)), ("b", (0.7, 0.5, 0.1))):
        turned = chance.normal(size=4)
        pose = {"position": place, "rotation": turned / np.sqrt((turned**2).sum())}
        inertia = chance.uniform(0.05, 0.1, 3)  # any two are more than the third
        motion = {"linear": chance.normal(size=3), "angular": chance.normal(size=3)}
        body = {"mass": float(chance.uniform(0.5, 3.0)), "inertia": inertia}
        simulation.add(name=name, collider={"sphere": {"radius": 0.1}}, body=body, transform=pose, motion=motion)
    ends = {"b": "b"} if world else {"a": "a", "b": "b"}
    return simulation, simulation.add(joint={words.partition(" ")[0]: KINDS[words] | ends})


def momenta(simulation: Simulation) -> tuple[np.ndarray, np.ndarray]:
    """Return the momentum and the angular momentum about the origin."""
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    motion, body, transform = world[Motion], world[RigidBody], world[Transform]
    linear = body.mass[rows, None] * motion.linear[rows]
    turn = quaternion.multiply(transform.rotation[rows], body.principal_axes[rows])
    inside = quaternion.rotate(quaternion.conjugate(turn), motion.angular[rows])
    spin = quaternion.rotate(turn, body.inertia[rows] * inside)
    return linear.sum(axis=0), (np.cross(transform.position[rows], linear) + spin).sum(axis=0)


@pytest.mark.parametrize("world", [False, True], ids=["two bodies", "the world"])
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_locked_stays_within_a_millimetre_and_a_tenth_of_a_degree(kind: str, world: bool) -> None:
    """Forces of 30 N and torques of 3 N m in any direction, another in every step, do not get it off its place."""
    simulation, joint = pair(kind, seed=len(kind), world=world)
    chance = np.random.default_rng(7)
    simulation.step(10)  # who is stated to move across the joint is stopped by it first
    for _ in range(480):
        for name in "ab":
            force = simulation[name].external_force
            force.force, force.torque = 30.0 * chance.normal(size=3), 3.0 * chance.normal(size=3)
        simulation.step()
        view = simulation[joint].joint
        assert view.gap < 1e-3
        assert view.twist < np.radians(0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_joints_give_and_take_no_momentum(kind: str) -> None:
    """Two bodies that only hold each other keep their momentum, and their angular momentum about any point."""
    simulation, _ = pair(kind, seed=3 + len(kind))
    linear, angular = momenta(simulation)
    simulation.step(480)
    after = momenta(simulation)
    assert after[0] == pytest.approx(linear, abs=1e-12)
    assert after[1] == pytest.approx(angular, abs=1e-9)


@pytest.mark.parametrize("kind", ["hinge", "slider"])
def test_what_is_free_is_not_held(kind: str) -> None:
    """A free way keeps its momentum to rounding: a slider along its axis, a hinge through the centre about it."""
    simulation, joint = pair(kind, seed=11, world=True)
    if kind == "hinge":
        simulation.world.despawn(joint)
        axis = tuple(quaternion.rotate(simulation["b"].transform.rotation, np.array((1.0, 0.0, 0.0))))
        with simulation.world.edit(RigidBody) as body:
            body.principal_axes[simulation.world.row(simulation.world.find("b"))] = (0.0, 0.0, 0.0, 1.0)
        joint = simulation.add(joint={"hinge": {"b": "b", "at": (0.7, 0.5, 0.1), "axis": axis}})
    slot = {"hinge": 3, "slider": 0}[kind]
    simulation.step()
    speed = float(simulation[joint].joint.velocity[slot])
    assert abs(speed) > 0.01
    simulation.step(480)
    assert simulation[joint].joint.velocity[slot] == pytest.approx(speed, rel=1e-9)


def test_a_joint_without_locks_holds_nothing() -> None:
    """Every way free: bodies go as if there were no joint, to the bit, but for being stepped as if in contact."""
    simulation, joint = pair("fixed", seed=5)
    with simulation.world.edit(Joint) as columns:
        columns.mode[simulation.world.row(joint)] = FREE
    before = momenta(simulation)[0], simulation["a"].motion.linear.tolist()
    simulation.step(100)
    assert simulation["a"].motion.linear.tolist() == before[1]
    assert (simulation.world[Joint].mode != LOCKED).all()
