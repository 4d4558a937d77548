"""Free-body diagrams hold to the laws: each force is that of its law, and together they are mass times acceleration."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import ExternalForce, Force, Motion, World
from carom.ecs.column import Integers
from carom.ecs.components.joint import Joint
from carom.ecs.snapshot import state_hash
from carom.systems.free_body import Loads, loads
from carom.systems.simulation import Simulation

GRAVITY = 9.81
BALL = {"sphere": {"radius": 0.5}}


def named(simulation: Simulation, name: str) -> Loads:
    """Return the forces of one name."""
    found = loads(simulation)
    which = np.array([one == name for one in found.name], np.bool_)
    return Loads(found.body[which], found.point[which], found.force[which], [name] * int(which.sum()))


def resting(**settings: object) -> Simulation:
    """Return a ball of 2 kg that has lain on the ground for a while."""
    simulation = Simulation(**settings)
    simulation.add(name="ground", collider={"plane": {}})
    simulation.add(name="ball", collider=BALL, body={"mass": 2.0}, transform={"position": (1.0, 0.5, 0.0)})
    simulation.step(90)
    return simulation


@pytest.mark.parametrize("sleeping", [False, True])
def test_what_rests_is_carried_where_it_touches(sleeping: bool) -> None:
    """Weight at the centre and the normal force at the ground are equal and opposite, also of what sleeps."""
    simulation = resting(sleeping=sleeping)
    assert bool(simulation["ball"].motion.asleep) is sleeping
    found = loads(simulation)
    assert found.name == ["gravity", "normal"]
    assert found.force == pytest.approx(np.array([(0.0, -2.0 * GRAVITY, 0.0), (0.0, 2.0 * GRAVITY, 0.0)]), rel=1e-3)
    assert found.point == pytest.approx(np.array([(1.0, 0.5, 0.0), (1.0, 0.0, 0.0)]), abs=1e-4)


def test_on_a_slope_friction_is_mu_times_the_normal_force() -> None:
    """A sliding box is held back by mu N, N = m g cos, and the sum of all is m g (sin - mu cos) down the slope."""
    slope, mu, mass = math.radians(30.0), 0.3, 10.0
    normal, down = np.array([-math.sin(slope), math.cos(slope), 0.0]), np.array([-math.cos(slope), -math.sin(slope), 0])
    simulation = Simulation(dt=1 / 240)
    simulation.add(collider={"plane": {"normal": tuple(normal)}}, material={"friction": mu})
    turned = {"position": tuple(0.5 * normal), "rotation": (0.0, 0.0, math.sin(slope / 2.0), math.cos(slope / 2.0))}
    crate = {"collider": {"box": {"size": (1.0, 1.0, 1.0)}}, "material": {"friction": mu}}
    simulation.add(**crate, body={"mass": mass}, transform=turned)
    simulation.step(60)
    weight = mass * GRAVITY
    pressed, rubbed = (named(simulation, name).force.sum(axis=0) for name in ("normal", "friction"))
    assert pressed == pytest.approx(weight * math.cos(slope) * normal, rel=1e-3, abs=1e-2)
    assert rubbed == pytest.approx(-mu * weight * math.cos(slope) * down, rel=1e-3, abs=1e-2)
    total = weight * (math.sin(slope) - mu * math.cos(slope)) * down
    assert loads(simulation).force.sum(axis=0) == pytest.approx(total, rel=1e-3, abs=2e-2)


def test_each_law_has_its_own_part() -> None:
    """Weight by scale, drag c (w - v) in the wind, 1/2 rho Cd A |w - v| (w - v), a push, damping, and from outside."""
    simulation = Simulation()
    body = {"mass": 2.0, "gravity_scale": 0.5, "linear_damping": 0.1}
    ball = simulation.add(name="ball", collider=BALL, body=body, motion={"linear": (3.0, 0.0, 0.0)})
    simulation.force("wind", velocity=(0.0, 0.0, 4.0))
    simulation.force("linear_drag", coefficient=0.7)
    simulation.force("quadratic_drag", area=0.2, drag_coefficient=0.5, density=2.0)
    simulation.force("constant_push", force=(0.0, 6.0, 0.0))

    def lift(world: World, rows: Integers) -> np.ndarray:
        return np.tile((0.0, 1.5, 0.0), (len(rows), 1))

    simulation.force_function(lift)
    with simulation.world.edit(ExternalForce) as external:
        external.force[simulation.world.row(ball)] = (0.0, 0.0, 9.0)
    found = loads(simulation)
    past = np.array([-3.0, 0.0, 4.0])
    assert dict(zip(found.name, found.force.tolist(), strict=True)) == {
        "external": [0.0, 0.0, 9.0],
        "gravity": [0.0, -GRAVITY, 0.0],
        "linear drag": pytest.approx((0.7 * past).tolist()),
        "quadratic drag": pytest.approx((0.5 * 2.0 * 0.5 * 0.2 * 5.0 * past).tolist()),
        "lift": [0.0, 1.5, 0.0],
        "damping": pytest.approx([-2.0 * 0.1 * 3.0, 0.0, 0.0]),
        "constant push": pytest.approx([0.0, 6.0, 0.0]),
    }


def test_they_add_up_to_mass_times_acceleration() -> None:
    """In free fall with drag, the sum of a body's forces is m dv / dt of the next short step."""
    simulation = Simulation(dt=1e-4)
    simulation.add(name="ball", collider=BALL, body={"mass": 2.0}, motion={"linear": (3.0, 5.0, -1.0)})
    simulation.force("quadratic_drag", area=0.8)
    before, total = simulation["ball"].motion.linear.copy(), loads(simulation).force.sum(axis=0)
    simulation.step()
    assert total == pytest.approx(2.0 * (simulation["ball"].motion.linear - before) / 1e-4, rel=1e-3)


def test_action_is_reaction() -> None:
    """What two bodies that collide do to each other is equal and opposite, at the same points."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), dt=1 / 60)
    for x, speed in ((-0.5, 2.0), (0.5, -1.0)):
        place, motion = {"position": (x, 0.05 * speed, 0.0)}, {"linear": (speed, 0.0, 0.0)}
        simulation.add(collider=BALL, body={"mass": 1.0 + speed**2}, transform=place, motion=motion)
    simulation.step()
    for name in ("normal", "friction"):
        found = named(simulation, name)
        assert sorted(found.body.tolist()) == [0, 1]
        assert np.array_equal(found.point[0], found.point[1])
        assert found.force[0] == pytest.approx(-found.force[1])
        assert np.linalg.norm(found.force[0]) > 1.0


def test_asking_changes_nothing() -> None:
    """A run that is asked after every step is the same to the bit, forces summed in the last substep included."""
    runs = []
    for asked in (False, True):
        simulation = resting()
        simulation.add(collider=BALL, body={}, transform={"position": (1.2, 3.0, 0.0)})
        simulation.force("linear_drag", coefficient=0.1)
        for _ in range(60):
            simulation.step()
            if asked:
                loads(simulation)
        runs.append(simulation)
    plain, asked_run = (run.world for run in runs)
    assert state_hash(plain) == state_hash(asked_run)
    rows = plain.row_numbers(Motion)
    for column in Force.columns:
        assert np.array_equal(getattr(plain[Force], column)[rows], getattr(asked_run[Force], column)[rows])


def test_a_world_without_bodies_has_no_forces() -> None:
    """Columns are empty, of their shapes."""
    found = loads(Simulation())
    assert (found.body.shape, found.point.shape, found.force.shape, found.name) == ((0,), (0, 3), (0, 3), [])


def test_joints_carry_what_hangs_on_them() -> None:
    """Of two that hang one below the other the upper joint carries both; the lower one pulls both ways alike."""
    simulation = Simulation(dt=1 / 240, sleeping=False)
    ends = {}
    for number, name in enumerate(("upper", "lower")):
        place = {"position": (0.0, -1.0 - number, 0.0)}
        ends[name] = simulation.add(name=name, collider=BALL | {"layer": "none"}, body={"mass": 2.0}, transform=place)
    for a, b in ((-1, ends["upper"]), (ends["upper"], ends["lower"])):
        simulation.world.spawn(Joint(a=a, b=b, anchor_b=(0.0, 1.0, 0.0), mode=(1, 1, 1, 0, 0, 0)))
    simulation.step(240)
    found = named(simulation, "joint")
    assert found.body.tolist() == [simulation.world.row(ends[name]) for name in ("upper", "upper", "lower")]
    weight = 2.0 * GRAVITY
    expected = np.array([(0.0, -weight, 0.0), (0.0, 2.0 * weight, 0.0), (0.0, weight, 0.0)])
    assert found.force == pytest.approx(expected, rel=1e-6, abs=1e-9)
    assert found.point == pytest.approx(np.array([(0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, -1.0, 0.0)]), abs=1e-4)


def test_thrust_acts_where_it_is_stated() -> None:
    """A thruster at a place of a body that leans by a quarter turn is drawn there, on others at theirs."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    turned = {"position": (1.0, 0.0, 0.0), "rotation": (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))}
    leaning = simulation.add(collider=BALL, body={"mass": 2.0}, transform=turned)
    other = simulation.add(collider=BALL, body={"mass": 2.0}, transform={"position": (9.0, 0.0, 0.0)})
    simulation.force("thruster", [leaning], force=(1.0, 0.0, 0.0), at=(0.5, 0.0, 0.2))
    simulation.force("thruster", [other], force=(0.0, 1.0, 0.0), at=(0.0, -0.5, 0.0))
    found = named(simulation, "thruster")
    assert found.force == pytest.approx(np.array([(0.0, 1.0, 0.0), (0.0, 1.0, 0.0)]), abs=1e-12)
    assert found.point == pytest.approx(np.array([(1.0, 0.5, 0.2), (9.0, -0.5, 0.0)]), abs=1e-12)
