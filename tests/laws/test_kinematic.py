"""Kinematic bodies push, carry and strike, and nothing moves them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs.column import Floats
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Enter
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

G = 9.81
MU = 0.5
ROUGH = {"friction": MU}
CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
SHAPES: dict[str, dict[str, Any]] = {
    "ball": {"sphere": {"radius": 0.1}},
    "box": {"box": {"size": (0.2, 0.2, 0.2)}},
    "capsule": {"capsule": {"radius": 0.1, "length": 0.3}},
}


def world(gravity: float = G, dt: float = 1 / 60) -> Simulation:
    """Return an empty world."""
    return Simulation(dt=dt, gravity=(0.0, -gravity, 0.0), checked=False)


def add_kinematic(simulation: Simulation, size: tuple[float, ...], *position: float, **motion: Any) -> int:
    """Add a box that keeps its motion."""
    return simulation.add(
        collider={"box": {"size": size}},
        body={"type": "kinematic"},
        material=ROUGH,
        transform={"position": position},
        motion=motion,
    )


def add_cube(simulation: Simulation, *position: float, **motion: Any) -> int:
    """Add a cube of 1 m and 1 kg."""
    return simulation.add(
        collider=CUBE, body={"mass": 1.0}, material=ROUGH, transform={"position": position}, motion=motion
    )


def test_a_slab_pushes_a_cube_over_the_ground_at_its_own_speed() -> None:
    """At 1 m/s, against friction: the cube has the slab's speed to 1e-6 and stays in touch to 10 micrometres."""
    simulation = world()
    simulation.add(collider={"plane": {}}, material=ROUGH)
    slab = add_kinematic(simulation, (0.2, 1.0, 2.0), -0.65, 0.5, 0.0, linear=(1.0, 0.0, 0.0))
    cube = add_cube(simulation, 0.0, 0.5, 0.0)
    simulation.step(60)
    for _ in range(60):
        simulation.step()
        assert simulation[cube].motion.linear[0] == pytest.approx(1.0, abs=1e-6)
        gap = simulation[cube].transform.position[0] - simulation[slab].transform.position[0] - 0.6
        assert gap == pytest.approx(0.0, abs=1e-5)
    assert simulation[slab].transform.position == pytest.approx([1.35, 0.5, 0.0], abs=1e-12)


@pytest.mark.parametrize("speed", [1.0, -1.0], ids=["up", "down"])
def test_a_lift_carries_a_stack(speed: float) -> None:
    """Three cubes go along without sinking in or bouncing: just as deep in each other as on a floor that stands."""
    depths = []
    for lifted in (0.0, speed):
        simulation = world()
        lift = add_kinematic(simulation, (4.0, 0.5, 4.0), 0.0, -0.25, 0.0, linear=(0.0, lifted, 0.0))
        cubes = [add_cube(simulation, 0.0, 0.5 + i, 0.0, linear=(0.0, lifted, 0.0)) for i in range(3)]
        simulation.step(60)
        for _ in range(60):
            simulation.step()
            for cube in cubes:
                assert simulation[cube].motion.linear[1] == pytest.approx(lifted, abs=1e-5)
        top = simulation[lift].transform.position[1] + 0.25
        depths.append([0.5 + i - (simulation[cube].transform.position[1] - top) for i, cube in enumerate(cubes)])
    assert depths[1] == pytest.approx(depths[0], abs=1e-8)
    assert depths[1][0] == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("collision", ["auto", "fcl"])
@pytest.mark.parametrize(
    ("shape", "height"),
    [(CUBE, 0.5), ({**SHAPES["capsule"], "rotation": (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))}, 0.1)],
    ids=["cube", "capsule along the way"],
)
def test_friction_drags_a_body_up_to_the_speed_of_its_platform(
    shape: dict[str, Any], height: float, collision: str
) -> None:
    """By mu g in every step until it has 1 m/s, then it rides; it falls behind as the discrete sum says."""
    simulation = Simulation(checked=False, collision=collision)
    platform = add_kinematic(simulation, (40.0, 0.5, 4.0), 0.0, -0.25, 0.0, linear=(1.0, 0.0, 0.0))
    cube = simulation.add(
        collider=shape, body={"mass": 1.0}, material=ROUGH, transform={"position": (0.0, height, 0.0)}
    )
    for step in range(1, 13):
        simulation.step()
        assert simulation[cube].motion.linear[0] == pytest.approx(MU * G * step / 60, rel=1e-3)
    simulation.step(60)
    assert simulation[cube].motion.linear == pytest.approx([1.0, 0.0, 0.0], abs=1e-5)
    behind = sum(1.0 - min(1.0, MU * G * k / 240) for k in range(1, 240)) / 240
    fell = simulation[platform].transform.position[0] - simulation[cube].transform.position[0]
    assert fell == pytest.approx(behind, rel=2e-3)


def on_a_turntable(pull: float, dt: float) -> float:
    """Return how far from the axis a cube of 10 cm ends up after 5 s that needs ``pull`` times mu g at 1 m."""
    spin = math.sqrt(pull * MU * G)
    simulation = world(dt=dt)
    add_kinematic(simulation, (80.0, 0.5, 80.0), 0.0, -0.25, 0.0, angular=(0.0, spin, 0.0))
    cube = simulation.add(
        collider={"box": {"size": (0.1, 0.1, 0.1)}},
        body={"mass": 1.0},
        material=ROUGH,
        transform={"position": (1.0, 0.05, 0.0)},
        motion={"linear": (0.0, 0.0, -spin), "angular": (0.0, spin, 0.0)},
    )
    simulation.step(round(5.0 / dt))
    x, _, z = simulation[cube].transform.position
    return math.hypot(x, z)


@pytest.mark.parametrize("dt", [1 / 60, 1 / 240])
def test_a_turntable_carries_a_cube_up_to_mu_g(dt: float) -> None:
    """At omega^2 r = 0.98 mu g it stays where it is to 0.1 mm for 5 s, at 1.02 mu g it slips off."""
    assert on_a_turntable(0.98, dt) == pytest.approx(1.0, abs=1e-4)
    assert on_a_turntable(1.02, dt) > 5.0


def test_a_ball_on_a_turntable_goes_in_circles_at_two_sevenths() -> None:
    """It keeps its speed and turns at 2/7 of the table's (Weltner, American Journal of Physics 47, 984, 1979)."""
    spin, turns = 3.0, 2
    simulation = world()
    add_kinematic(simulation, (80.0, 0.5, 80.0), 0.0, -0.25, 0.0, angular=(0.0, spin, 0.0))
    ball = simulation.add(
        collider=SHAPES["ball"],
        body={"mass": 1.0},
        material=ROUGH,
        transform={"position": (0.0, 0.1, 0.0)},
        motion={"linear": (0.5, 0.0, 0.0), "angular": (0.0, 0.0, -5.0)},
    )
    steps = round(turns * 2.0 * math.pi / (2.0 / 7.0 * spin) * 60)
    simulation.step(steps)
    x, _, z = simulation[ball].motion.linear
    turned = 2.0 / 7.0 * spin * steps / 60 - turns * 2.0 * math.pi
    assert (math.hypot(x, z), math.atan2(-z, x)) == pytest.approx((0.5, turned), abs=1e-3)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("wall", "before"), [(1.0, -2.0), (-1.0, -3.0), (2.0, 0.0)])
def test_what_bounces_off_a_moving_wall_leaves_at_twice_its_speed_less_its_own(
    shape: str, wall: float, before: float
) -> None:
    """An elastic impact on a wall at u turns v into 2 u - v."""
    simulation = world(gravity=0.0)
    add_kinematic(simulation, (0.2, 4.0, 4.0), -1.0, 0.0, 0.0, linear=(wall, 0.0, 0.0))
    body = simulation.add(
        collider=SHAPES[shape],
        body={"mass": 1.0},
        material={"friction": MU, "restitution": 1.0},
        transform={"position": (0.313, 0.0, 0.0)},
        motion={"linear": (before, 0.0, 0.0)},
    )
    simulation.step(120)
    assert simulation[body].motion.linear == pytest.approx([2.0 * wall - before, 0.0, 0.0], abs=1e-9)
    assert simulation[body].motion.angular == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_nothing_moves_a_kinematic_body() -> None:
    """In a crowd that falls on it, it turns and goes bit for bit as it does alone; so does its velocity."""
    ways = []
    for crowded in (False, True):
        simulation = world()
        plough = add_kinematic(
            simulation, (3.0, 0.5, 1.0), 0.0, 0.0, 0.0, linear=(1.0, 0.2, 0.0), angular=(1.0, 2.0, 3.0)
        )
        for k, shape in enumerate(list(SHAPES.values()) * 4 if crowded else []):
            place = (0.5 * (k % 4) - 0.2, 0.8 + 0.4 * (k // 4), 0.1 * k - 0.5)
            simulation.add(collider=shape, body={}, material={"restitution": 0.5}, transform={"position": place})
        simulation.step(120)
        pose, motion = simulation[plough].transform, simulation[plough].motion
        ways.append([value.tobytes() for value in (pose.position, pose.rotation, motion.linear, motion.angular)])
        assert motion.angular.tolist() == [1.0, 2.0, 3.0]
    assert ways[0] == ways[1]


@pytest.mark.parametrize("tilt", [0.002, 0.005, -0.004])
def test_who_lands_on_a_kinematic_floor_does_as_on_one_that_stands(tilt: float) -> None:
    """The other end of a plank strikes within the same substep; its bounces multiply rounding by up to 1e7."""
    material = {"restitution": 0.5, "friction": 0.3}

    def land(**floor: Any) -> Floats:
        simulation = Simulation(sleeping=False)
        box = {"box": {"size": (6.0, 1.0, 6.0)}}
        simulation.add(collider=box, transform={"position": (0.0, -0.5, 0.0)}, material=material, **floor)
        plank = simulation.add(
            collider={"box": {"size": (2.0, 0.2, 0.4)}}, body={"mass": 1.0}, material=material,
            transform={"position": (0.0, 0.35, 0.0), "rotation": quaternion.from_axis_angle((0.0, 0.0, 1.0), tilt)},
            motion={"linear": (0.0, -6.0, 0.0)},
        )  # fmt: skip
        simulation.step(20)
        return np.concatenate([simulation[plank].transform.position, simulation[plank].motion.angular])

    np.testing.assert_allclose(land(body={"type": "kinematic"}), land(), atol=1e-6)


def test_kinematic_bodies_pass_through_each_other_and_what_stands() -> None:
    """Nothing could push them apart, so there is no contact; a sensor notices them all the same."""
    simulation = world()
    simulation.add(collider={"plane": {}})
    for x in (0.0, 0.5):
        add_kinematic(simulation, (1.0, 1.0, 1.0), x, 0.4, 0.0)
    sensor = simulation.add(collider={**CUBE, "sensor": True}, transform={"position": (-0.5, 0.4, 0.0)})
    simulation.step()
    assert simulation.world.count(Contact) == 0
    enter = simulation.world[Enter]
    assert enter.sensor[: enter.count].tolist() == [sensor, sensor]
    assert np.isin(enter.entity[: enter.count], simulation.world.handles()).all()
