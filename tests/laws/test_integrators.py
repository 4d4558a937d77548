"""Integrators have the order their names promise, and constant gravity is exact where it should be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import ExternalForce, Motion, RigidBody, Transform, World
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("damping", [0.0, 0.8])
@pytest.mark.parametrize(("integrator", "order"), [("euler", 1), ("semi_implicit", 1), ("verlet", 2)])
def test_the_error_of_a_spring_falls_with_the_order(integrator: str, order: int, damping: float) -> None:
    """X'' = -4 x - c x' at 2 s: halving dt divides the error by 2^order, within 0.1 of the exponent."""
    rate, frequency = damping / 2.0, math.sqrt(4.0 - damping**2 / 4.0)
    exact = math.exp(-2.0 * rate) * (math.cos(2.0 * frequency) + rate / frequency * math.sin(2.0 * frequency))
    errors = [abs(spring_after_two_seconds(dt, integrator, damping) - exact) for dt in (1 / 60, 1 / 120)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)


def spring_after_two_seconds(dt: float, integrator: str, damping: float) -> float:
    """Return x(2 s) of a unit mass on a spring of 4 N/m from x = 1, pulled by a Python force in every substep."""
    simulation = Simulation(dt=dt, substeps=1, integrator=integrator, gravity=(0.0, 0.0, 0.0))
    mass = simulation.add(body={"mass": 1.0}, transform={"position": (1.0, 0.0, 0.0)})

    def spring(world: World, rows: np.ndarray) -> np.ndarray:
        return -4.0 * world[Transform].position[rows] - damping * world[Motion].linear[rows]

    simulation.force_function(spring)
    simulation.step(round(2.0 / dt))
    return float(simulation[mass].transform.position[0])


def test_euler_falls_as_the_lecture_prints_it() -> None:
    """Explicit Euler at dt 1 under gravity 9: 0, 0, 9, 27, 54 m, exactly."""
    simulation = Simulation(dt=1.0, substeps=1, integrator="euler", gravity=(0.0, -9.0, 0.0))
    ball = simulation.add(body={"mass": 1.0})
    fallen = [0.0]
    for _ in range(4):
        simulation.step()
        fallen.append(-float(simulation[ball].transform.position[1]))
    assert fallen == [0.0, 0.0, 9.0, 27.0, 54.0]


@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 240])
def test_verlet_is_exact_in_constant_gravity(dt: float) -> None:
    """A throw follows its parabola to rounding at any dt."""
    simulation = Simulation(dt=dt)
    ball = simulation.add(body={"mass": 2.0}, motion={"linear": (3.0, 10.0, -1.0)})
    simulation.step(round(2.0 / dt))
    assert simulation[ball].transform.position == pytest.approx([6.0, 20.0 - 2.0 * 9.81, -2.0], abs=1e-11)


@pytest.mark.parametrize("dt", [1 / 60, 1 / 240])
def test_linear_drag_meets_the_closed_form(dt: float) -> None:
    """M = 1, c = 2, v0 = 10 after 2 s: velocity exact, position within the splitting's (c h)^2 / 24."""
    simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
    ball = simulation.add(body={"mass": 1.0}, motion={"linear": (10.0, 0.0, 0.0)})
    simulation.force("linear_drag", coefficient=2.0)
    simulation.step(round(2.0 / dt))
    assert simulation[ball].motion.linear[0] == pytest.approx(10.0 * math.exp(-4.0), rel=1e-12)
    bound = (2.0 * dt / 4.0) ** 2 / 24.0
    assert simulation[ball].transform.position[0] == pytest.approx(5.0 * (1.0 - math.exp(-4.0)), rel=1.01 * bound)


def test_mutual_gravitation_weighs_a_person() -> None:
    """G 6.674e-11, earth 5.972e24 kg, 6.378e6 m, 70 kg: 685.8592679 N within 1e-9, equal and opposite."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), substeps=1, integrator="semi_implicit", dt=1e-3)
    earth = simulation.add(body={"mass": 5.972e24})
    person = simulation.add(body={"mass": 70.0}, transform={"position": (6.378e6, 0.0, 0.0)})
    simulation.force("mutual_gravitation", constant=6.674e-11)
    simulation.step()
    pull = -simulation[person].motion.linear / 1e-3 * 70.0
    assert pull == pytest.approx([685.8592679, 0.0, 0.0], rel=1e-9)
    assert 5.972e24 * simulation[earth].motion.linear[0] == pytest.approx(
        70.0 * -simulation[person].motion.linear[0], rel=1e-12
    )


def test_an_off_centre_force_turns_a_free_box() -> None:
    """Omega = I^-1 (r x F) t to rounding while the box turns about one principal axis; the centre moves by F t / m."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    box = simulation.add(collider={"box": {"size": (0.4, 0.2, 0.6)}}, body={"mass": 3.0})
    lever, push, seconds = np.array([0.2, 0.0, 0.0]), np.array([0.0, 5.0, 0.0]), 0.5
    row = simulation.world.row(box)
    for _ in range(120):
        with simulation.world.edit(ExternalForce) as external:
            external.force[row] = push
            external.torque[row] = np.cross(lever, push)
        simulation.step()
    inertia = simulation.world[RigidBody].inertia[row]
    assert inertia == pytest.approx(3.0 / 12.0 * np.array([0.04 + 0.36, 0.16 + 0.36, 0.16 + 0.04]))
    assert simulation[box].motion.angular == pytest.approx(np.cross(lever, push) / inertia * seconds, abs=1e-12)
    assert simulation[box].motion.linear == pytest.approx(push * seconds / 3.0, abs=1e-12)


@pytest.mark.parametrize(
    ("seconds", "count", "last"), [(20, 4, 16.380), pytest.param(100, 22, 99.278, marks=pytest.mark.slow)]
)
def test_a_free_body_keeps_energy_and_angular_momentum(seconds: int, count: int, last: float) -> None:
    """About its middle axis a body turns over 22 times in 100 s; L is kept to rounding and energy to 1e-6.

    22 is what the exact motion does in that time, by Euler's equations solved to 1e-12, and when.
    """
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0), checked=False)
    inertia, spin = np.array([1.0, 2.0, 2.8]), np.array([0.05, 5.0, 0.02])
    body = simulation.add(body={"mass": 1.0, "inertia": inertia}, motion={"angular": spin})
    row = simulation.world.row(body)

    def momentum_and_energy() -> tuple[np.ndarray, float]:
        rotation = quaternion.matrix(simulation.world[Transform].rotation[row])
        local = rotation.T @ simulation.world[Motion].angular[row]
        return rotation @ (inertia * local), float(0.5 * (inertia * local * local).sum())

    before, energy = momentum_and_energy()
    worst_energy, worst_momentum, flips, up = 0.0, 0.0, [], True
    for _ in range(240 * seconds):
        simulation.step()
        after, now = momentum_and_energy()
        worst_energy = max(worst_energy, abs(now / energy - 1.0))
        axis = quaternion.matrix(simulation.world[Transform].rotation[row])[1, 1]
        worst_momentum = max(worst_momentum, np.abs(after - before).max() / np.linalg.norm(before))
        if (axis > 0.0) != up:
            flips.append(simulation.time)
        up = axis > 0.0
    assert worst_momentum <= 1e-9
    assert worst_energy <= 1e-6
    assert len(flips) == count
    assert flips[-1] == pytest.approx(last, abs=0.01)


@pytest.mark.parametrize("middle", [0, 1, 2])
@pytest.mark.parametrize("own", [6.5e-4, 0.5, 2.0])
def test_a_body_of_two_equal_moments_turns_exactly(own: float, middle: int) -> None:
    """Its axis goes round the angular momentum L at L / I, its spin is even: also a thin rod's, at 1.7 rad a step.

    Goldstein, Classical Mechanics, 3rd edition, section 5.6. What is left is rounding, for a rod times the ratio of its
    moments.
    """
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    inertia, spin = np.roll([own, 1.0, 1.0], middle), np.array([30.0, 100.0, -20.0])
    start = quaternion.from_axis_angle(np.array([0.36, 0.48, 0.8]), np.array(0.7))
    body = simulation.add(
        body={"mass": 1.0, "inertia": inertia}, transform={"rotation": start}, motion={"angular": spin}
    )
    axis = quaternion.rotate(start, np.roll([1.0, 0.0, 0.0], middle))
    local = quaternion.rotate(quaternion.conjugate(start), spin)
    momentum = quaternion.rotate(start, inertia * local)
    size = float(np.linalg.norm(momentum))
    for _ in range(60):
        simulation.step()
        round_momentum = quaternion.from_axis_angle(momentum / size, np.array(size * simulation.time))
        turned = simulation[body].transform.rotation
        assert quaternion.rotate(turned, np.roll([1.0, 0.0, 0.0], middle)) == pytest.approx(
            quaternion.rotate(round_momentum, axis), abs=1e-9
        )
        seen = quaternion.rotate(quaternion.conjugate(turned), simulation[body].motion.angular)
        assert (inertia * seen * seen).sum() == pytest.approx((inertia * local * local).sum(), rel=1e-10)
        assert quaternion.rotate(turned, inertia * seen) == pytest.approx(momentum, rel=1e-10, abs=1e-10 * size)


@pytest.mark.parametrize("beside", ["dynamic", "kinematic"])
def test_it_does_not_matter_which_axes_a_body_calls_its_own(beside: str) -> None:
    """A crowd whose principal axes are askew in their bodies turns, also by torques, as bodies that are turned so.

    Eight free bodies turn side by side; one that is kinematic among them lets each turn by itself.
    """
    generator = np.random.default_rng(3)
    turns, axes = (quaternion.normalise(generator.normal(size=(19, 4))) for _ in range(2))
    spins, torques = generator.normal(size=(2, 19, 3))

    def flown(rotations: np.ndarray, principal_axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
        for n, (rotation, own, spin) in enumerate(zip(rotations, principal_axes, spins, strict=True)):
            simulation.add(
                body={
                    "mass": 1.0, "inertia": (1.0, 2.0, 2.8), "principal_axes": own,
                    "type": beside if n % 8 == 3 else "dynamic",
                },
                transform={"position": (3.0 * n, 0.0, 0.0), "rotation": rotation},
                motion={"angular": 5.0 * spin},
            )  # fmt: skip
        world = simulation.world
        rows = world.rows(RigidBody)
        for _ in range(60):
            with world.edit(ExternalForce) as external:
                external.torque[rows] = torques
            simulation.step()
        return world[Transform].rotation[rows], world[Motion].angular[rows]

    turned, spinning = flown(turns, axes)
    plain, as_plain = flown(quaternion.multiply(turns, axes), np.tile((0.0, 0.0, 0.0, 1.0), (19, 1)))
    assert spinning == pytest.approx(as_plain, abs=1e-11)
    assert np.abs((quaternion.multiply(turned, axes) * plain).sum(axis=1)) == pytest.approx(1.0, abs=1e-12)
