"""Why two do not touch is said in words with numbers, one reason at a time, before the first step too."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import ColliderPose, EntityError, Transform, state_hash
from carom.ecs.components.flight import Flight
from carom.systems.detection.answered import Answered
from carom.systems.detection.why import why_no_contact
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.5}}
SENSOR = "'second' is a sensor, which notes who enters and touches nobody"
BOX = {"box": {"size": (1.0, 1.0, 1.0)}}


def two(first: dict[str, Any], second: dict[str, Any], apart: float, collision: str = "auto") -> Simulation:
    """Return 'first' at the origin and 'second' so far along x, without gravity."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), collision=collision)
    simulation.layers({"shell": ["shell", "red"], "red": ["red", "shell"], "deaf": []})
    for name, x, words in (("first", 0.0, first), ("second", apart, second)):
        simulation.add(name=name, transform={"position": (x, 0.0, 0.0)}, visual=False, **words)
    return simulation


def moving(collider: dict[str, Any] = BALL, **words: Any) -> dict[str, Any]:
    """Return the words of a body of 1 kg."""
    return {"collider": collider, "body": {"mass": 1.0}, **words}


@pytest.mark.parametrize(
    ("first", "second", "apart", "told"),
    [
        (moving(), {}, 0.0, "'second' has no collider"),
        ({}, {}, 0.0, "'first' and 'second' have no collider"),
        ({"collider": BALL}, {"collider": BOX}, 0.0, "neither 'first' nor 'second' moves; give one of them a body"),
        (
            {"collider": BALL, "body": {"type": "kinematic"}},
            {"collider": BOX},
            0.0,
            "neither 'first' nor 'second' can be pushed; give one of them a dynamic body",
        ),
        (
            moving({**BALL, "layer": "shell"}),
            {"collider": BOX},
            0.0,
            "'second' is on layer 'default', which 'first' does not accept; it accepts 'shell', 'red'",
        ),
        (
            moving({**BALL, "layer": "red"}),
            {"collider": {**BOX, "layer": "deaf"}},
            0.0,
            "'first' is on layer 'red', which 'second' does not accept; it accepts nobody",
        ),
        (
            moving(),
            {"collider": {**BOX, "layer": "none"}},
            0.0,
            "'second' is on layer 'none', which meets nobody",
        ),
        (
            moving({**BALL, "sensor": True}),
            {"collider": {**BOX, "sensor": True}},
            0.0,
            "'first' and 'second' are both sensors, which do not notice each other",
        ),
        (moving(), moving(), 1.31, "their bounds are 0.31 m apart along x; they reach 6 mm within a step"),
        (
            moving(motion={"linear": (6.0, 0.0, 0.0)}),
            {"collider": BALL},
            1.31,
            "their bounds are 0.31 m apart along x; they reach 0.168 m within a step",
        ),
        (
            moving(),
            {"collider": {"plane": {"normal": (-1.0, 0.0, 0.0)}}},
            0.52,
            "their bounds are 20 mm above the plane of 'second'; they reach 3 mm within a step",
        ),
        (
            moving({**BALL, "position": (0.0, 0.75, 0.75)}),
            {"collider": BALL},
            0.0,
            "their nearest points are 60.7 mm apart, they reach 3 mm within a step",
        ),
        (
            moving(),
            moving(),
            1.003,
            "they may touch within the step: 1 point, the nearest 3 mm apart, they reach 6 mm within a step",
        ),
        (moving(), {"collider": BOX}, 0.99, "they are in contact: 1 point, deepest 10 mm"),
        (moving(BOX), {"collider": BOX}, 0.9999, "they are in contact: 4 points, deepest 0.1 mm"),
        (
            moving(),
            {"collider": {**BOX, "sensor": True}},
            2.0,
            f"{SENSOR}; their bounds are 1 m apart along x; they reach 3 mm within a step",
        ),
        (
            moving(),
            {"collider": {**BOX, "sensor": True}},
            1.002,
            f"{SENSOR}; their nearest points are 2 mm apart, they reach 3 mm within a step",
        ),
        (moving(), {"collider": {**BOX, "sensor": True}}, 0.92, f"{SENSOR}; they overlap: 1 point, deepest 80 mm"),
    ],
)
@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_the_first_reason_is_told(
    first: dict[str, Any], second: dict[str, Any], apart: float, told: str, collision: str
) -> None:
    """Whole messages, the same by kernels and by FCL."""
    simulation = two(first, second, apart, collision)
    assert why_no_contact(simulation, "first", "second") == told
    assert why_no_contact(simulation.world, "second", "first") == told


def test_one_is_not_two() -> None:
    """By handle or by name; who is not there is an error that proposes names."""
    simulation = two(moving(), moving(), 3.0)
    ball = simulation.world.find("first")
    assert why_no_contact(simulation, ball, "first") == "'first' is one entity; contacts are of two"
    with pytest.raises(EntityError, match=r"^no entity is named 'fist'; did you mean 'first'\?$"):
        why_no_contact(simulation, "fist", "second")


def test_who_is_nowhere_is_named() -> None:
    """A position that is no number, and a velocity without bounds."""
    simulation = two(moving(), moving(motion={"linear": (1e308, 0.0, 0.0)}), 3.0)
    told = "'second' has no end of its bounds: its velocity is not finite, or too large"
    assert why_no_contact(simulation, "first", "second") == told
    with simulation.world.edit(Transform) as transform:
        transform.position[0, 1] = np.nan
    told = "'first' is nowhere: its position is [0.0, nan, 0.0] m"
    assert why_no_contact(simulation, "first", "second") == told


def test_asking_changes_nothing() -> None:
    """Neither state, nor what the last step left behind, nor the counts of the run."""
    simulation = two(moving(motion={"linear": (1.0, 0.0, 0.0)}), moving(), 1.05)
    simulation.step()
    world = simulation.world
    before = (
        state_hash(world),
        world[ColliderPose].upper.copy(),
        world[Flight].reach.copy(),
        vars(world[Answered]).copy(),
    )
    why_no_contact(simulation, "first", "second")
    assert state_hash(world) == before[0]
    assert np.array_equal(world[ColliderPose].upper, before[1]) and np.array_equal(world[Flight].reach, before[2])
    assert vars(world[Answered]) == before[3]


def test_asking_leaves_the_carried_where_they_are() -> None:
    """Who is carried is looked at where it will be, and stays where it is."""
    simulation = two({"collider": BOX}, moving(), 3.0)
    carrier = simulation.add(name="carrier", transform={"position": (0.0, 0.0, 0.0)})
    simulation.add(name="lamp", collider=BOX, parent={"entity": carrier}, visual=False)
    with simulation.world.edit(Transform) as transform:
        transform.position[simulation.world.row(carrier)] = (3.0, 0.5, 0.0)
    before = simulation.world[Transform].position.copy()
    assert why_no_contact(simulation, "second", "lamp") == "they are in contact: 1 point, deepest 0.5 m"
    assert np.array_equal(simulation.world[Transform].position, before)
