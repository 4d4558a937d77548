"""A body never moves along or turns about an axis that is locked, and is what it was otherwise."""

from __future__ import annotations

import numpy as np
import pytest
from locked import ROTATIONS, SHAPES, askew

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.freedom import AXES
from carom.systems.simulation import Simulation


def heap(integrator: str = "verlet", share: float = 0.35) -> Simulation:
    """Return bodies of all shapes, each with locks of its own, that fall onto an uneven ground in a crosswind."""
    generator = np.random.default_rng(5)
    simulation = Simulation(dt=1 / 120, integrator=integrator)
    rough = {"friction": 0.5, "restitution": 0.4, "rolling_friction": 0.01}
    simulation.add(collider={"plane": {"normal": (0.0, 1.0, 0.0)}}, material=rough)
    simulation.add(collider={"plane": {"normal": (0.6, 0.8, 0.0), "offset": -0.5}}, material=rough)
    simulation.force("wind", velocity=(1.0, 0.5, -2.0))
    simulation.force("linear_drag", coefficient=2.0)
    for number in range(20):
        locked = [axis for axis in AXES if generator.uniform() < share]
        free = np.array([axis not in locked for axis in AXES], np.float64)
        simulation.add(
            collider=SHAPES[number % len(SHAPES)],
            body={"locked": locked, "angular_damping": 0.1},
            material=rough,
            transform={
                "position": generator.uniform(-0.5, 0.5, 3) + np.array([0.0, 1.0 + 0.9 * number, 0.0]),
                "rotation": askew(generator),
            },
            motion={"linear": generator.normal(size=3) * free[:3], "angular": generator.normal(size=3) * free[3:]},
        )
    return simulation


@pytest.mark.parametrize("integrator", ["verlet", "semi_implicit", "euler"])
def test_nothing_moves_along_or_about_a_locked_axis(integrator: str) -> None:
    """Through wind, impacts and rest: velocities are 0.0 to the bit, and centres and rotations stay to the bit."""
    simulation = heap(integrator)
    world, rows = simulation.world, simulation.world.row_numbers(RigidBody)
    free = world[RigidBody].freedom[rows]
    fixed, unturned = free[:, :3] == 0.0, ~free[:, 3:].any(axis=1)
    centred = (world[RigidBody].center_of_mass[rows] == 0.0).all(axis=1) | unturned
    position, rotation = world[Transform].position[rows].copy(), world[Transform].rotation[rows].copy()
    for _ in range(240):
        simulation.step()
        assert (world[Motion].linear[rows][fixed] == 0.0).all()
        assert (world[Motion].angular[rows][free[:, 3:] == 0.0] == 0.0).all()
        held = fixed & centred[:, None]
        assert (world[Transform].position[rows][held] == position[held]).all()
        assert (world[Transform].rotation[rows][unturned] == rotation[unturned]).all()
    moved = np.abs(world[Transform].position[rows] - position)
    assert (moved[~fixed] > 0.0).all()
    assert moved.max() > 1.0


def test_a_velocity_set_from_outside_along_a_locked_axis_is_none() -> None:
    """The next step takes it out before anything moves."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    body = {"mass": 1.0, "locked": ["x", "rotation_y"]}
    entity = simulation.add(collider={"box": {"size": (1.0, 2.0, 3.0)}}, body=body)
    with simulation.world.edit(Motion) as motion:
        motion.linear[0], motion.angular[0] = (1.0, 2.0, 0.0), (0.0, 3.0, 0.0)
    simulation.step()
    assert simulation[entity].transform.position.tolist() == pytest.approx([0.0, 2.0 / 60.0, 0.0], abs=1e-15)
    assert simulation[entity].transform.position[0] == 0.0
    assert simulation[entity].transform.rotation.tolist() == [0.0, 0.0, 0.0, 1.0]


def test_a_push_along_a_stroke_does_its_work_along_the_free_axes() -> None:
    """A bead on a rail leaves a stroke askew to it with the work of what pushes along the rail, to rounding."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    bead = simulation.add(body={"mass": 2.0, "locked": ["y", "z"]})
    simulation.force("constant_push", force=(30.0, 40.0, 0.0), stroke=0.6)
    simulation.step(240)
    assert 0.5 * 2.0 * simulation[bead].motion.linear[0] ** 2 == pytest.approx(30.0 * 0.6 / 0.6, rel=1e-12)


def test_a_compound_keeps_the_locks_of_its_body() -> None:
    """What it carries makes it heavier and no freer; its centre of mass goes only where it may, to the bit."""
    simulation = Simulation(dt=1 / 120)
    body = simulation.add(
        name="sled", collider={"box": {"size": (1.0, 0.2, 0.2)}}, body={"locked": ["y", "z", *ROTATIONS]}
    )
    ball = {"sphere": {"radius": 0.3}}
    simulation.add(collider=ball, parent={"entity": body, "position": (0.3, 0.4, 0.1)})
    assert simulation[body].rigid_body.freedom.tolist() == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    for _ in range(60):
        simulation[body].external_force.force = (100.0, 50.0, 20.0)
        simulation.step()
    mass = simulation[body].rigid_body.mass
    assert simulation[body].motion.linear.tolist() == pytest.approx([50.0 / mass, 0.0, 0.0], rel=1e-12)
    assert simulation[body].transform.position.tolist()[1:] == [0.0, 0.0]
    assert simulation[body].transform.rotation.tolist() == [0.0, 0.0, 0.0, 1.0]
