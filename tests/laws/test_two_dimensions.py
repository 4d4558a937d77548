"""In two dimensions bodies keep to their planes and obey the laws there."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.spatial import quaternion
from carom.systems.energy import angular_momentum, momentum, total_energy
from carom.systems.simulation import Simulation

UP, OUT = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def flat(**settings: Any) -> Simulation:
    """Return a world of two dimensions with bodies askew in it that fall onto each other."""
    generator = np.random.default_rng(3)
    simulation = Simulation(dt=1 / 120, dimensions=2, **settings)
    rough = {"friction": 0.5, "restitution": 0.2}
    for normal in ((0.0, 1.0, 0.0), (0.8, 0.6, 0.0), (-0.8, 0.6, 0.0)):
        simulation.add(collider={"plane": {"normal": normal, "offset": -1.0}}, material=rough)
    for number in range(15):
        turn = quaternion.from_axis_angle((0.0, 0.0, 1.0), generator.uniform(0.0, 3.0))
        simulation.add(
            collider=[{"box": {"size": (0.3, 0.5, 1.0)}}, {"sphere": {"radius": 0.2}}][number % 2],
            body={},
            material=rough,
            transform={"position": (generator.uniform(-0.5, 0.5), 0.7 * number, 0.1 * (number % 3)), "rotation": turn},
            motion={"linear": (*generator.normal(size=2), 0.0), "angular": (0.0, 0.0, generator.normal())},
        )
    return simulation


def test_in_two_dimensions_every_body_keeps_to_its_plane() -> None:
    """Through a pile until it rests: z, and the axes about which nothing turns, are as they were to the bit."""
    simulation = flat()
    world, rows = simulation.world, simulation.world.row_numbers(RigidBody)
    depths = world[Transform].position[rows, 2].copy()
    assert (world[RigidBody].freedom[rows] == [1.0, 1.0, 0.0, 0.0, 0.0, 1.0]).all()
    for _ in range(900):
        simulation.step()
        assert (world[Motion].linear[rows, 2] == 0.0).all()
        assert (world[Motion].angular[rows, :2] == 0.0).all()
        assert (world[Transform].position[rows, 2] == depths).all()
        assert (world[Transform].rotation[rows, :2] == 0.0).all()
    assert np.abs(world[Motion].linear[rows]).max() < 1e-3
    assert np.abs(world[Motion].angular[rows]).max() < 1e-2


def test_in_two_dimensions_a_kinematic_body_goes_along_keyframes() -> None:
    """It turns about z and pushes along x and y, whatever its depth and tilt are."""
    simulation = Simulation(dimensions=2)
    tilted = quaternion.from_axis_angle((0.6, 0.8, 0.0), 0.5)
    turned = quaternion.multiply(quaternion.from_axis_angle((0.0, 0.0, 1.0), 1.0), tilted)
    frames = [
        {"at": 0.0, "position": (0.0, 0.0, 0.5), "rotation": tilted},
        {"at": 1.0, "position": (2.0, 1.0, 0.5), "rotation": turned},
    ]
    guide = simulation.add(body={"type": "kinematic"}, keyframes=frames)
    simulation.step(60)
    assert simulation[guide].transform.position == pytest.approx([2.0, 1.0, 0.5], abs=1e-12)
    assert simulation[guide].transform.rotation == pytest.approx(turned, abs=1e-12)


def test_in_two_dimensions_impacts_keep_momentum_and_angular_momentum() -> None:
    """Along x and y, and about z, to rounding; the others are the plane's to give."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0), dimensions=2)
    surface = {"friction": 0.4, "restitution": 0.7}
    for number, side in enumerate((-1.0, 1.0, 0.1)):
        simulation.add(
            collider={"sphere": {"radius": 0.2}},
            body={},
            material=surface,
            transform={"position": (side, 0.1 * side, 0.1 * number)},
            motion={"linear": (-2.0 * side, 0.3, 0.0), "angular": (0.0, 0.0, 1.0 + side)},
        )
    linear, angular = momentum(simulation.world), angular_momentum(simulation.world)
    simulation.step(240)
    assert simulation.world[Motion].linear[0, 0] < 0.0
    np.testing.assert_allclose(momentum(simulation.world), linear, rtol=1e-12, atol=1e-12)
    assert angular_momentum(simulation.world)[2] == pytest.approx(angular[2], rel=1e-11)


@pytest.mark.parametrize("kind", ["ball", "hinge", "limited hinge", "slider", "fixed"])
def test_joints_hold_a_flat_world_together_as_one_with_depth(kind: str) -> None:
    """Three bodies that fly and turn in the plane, whether the plane is all there is or not.

    Axes of joints turn with bodies and are off the plane by rounding, along which nobody can move where it is.
    """
    words = {"hinge": {"axis": OUT}, "limited hinge": {"axis": OUT, "limits": (-0.3, 0.4)}, "slider": {"axis": UP}}
    random = np.random.default_rng(5)
    linear, angular = random.normal(size=(3, 2)), random.normal(size=3)
    worlds = []
    for dimensions in (2, 3):
        simulation = Simulation(dimensions=dimensions, gravity=(0.0, 0.0, 0.0), sleeping=False)
        for k in range(3):
            simulation.add(
                name=f"link{k}",
                body={"mass": 1.0 + k, "inertia": (0.04, 0.05, 0.06)},
                transform={"position": (float(k), 0.0, 0.0)},
                motion={"linear": (*5.0 * linear[k], 0.0), "angular": (0.0, 0.0, angular[k])},
            )
            if k:
                ends = {"a": f"link{k - 1}", "b": f"link{k}", "at": (k - 0.5, 0.0, 0.0)}
                simulation.add(joint={kind.split()[-1]: words.get(kind, {}) | ends})
        worlds.append(simulation)
    plane, space = worlds
    plane.step()
    energy = total_energy(plane.world)
    for _ in range(60):
        plane.step()
        assert total_energy(plane.world) <= 1.02 * energy  # as much may be in what pulls bodies back to their joints
    space.step(61)
    for k in range(3):
        at, there = plane[f"link{k}"], space[f"link{k}"]
        assert at.transform.position == pytest.approx(there.transform.position, abs=1e-9)
        assert at.transform.rotation == pytest.approx(there.transform.rotation, abs=1e-9)
        assert (at.transform.position[2], at.motion.linear[2], *at.motion.angular[:2]) == (0.0, 0.0, 0.0, 0.0)
