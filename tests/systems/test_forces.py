"""Forces against their closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.systems.energy import potential_energy, total_energy
from carom.systems.simulation import Simulation

DT = 1 / 240
WIND = np.array([5.0, 0.0, -2.0])
START = np.array([10.0, 3.0, 0.0])


def flying(mass: float = 2.0, **settings: object) -> tuple[Simulation, int]:
    """Return a ball of 2 kg in free flight without gravity."""
    simulation = Simulation(**{"dt": DT, "gravity": (0.0, 0.0, 0.0), **settings})
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"mass": mass}, motion={"linear": START})
    return simulation, ball


@pytest.mark.parametrize("winds", [[WIND], [WIND / 2.0, WIND / 2.0], []], ids=["one", "two", "none"])
def test_linear_drag_in_wind(winds: list[Floats]) -> None:
    """The velocity relaxes to that of the wind by exp(-c t / m), to rounding; the way is right to 1e-5 m."""
    simulation, ball = flying()
    simulation.force("linear_drag", coefficient=3.0)
    for wind in winds:
        simulation.force("wind", velocity=tuple(wind))
    simulation.step(240)
    medium = WIND if winds else np.zeros(3)
    left = math.exp(-3.0 / 2.0)
    assert simulation[ball].motion.linear == pytest.approx(medium + (START - medium) * left, rel=1e-12)
    way = medium + (START - medium) * (1.0 - left) * 2.0 / 3.0
    assert simulation[ball].transform.position == pytest.approx(way, abs=1e-5)


@pytest.mark.parametrize("wind", [np.zeros(3), WIND], ids=["still", "wind"])
def test_quadratic_drag_in_wind_is_second_order(wind: Floats) -> None:
    """The speed u through the medium becomes u / (1 + k u t / m), k = rho Cd A / 2; half the step, a quarter off."""
    k, through = 0.5 * 1.2 * 0.5 * 0.3, START - wind
    wanted = wind + through / (1.0 + k * float(np.linalg.norm(through)) / 2.0)
    errors = []
    for dt in (1 / 30, 1 / 60):
        simulation, ball = flying(dt=dt)
        simulation.force("quadratic_drag", area=0.3, drag_coefficient=0.5, density=1.2)
        simulation.force("wind", velocity=tuple(wind))
        simulation.step(round(1.0 / dt))
        errors.append(float(np.linalg.norm(simulation[ball].motion.linear - wanted)))
    assert errors[0] < 2e-5
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_drag_does_not_overshoot() -> None:
    """However strong, drag brings a body to rest in the medium and never turns it round."""
    simulation, ball = flying(dt=1.0)
    simulation.force("linear_drag", coefficient=1e6)
    simulation.step()
    assert simulation[ball].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)


def test_a_fall_ends_at_terminal_speed() -> None:
    """Where quadratic drag bears the weight: v = sqrt(2 m g / (rho Cd A))."""
    simulation, ball = flying(gravity=(0.0, -9.81, 0.0), dt=1 / 60)
    simulation.force("quadratic_drag", area=0.3)
    simulation.step(1800)
    terminal = math.sqrt(2.0 * 2.0 * 9.81 / (1.225 * 0.47 * 0.3))
    assert simulation[ball].motion.linear == pytest.approx([0.0, -terminal, 0.0], abs=1e-5 * terminal)


@pytest.mark.parametrize("mass", [0.5, 2.0, 50.0])
@pytest.mark.parametrize("dt", [1 / 60, 1 / 240])
def test_a_push_over_a_stroke_does_force_times_stroke(mass: float, dt: float) -> None:
    """A shell leaves a barrel of 2 m with sqrt(2 F L / m), whatever its mass and wherever the steps fall; 1e-9."""
    simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
    along = np.array([0.6, 0.8, 0.0])
    shell = simulation.add(
        collider={"sphere": {"radius": 0.1}}, body={"mass": mass}, transform={"position": (1.0, 1.0, 1.0)}
    )
    simulation.force("constant_push", force=tuple(1000.0 * along), start=(1.0, 1.0, 1.0), stroke=2.0)
    simulation.step(round(1.0 / dt))
    assert simulation[shell].motion.linear == pytest.approx(along * math.sqrt(2.0 * 1000.0 * 2.0 / mass), abs=1e-9)


def test_an_endless_push_is_an_acceleration() -> None:
    """Without a stroke v = F t / m for good, and only those it is given to feel it."""
    simulation, ball = flying()
    other = simulation.add(
        collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, transform={"position": (0.0, -5.0, 0.0)}
    )
    gone = simulation.add(
        collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, transform={"position": (9.0, 9.0, 9.0)}
    )
    simulation.force("constant_push", [ball, gone], force=(0.0, 0.0, 4.0))
    simulation.world.despawn(gone)
    simulation.step(240)
    assert simulation[ball].motion.linear == pytest.approx([10.0, 3.0, 2.0], abs=1e-12)
    assert simulation[other].motion.linear.tolist() == [0.0, 0.0, 0.0]


def test_an_external_force_holds_for_one_step() -> None:
    """Set from outside, it acts in all substeps of the next step and is then spent."""
    simulation, ball = flying()
    simulation[ball].external_force.force = (0.0, 0.0, 480.0)
    simulation.step(3)
    assert simulation[ball].motion.linear == pytest.approx([10.0, 3.0, 1.0], abs=1e-12)
    assert simulation[ball].external_force.force.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("rolling", [0.05, 5.0])
def test_rolling_friction_never_exceeds_friction(rolling: float) -> None:
    """However stiff the rolling, the ball slows by mu g at most, and friction stays within its cone."""
    simulation = Simulation(dt=DT)
    rough = {"friction": {"value": 0.1, "combine": "max"}, "rolling_friction": rolling}
    simulation.add(collider={"plane": {"offset": -0.1}}, material=rough)
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"mass": 1.0},
        material={"friction": 0.1},
        motion={"linear": (2.0, 0.0, 0.0), "angular": (0.0, 0.0, -20.0)},
    )
    before = 2.0
    for _ in range(240):
        simulation.step()
        speed = float(simulation[ball].motion.linear[0])
        assert before - speed <= 0.1 * 9.81 * DT * (1.0 + 1e-9)
        before = speed
        contact = simulation.world[Contact]
        assert np.linalg.norm(contact.friction_impulse[0]) <= 0.1 * contact.impulse[0] * (1.0 + 1e-9)
    assert 0.0 <= speed < 2.0


def test_a_force_fixed_to_a_turning_body_is_second_order() -> None:
    """A spinning thruster flies a/w^2 (1 - cos wt, wt - sin wt); half the step, a quarter of the error."""
    a, w = 3.0, 4.0

    def thrust(world: World, rows: Integers) -> Floats:
        """Push along the body's own x axis."""
        from carom.ecs import RigidBody, Transform

        return (
            a
            * world[RigidBody].mass[rows, None]
            * quaternion.rotate(world[Transform].rotation[rows], np.array([1.0, 0.0, 0.0]))
        )

    errors = []
    for dt in (1 / 30, 1 / 60):
        simulation = Simulation(dt=dt, substeps=1, gravity=(0.0, 0.0, 0.0))
        ball = simulation.add(
            collider={"sphere": {"radius": 0.1}}, body={"mass": 2.0}, motion={"angular": (0.0, 0.0, w)}
        )
        simulation.force_function(thrust)
        simulation.step(round(2.0 / dt))
        wanted = a / w**2 * np.array([1.0 - math.cos(2.0 * w), 2.0 * w - math.sin(2.0 * w), 0.0])
        errors.append(float(np.linalg.norm(simulation[ball].transform.position - wanted)))
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("integrator", ["verlet", "semi_implicit", "euler"])
def test_damping_is_exponential(integrator: str) -> None:
    """Velocities are v0 exp(-c t) and w0 exp(-d t) to rounding, whatever the wind."""
    linear, angular = 0.7, 1.9
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0), integrator=integrator)
    simulation.force("wind", velocity=tuple(WIND))
    spin = np.array([1.0, -2.0, 3.0])
    damping = {"linear_damping": linear, "angular_damping": angular}
    motion = {"linear": START, "angular": spin}
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body=damping, motion=motion)
    simulation.step(480)
    assert simulation[ball].motion.linear == pytest.approx(START * math.exp(-2.0 * linear), rel=1e-12)
    assert simulation[ball].motion.angular == pytest.approx(spin * math.exp(-2.0 * angular), rel=1e-12)


def test_the_ways_of_damped_bodies_are_second_order() -> None:
    """The way is v0 (1 - exp(-c t)) / c and the angle likewise; half the step, a quarter off."""
    errors = []
    for dt in (1 / 30, 1 / 60):
        simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
        ball = simulation.add(
            collider={"sphere": {"radius": 0.1}},
            body={"linear_damping": 3.0, "angular_damping": 2.0},
            motion={"linear": (1.0, 0.0, 0.0), "angular": (0.0, 1.0, 0.0)},
        )
        simulation.step(round(1.0 / dt))
        turned = 2.0 * math.asin(simulation[ball].transform.rotation[1])
        way, angle = (1.0 - math.exp(-3.0)) / 3.0, (1.0 - math.exp(-2.0)) / 2.0
        errors.append((simulation[ball].transform.position[0] - way, turned - angle))
    assert np.log2(np.divide(*errors)) == pytest.approx([2.0, 2.0], abs=0.01)
    assert np.abs(errors[0]).max() < 1e-4


def test_drag_and_damping_add_up() -> None:
    """dv/dt = -c/m (v - wind) - d v draws to c wind / (c + m d) at the rate c/m + d, to rounding."""
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0))
    simulation.force("linear_drag", coefficient=3.0)
    simulation.force("wind", velocity=tuple(WIND))
    body = {"mass": 2.0, "linear_damping": 0.5}
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body=body, motion={"linear": START})
    simulation.step(240)
    drawn = 3.0 * WIND / (3.0 + 2.0 * 0.5)
    assert simulation[ball].motion.linear == pytest.approx(drawn + (START - drawn) * math.exp(-2.0), rel=1e-12)


def test_a_kinematic_body_is_not_damped() -> None:
    """It keeps the velocity it is given, to the bit."""
    simulation = Simulation(dt=DT)
    body = {"type": "kinematic", "linear_damping": 1.0, "angular_damping": 1.0}
    lift = simulation.add(body=body, motion={"linear": START, "angular": WIND})
    simulation.step(10)
    assert simulation[lift].motion.linear.tolist() == START.tolist()
    assert simulation[lift].motion.angular.tolist() == WIND.tolist()


@pytest.mark.parametrize("key", ["linear_damping", "angular_damping"])
def test_damping_that_drives_is_refused(key: str) -> None:
    """As in files, where words of Python stand for them."""
    with pytest.raises(DeclarationError) as caught:
        Simulation().add(body={"mass": 1.0, key: -2.0})
    assert str(caught.value) == f"body.{key}: must be finite and at least 0 1/s, received -2"


@pytest.mark.parametrize("scale", [0.0, 0.5, -1.0, 3.0])
def test_gravity_scale(scale: float) -> None:
    """A body falls by s g t^2 / 2 to rounding, and its energy is kept: it weighs s m g."""
    simulation = Simulation(dt=DT, gravity=(0.0, -9.81, 0.0))
    body = {"mass": 2.0, "gravity_scale": scale}
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body=body, motion={"linear": START})
    other = simulation.add(body={"mass": 1.0})
    before = total_energy(simulation.world)
    assert potential_energy(simulation.world) == 0.0
    simulation.step(240)
    fallen = 0.5 * scale * 9.81
    assert simulation[ball].transform.position == pytest.approx(START - [0.0, fallen, 0.0], rel=1e-11)
    assert simulation[other].transform.position[1] == pytest.approx(-0.5 * 9.81, rel=1e-12)
    assert total_energy(simulation.world) == pytest.approx(before, rel=1e-12)


def test_a_body_spawned_piece_by_piece_falls_like_another() -> None:
    """Forces act on whoever is a body, also where nobody gave it a place for them: none is added up twice."""
    simulation = Simulation(dt=1 / 60)
    spawned = simulation.world.spawn(Transform(), Motion(), RigidBody())
    added = simulation.add(body={"mass": 1.0})
    simulation.step(60)
    assert (simulation[spawned].transform.position == simulation[added].transform.position).all()
    assert simulation[spawned].motion.linear[1] == pytest.approx(-9.81, rel=1e-12)
