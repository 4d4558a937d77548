"""Assignments change columns and settings of a world in mid-run, in the units that are stated, or are refused whole."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Material, Motion, state_hash
from carom.ecs.errors import CaromError
from carom.worlds import load_text
from carom.worlds.assignment import assign
from carom.worlds.builder import LoadedWorld

WORLD = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/100}
entities:
  - {name: crate, collider: {box: {size: [1, 1, 1]}}, body: {mass: 2}, transform: {position: [0, 5, 0]}, motion: {linear: [1, 2, 3]}}
  - {name: rain, collider: {sphere: {radius: 0.1}}, body: {mass: 1}, grid: {count: [3, 1, 1], spacing: 1, origin: [9, 0, 0]}}
  - {name: wall, collider: {box: {size: [1, 1, 1]}}, transform: {position: [-9, 0, 0]}}
"""


@pytest.fixture
def loaded() -> LoadedWorld:
    """Return a world after 100 steps."""
    made = load_text(WORLD)
    made.simulation.step(100)
    return made


@pytest.mark.parametrize(
    ("text", "what", "value"),
    [
        ("crate.material.friction *= 0.5", "crate.material.friction", 0.25),
        ("crate.linear = [0, 3.6 km/h, crate.linear.x * 2]", "crate.motion.linear", [0, 1, 2]),
        ("crate.motion.linear.z -= 1 m/s", "crate.motion.linear", [1, -8, 2]),
        ("crate.linear /= -2", "crate.motion.linear", [-0.5, 4, -1.5]),
        ("wall.position += [0, 50 cm, 0]", "wall.transform.position", [-9, 0.5, 0]),
        ("crate.rotation = [0, 0, 3, 4]", "crate.transform.rotation", [0, 0, 0.6, 0.8]),
        ("crate.position.y = wall.position.x + 1 m", "crate.transform.position.1", -8),
    ],
)
def test_columns_are_changed_where_stated(loaded: LoadedWorld, text: str, what: str, value: object) -> None:
    """One component, a whole vector, or each; a rotation is one again."""
    assign(loaded.simulation, text)
    name, kind, column, *axis = what.split(".")
    found = getattr(getattr(loaded.simulation[name], kind), column)
    assert np.allclose(found[int(axis[0])] if axis else found, value, rtol=1e-12, atol=1e-12)


def test_a_pattern_means_each_and_nobody_else(loaded: LoadedWorld) -> None:
    """Drops have the speed and friction that are stated, the crate its own."""
    world = loaded.simulation.world
    assign(loaded.simulation, "rain[*].linear.y = 7")
    assign(loaded.simulation, "rain[*].restitution = 1")
    rows = world.row_numbers(Motion)
    assert world[Motion].linear[rows, 1].tolist() == [-8, 7, 7, 7] or np.isclose(world[Motion].linear[rows[0], 1], -8)
    assert world[Material].restitution[rows].tolist() == [0, 1, 1, 1]


def test_a_heavier_body_is_harder_to_turn(loaded: LoadedWorld) -> None:
    """Its moments of inertia and both inverses are those of the same shape with three times the density."""
    body = loaded.simulation["crate"].rigid_body
    before = body.inertia.copy()
    assign(loaded.simulation, "crate.mass *= 3")
    assert body.mass == 6 and body.inverse_mass == pytest.approx(1 / 6)
    assert np.allclose(body.inertia, 3 * before) and np.allclose(body.inverse_inertia, 1 / (3 * before))


def test_settings_go_on_at_the_same_time(loaded: LoadedWorld) -> None:
    """A new gravity acts at once, g t of it; of a new dt the frames are counted anew, so that the time stays."""
    simulation = loaded.simulation
    assign(simulation, "gravity.y *= 0.5")
    assert simulation.settings.gravity == (0, -5, 0)
    assign(simulation, "gravity = [0, 0, gravity.y * 2]")
    assert simulation.settings.gravity == (0, 0, -10)
    before = simulation["crate"].motion.linear.copy()
    simulation.step(50)
    assert np.allclose(simulation["crate"].motion.linear - before, [0, 0, -5])
    assign(simulation, "dt = 5 ms")
    assert (simulation.frame, simulation.time, simulation.settings.dt) == (300, 1.5, 0.005)
    assign(simulation, "substeps *= 2")
    assign(simulation, "integrator = euler")
    assert (simulation.settings.substeps, simulation.settings.integrator) == (8, "euler")
    simulation.step(2)
    assert simulation.time == 1.51


MESSAGES = {
    "crate.friction": "--set: crate.friction: is no assignment; accepted: 'crate.material.friction *= 0.5', 'rain[*].linear.y = 3 m/s', 'gravity.y = -1.62' and the like",
    "crate.frction = 1": "--set: crate.frction = 1: crate has no such column; received 'frction'; accepted: position, rotation, linear, angular, linear_acceleration, angular_acceleration, still, asleep, type, mass, inverse_mass, inertia, inverse_inertia, center_of_mass, principal_axes, freedom, gravity_scale, linear_damping, angular_damping, continuous, sleeps, friction, restitution, density, rolling_friction, spinning_friction, friction_combine, restitution_combine, number, color; did you mean 'friction'?",
    "crat.friction = 1": "--set: crat.friction = 1: unknown entity; received 'crat'; accepted: crate, rain[0,0,0], rain[1,0,0], rain[2,0,0], wall; did you mean 'crate'?",
    "crate.linear.w = 1": "--set: crate.linear.w = 1: linear has no w; received 'crate.linear.w'; accepted: x, y, z",
    "crate.linear = 1": "--set: crate.linear = 1: takes as many numbers as it has components; accepted: a list of 3 numbers",
    "crate.linear = [1, 2]": "--set: crate.linear = [1, 2]: takes as many numbers as it has components; accepted: a list of 3 numbers",
    "crate.linear.x = 3 kg": "--set: crate.linear.x = 3 kg: must be a speed; received 3 kg, which is a mass; accepted: a number in m/s, or one with a unit: m/s, mph, kn, km/h, ft/s",
    "crate.linear.x *= 3 m": "--set: crate.linear.x *= 3 m: must be a number; received 3 m, which is a length; accepted: a number",
    "crate.linear.x /= 0": "--set: crate.linear.x /= 0: must be finite; received inf; accepted: a number in m/s, or one with a unit: m/s, mph, kn, km/h, ft/s",
    "crate.restitution = 2": "--set: crate.restitution = 2: must be at most 1; received 2.0",
    "crate.mass = 0": "--set: crate.mass = 0: must be above 0 kg; received 0.0",
    "crate.inverse_mass = 0": "--set: crate.inverse_mass = 0: RigidBody.inverse_mass follows from other columns; received 'crate.inverse_mass'; accepted: columns that a step does not compute anew",
    "speed(crate) = 3": "--set: speed(crate) = 3: is no column of numbers; received 'speed(crate)'; accepted: 'crate.material.friction *= 0.5', 'rain[*].linear.y = 3 m/s', 'gravity.y = -1.62' and the like",
    "crate.type = 1": "--set: crate.type = 1: is no column of numbers; received 'crate.type'; accepted: 'crate.material.friction *= 0.5', 'rain[*].linear.y = 3 m/s', 'gravity.y = -1.62' and the like",
    "crate.linear.x = rain[*].linear.x": "--set: crate.linear.x = rain[*].linear.x: is no expression at '[*].linear.x'; received 'rain[*].linear.x'; accepted: numbers with units, variables, + - * / ** ( ), pi, sqrt, abs, min, max, round, sin, cos, tan, exp",
    "crate.linear.x = import(os)": "--set: crate.linear.x = import(os): is no value of the world; received 'os'; accepted: <entity>.<column>, speed(entity), spin(entity), kinetic_energy(entity), load(entity), error(entity), center_of_mass(entity, ...), count(entity, ...), distance(entity, entity) or sees(entity, entity)",
    "dt = 0": "--set: dt = 0: must be above 0 s; received 0.0",
    "dt = 7 ms": "--set: dt = 7 ms: is between two steps; received 1 s; accepted: a multiple of dt = 0.007 s, such as 1.001 s",
    "gravity.w = 1": "--set: gravity.w = 1: gravity has no w; received 'gravity.w'; accepted: x, y, z",
    "integrator = rk4": "--set: integrator = rk4: unknown word; received 'rk4'; accepted: euler, semi_implicit, verlet",
    "integrator *= 2": "--set: integrator *= 2: computes with what is no number; accepted: = and a word",
    "substeps = 1.5": "--set: substeps = 1.5: must be a whole number; received 1.5; accepted: 1 to 1000",
    "seed = 3": "--set: seed = 3: seed is settled at the start; received 'seed'",
}


@pytest.mark.parametrize(("text", "message"), MESSAGES.items())
def test_what_cannot_be_assigned_is_refused_whole(loaded: LoadedWorld, text: str, message: str) -> None:
    """With what, received and accepted; the world and its settings stay as they were."""
    before = state_hash(loaded.simulation.world), loaded.simulation.settings, loaded.simulation.frame
    with pytest.raises(CaromError) as caught:
        assign(loaded.simulation, text, "--set")
    assert str(caught.value) == message
    assert (state_hash(loaded.simulation.world), loaded.simulation.settings, loaded.simulation.frame) == before
