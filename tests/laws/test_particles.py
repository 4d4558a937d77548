"""Particles against closed forms: how they fly under forces, bounce and lie."""

from __future__ import annotations

from math import exp, pi, sqrt

import numpy as np
import pytest
from sprays import emitting, positions, velocities

from carom.ecs import Force
from carom.ecs.errors import NonFiniteError
from carom.systems.energy import total_energy
from carom.systems.simulation import Simulation

G = 9.81
SINGLE = 2e-6  # relative, of a few roundings of float32


def test_linear_drag_is_exact_without_other_forces() -> None:
    """It leaves e^(-c t / m) of the speed, in any step."""
    simulation = emitting(dt=0.1, burst=3, life=100.0, speed=10.0, gravity_scale=0.0, mass=0.5)
    simulation.force("linear_drag", coefficient=1.0)
    simulation.step(20)
    assert velocities(simulation)[:, 1] == pytest.approx(10.0 * exp(-4.0), rel=10 * SINGLE)


def test_quadratic_drag_leads_to_the_terminal_speed() -> None:
    """Dv/dt = g - k v^2 from rest is v = w tanh(g t / w), w = sqrt(g / k), of second order in the step."""
    errors = []
    for dt in (1 / 60, 1 / 120):
        simulation = emitting(dt=dt, burst=3, life=100.0, mass=0.1)
        simulation.force("quadratic_drag", area=0.01, drag_coefficient=1.0, density=1.0)
        simulation.step(round(1.0 / dt))
        terminal = sqrt(G / (0.5 * 0.01 / 0.1))
        errors.append(abs(-velocities(simulation)[0, 1] - terminal * np.tanh(G / terminal)))
    assert errors[0] < 3e-4
    assert errors[1] < 0.3 * errors[0]


def test_laws_act_on_particles_as_on_bodies() -> None:
    """A particle among wells, vortices and winds goes the way of a body of its mass, as near as their steps are."""
    simulation = Simulation(dt=1 / 240, substeps=1)
    place, away = {"position": (1.0, 0.5, 0.0)}, (0.0, 0.0, 1.0)
    ball = simulation.add(body={"mass": 0.2}, transform=place, motion={"linear": (0.0, 0.0, 2.0)})
    words = {"burst": 1, "direction": away, "speed": 2.0, "life": 100.0, "mass": 0.2}
    simulation.add(name="source", emitter=words, transform=place)
    simulation.force("gravity_well", strength=3.0, radius=0.2)
    simulation.force("attraction", strength=-0.1, power=-1.0, position=(0.0, 0.0, 1.0))
    simulation.force("vortex", circulation=4.0, rise=1.0)
    simulation.force("wind", velocity=(0.5, 0.0, 0.2))
    simulation.force("linear_drag", coefficient=0.1, region={"sphere": {"radius": 0.8}})
    simulation.force("quadratic_drag", area=0.01)
    simulation.force_function(lambda world, rows: np.tile((0.0, 0.1, 0.05), (len(rows), 1)), name="lift_off")
    simulation.step(240)
    assert np.linalg.norm(simulation[ball].transform.position - np.array((1.0, 0.5, 0.0))) > 0.5
    assert positions(simulation)[0] == pytest.approx(simulation[ball].transform.position, abs=2e-4)


def test_laws_of_others_leave_particles_alone() -> None:
    """A law acts on particles where it names no entities, or their emitter; layers have none."""
    simulation = emitting(dt=1 / 60, burst=1, life=100.0, gravity_scale=0.0)
    other = simulation.add(body={"mass": 1.0})
    source = int(simulation.world.find("source"))
    simulation.force("wind", velocity=(9.0, 0.0, 0.0), entities=[int(other)])
    simulation.force("linear_drag", coefficient=1.0, layers=["default"])
    simulation.force("constant_push", force=(0.0, 0.0, 0.001), entities=[source])
    simulation.step(60)
    assert velocities(simulation)[0] == pytest.approx((0.0, 0.0, 1.0), rel=SINGLE)


@pytest.mark.parametrize("dt", [1 / 50, 1 / 240])
def test_bounces_are_exact_in_gravity(dt: float) -> None:
    """Dropped from 1 m with restitution 0.8 it bounces at sqrt(2 h / g) and 2 e of that later, in any step."""
    simulation = emitting(dt=dt, burst=1, life=100.0, height=1.0, floor={"restitution": 0.8, "friction": 0.0})
    fall = sqrt(2.0 / G)
    simulation.step(round(0.9 / dt))
    age = simulation.time - fall
    assert 0.0 < age < 1.6 * fall
    assert positions(simulation)[0, 1] == pytest.approx(0.8 * G * fall * age - 0.5 * G * age**2, abs=2e-6)


def test_friction_stops_what_slides() -> None:
    """At 2 m/s on friction 0.5, x = v^2 / 2 mu g in v / mu g; there it stays."""
    simulation = Simulation(dt=1 / 60)
    rough = {"friction": 0.5}
    simulation.add(collider={"plane": {}}, material=rough)
    words = {"burst": 1, "direction": (1.0, 0.0, 0.0), "speed": 2.0, "life": 100.0}
    simulation.add(name="source", emitter=words, material=rough)
    simulation.step(60)
    assert positions(simulation)[0] == pytest.approx((4.0 / (2.0 * 0.5 * G), 0.0, 0.0), abs=2e-3)
    assert velocities(simulation)[0] == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_sand_lies_on_a_slope_that_friction_holds() -> None:
    """On 20 degrees friction 0.5 holds, and on 0.3 it slides at g (sin - mu cos)."""
    angle = pi / 9
    for friction, pull in ((0.5, 0.0), (0.3, G * (np.sin(angle) - 0.3 * np.cos(angle)))):
        simulation = Simulation(dt=1 / 60)
        surface = {"friction": friction}
        simulation.add(collider={"plane": {"normal": (np.sin(angle), np.cos(angle), 0.0)}}, material=surface)
        simulation.add(name="source", emitter={"burst": 20, "life": 100.0}, material=surface)
        simulation.step(60)
        assert np.linalg.norm(positions(simulation), axis=1) == pytest.approx(0.5 * pull, abs=1e-5)


def test_colliders_are_in_the_way_of_those_that_ask() -> None:
    """Dust falls onto a box that is carried up, and through it where it bounces off planes only."""
    for collide, rest in (("all", 1.0), ("planes", 0.0)):
        simulation = Simulation(dt=1 / 120)
        simulation.add(collider={"plane": {}}, material={"restitution": 0.0, "friction": 1.0})
        simulation.add(collider={"box": {"size": (4.0, 1.0, 4.0)}}, transform={"position": (0.0, 0.5, 0.0)})
        words = {"burst": 200, "source": {"box": {"size": (2.0, 1.0, 2.0)}}, "life": 100.0, "collide": collide}
        simulation.add(name="source", emitter=words, transform={"position": (0.0, 2.0, 0.0)})
        simulation.step(150)
        assert positions(simulation)[:, 1] == pytest.approx(rest, abs=3e-3)


def test_a_law_that_gives_no_number_is_stopped() -> None:
    """The first NaN ends the step, and is told with the emitter whose particle it is."""
    simulation = emitting(dt=1 / 60, burst=11, life=100.0)
    simulation.force_function(lambda world, rows: np.where(rows[:, None] == 10, np.nan, 0.0), name="broken")
    with pytest.raises(NonFiniteError) as told:
        simulation.step()
    assert str(told.value) == "frame 1: Particle.x of entity 'source' is nan, after 'move_particles'"


def test_a_law_that_names_an_emitter_leaves_bodies_alone() -> None:
    """Neither has the emitter forces on itself, nor is it counted in the energy of who attracts."""
    simulation = emitting(dt=1 / 60, burst=5, life=100.0)
    source = int(simulation.world.find("source"))
    simulation.force("attraction", strength=0.01, power=0.0, position=(99.0, 0.0, 0.0), entities=[source])
    simulation.force("wind", velocity=(1.0, 0.0, 0.0), entities=[source])
    simulation.add(body={"mass": 1.0, "gravity_scale": 0.0}, transform={"position": (3.0, 0.0, 0.0)})
    simulation.step(10)
    assert (velocities(simulation)[:, 0] > 1.0).all()
    assert not simulation.world[Force].medium.any()
    assert total_energy(simulation.world) == 0.0


def test_gusts_are_the_same_for_particles_and_bodies() -> None:
    """Of the same wind, also where others are listed before it: a particle goes where a body of its mass goes."""
    simulation = Simulation(dt=1 / 240, substeps=1, gravity=(0.0, 0.0, 0.0), seed=5)
    ball = simulation.add(body={"mass": 0.2})
    other = simulation.add(body={"mass": 0.2}, transform={"position": (9.0, 0.0, 0.0)})
    simulation.add(name="source", emitter={"burst": 1, "life": 100.0, "mass": 0.2})
    simulation.force("wind", velocity=(9.0, 0.0, 0.0), gust=3.0, entities=[int(other)])
    simulation.force("wind", velocity=(0.0, 0.0, 1.0), gust=2.0, gust_time=0.2)
    simulation.force("linear_drag", coefficient=1.0)
    simulation.step(240)
    still = np.array((0.0, 0.0, 1.0 - 0.2))  # m / c behind the wind
    assert np.linalg.norm(simulation[ball].transform.position - still) > 0.05
    assert positions(simulation)[0] == pytest.approx(simulation[ball].transform.position, abs=1e-5)
