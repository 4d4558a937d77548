"""What a file would be refused for, Python is refused for too: in whole sentences, all faults at once."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from carom.ecs import Material, Visual, state_hash
from carom.ecs.errors import DeclarationError
from carom.systems.simulation import Simulation
from carom.systems.surfaces import BODY_COLOR

BALL: dict[str, Any] = {"sphere": {"radius": 1.0}}
SURFACE = "friction, restitution, density, rolling_friction, spinning_friction, color"
ENTITIES: dict[str, tuple[dict[str, Any], str]] = {
    "a section": ({"colider": BALL}, "an entity has no word 'colider'; did you mean 'collider'?"),
    "no mapping": (
        {"transform": (0.0, 1.0, 0.0)},
        "transform: must be a mapping; received (0.0, 1.0, 0.0); accepted: position, rotation",
    ),
    "words of a shape": (
        {"collider": {"sphere": {"radus": 1.0}}},
        (
            "collider.sphere.radus: unknown key; received 'radus'; accepted: radius; did you mean 'radius'?; "
            "collider.sphere.radius: is missing"
        ),
    ),
    "words of three sections": (
        {
            "collider": BALL,
            "material": {"friction": -1.0, "fricton": 0.5},
            "body": {"mass": "heavy", "sleeps": 1, "type": "dynamc"},
            "motion": {"linear": (0.0, math.nan, 0.0)},
        },
        (
            "motion.linear: must be finite, received nan; body.mass: must be a number, received 'heavy'; "
            "body.sleeps: must be true or false; received 1; "
            "body.type: unknown word; received 'dynamc'; accepted: dynamic, kinematic; "
            f"material.fricton: unknown key; received 'fricton'; accepted: {SURFACE}; did you mean 'friction'?; "
            "material.friction: must be finite and at least 0, received -1"
        ),
    ),
    "a rotation": (
        {"transform": {"rotation": (0.0, 0.0, 0.0, 2.0)}},
        "transform.rotation: must be a unit quaternion xyzw, received one of length 2",
    ),
    "what is no mapping but a flag, and a colour": (
        {"collider": True, "body": True, "visual": {"color": (5.0, 0.0, 0.0)}},
        (
            "body: must be a mapping; received True; accepted: mass, inertia, principal_axes, center_of_mass, gravity_scale, linear_damping, angular_damping, continuous, sleeps, type, locked; "
            "collider: must be a mapping; received True; accepted: box, capsule, cone, convex, cylinder, ellipsoid, mesh, height_field, plane, point, sphere, position, rotation, sensor, surface_velocity, shape, layer, collides_with, on_enter; "
            "visual.color: must be finite and at least 0 and at most 1, received 5"
        ),
    ),
    "a rule": (
        {
            "collider": BALL,
            "material": {
                "restitution": {"value": 2.0, "combin": "max"},
                "friction": {"value": 0.5, "combine": "least"},
            },
        },
        (
            "material.friction.combine: unknown word; received 'least'; accepted: average, sqrt, min, multiply, max; "
            "material.restitution.combin: unknown key; received 'combin'; accepted: value, combine; "
            "did you mean 'combine'?; material.restitution.combine: unknown word; received none; accepted: average, sqrt, min, multiply, max; "
            "material.restitution.value: must be finite and at least 0 and at most 1, received 2"
        ),
    ),
}


@pytest.mark.parametrize("what", ENTITIES)
def test_an_entity_is_refused_and_nothing_is_there(what: str) -> None:
    """Every fault is named; the world is as it was."""
    words, message = ENTITIES[what]
    simulation = Simulation()
    before = state_hash(simulation.world)
    with pytest.raises(DeclarationError) as told:
        simulation.add(name="odd", **words)
    assert str(told.value) == message
    assert state_hash(simulation.world) == before
    assert simulation.world.names() == []


def test_of_many_the_first_that_is_wrong_is_named() -> None:
    """Numbers with a row for each are looked at together."""
    simulation = Simulation()
    with pytest.raises(DeclarationError, match=r"^body.mass: must be finite and above 0 kg, received -2$"):
        simulation.add_many(np.zeros((3, 3)), collider=BALL, body={"mass": [1.0, -2.0, -3.0]})
    with pytest.raises(
        DeclarationError, match=r"^body.mass: must be a number, received \[\[1.0\], \[2.0\], \[3.0\]\]$"
    ):
        simulation.add_many(np.zeros((3, 3)), collider=BALL, body={"mass": [[1.0], [2.0], [3.0]]})
    colors = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    made = simulation.add_many(np.zeros((3, 3)), collider=BALL, body={}, visual={"color": colors})
    rows = simulation.world.slots.rows(made)
    assert simulation.world[Visual].color[rows, :3].tolist() == [list(color) for color in colors]


OTHERS: dict[str, tuple[Callable[[Simulation], Any], str]] = {
    "an unknown law": (
        lambda simulation: simulation.force("wnd", velocity=(1.0, 0.0, 0.0)),
        (
            "wnd: unknown force law; received 'wnd'; accepted: attraction, buoyancy, constant_push, linear_drag, "
            "quadratic_drag, gravity_well, lift, magnus, mutual_gravitation, thruster, vortex, wind; did you mean 'wind'?"
        ),
    ),
    "words of a law, and whom it acts on": (
        lambda simulation: simulation.force("wind", velocty=(1.0, 0.0, 0.0), during=(2.0, 1.0)),
        (
            "during: must start at 0 s or later and end after that; received (2.0, 1.0); accepted: (0.5, 2) in s, or "
            "(0.5, 'end') for good; "
            "wind.velocty: unknown key; received 'velocty'; accepted: velocity, gust, gust_time; did you mean 'velocity'?; "
            "wind.velocity: is missing; accepted: velocity of the air"
        ),
    ),
    "a named material": (
        lambda simulation: simulation.material("ice", fricton=0.1),
        f"material.fricton: unknown key; received 'fricton'; accepted: {SURFACE}; did you mean 'friction'?",
    ),
    "settings": (
        lambda _: Simulation(gravty=(0.0, -1.62, 0.0)),
        (
            "gravty: unknown key; received 'gravty'; accepted: dt, substeps, gravity, integrator, dimensions, collision, "
            "response, hit_speed, sleeping, seed, threads; did you mean 'gravity'?"
        ),
    ),
    "values of settings": (
        lambda _: Simulation(dt="1/60", gravity=(0.0, -9.81), hit_speed=0, substeps=1.5, threads=0),
        (
            "dt must be a number, received '1/60'; hit_speed must be finite and above 0 m/s, received 0; "
            "gravity must be 3 numbers, received (0.0, -9.81); substeps must be from 1 to 1000, received 1.5; "
            "threads must be from 1 to 64, received 0"
        ),
    ),
    "the time of an event": (
        lambda simulation: simulation.event("1 s", despawn=["a"]),
        "at: must be a number, received '1 s'",
    ),
    "one name where names are listed": (
        lambda simulation: simulation.event(1.0, despawn="a"),
        "despawn: must be a list of names; received 'a'; accepted: ['a']",
    ),
    "a number of steps": (lambda simulation: simulation.step(-1), "step takes 0 steps or more, received -1"),
    "a shape that is asked with": (
        lambda simulation: simulation.space.cast_shape({"sphere": {}}, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
        "sphere.radius: is missing",
    ),
}


@pytest.mark.parametrize("what", OTHERS)
def test_everything_else_is_refused_in_sentences_too(what: str) -> None:
    """Laws, materials, settings and questions."""
    ask, message = OTHERS[what]
    with pytest.raises(DeclarationError) as told:
        ask(Simulation())
    assert str(told.value) == message


def test_bodies_stand_out_where_no_colour_is_stated() -> None:
    """What is static is grey; a colour of the material, or of the looks, goes before."""
    simulation = Simulation()
    red = (1.0, 0.0, 0.0, 1.0)
    colors = [
        simulation[simulation.add(collider=BALL, **words)].visual.color.tolist()
        for words in (
            {},
            {"body": {}},
            {"body": {}, "material": {"color": red}},
            {"body": {}, "visual": {"color": red}},
        )
    ]
    assert colors == [list(Material.columns["color"].default), list(BODY_COLOR), list(red), list(red)]
