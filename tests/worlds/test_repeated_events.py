"""Events that happen several times: when, and what those who come are called."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Transform, state_hash
from carom.ecs.errors import DeclarationError
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text, world_text
from carom.worlds.lint import lint

HEAD = """carom: 1
gravity: [0, 0, 0]
step: {dt: 1/100}
run: {duration: 1 s}
entities: [{name: ball, collider: {sphere: {radius: 0.1}}, body: {mass: 2}}]
events:
"""
RAIN = "  - {at: 0.1 s, every: 0.3 s, times: 3, spawn: {name: rain, body: {mass: 1, inertia: [1, 1, 1]}, motion: {linear: [0, 1, 0]}, line: {count: 2, step: [9, 0, 0]}, transform: {position: [5, 0, 0]}}}\n"


def test_it_is_done_as_often_as_is_said_a_time_apart() -> None:
    """Three pushes of 2 N s on 2 kg, the second and third 0.25 s later each."""
    simulation = load_text(
        f"{HEAD}  - {{at: 0.2 s, every: 0.25 s, times: 3, impulse: {{entities: [ball], linear: [2, 0, 0]}}}}\n"
    ).simulation
    speeds = []
    for _ in range(100):
        simulation.step()
        speeds.append(float(simulation["ball"].motion.linear[0]))
    assert [1 + n for n in np.nonzero(np.diff(speeds, prepend=0.0))[0].tolist()] == [21, 46, 71]
    assert speeds[-1] == 3.0


def test_who_comes_has_the_number_of_the_time() -> None:
    """Copies have it before their own; those of all times are one group, of which expectations speak as it grows."""
    expect = "expect: [{at: 0.5 s, count(rain): {is: 4, within: 0}, 'rain[1,0].position': {is: [5, 0.1, 0], within: 1e-9}}, {never: 'rain.position.y < 0'}]\n"
    loaded = load_text(HEAD + RAIN + expect)
    simulation = loaded.simulation
    simulation.observers += loaded.expectations
    simulation.step(50)
    assert simulation.world.names() == ["ball", "rain[0,0]", "rain[0,1]", "rain[1,0]", "rain[1,1]"]
    simulation.step(50)
    assert simulation.world.names()[-2:] == ["rain[2,0]", "rain[2,1]"]
    assert all(item.held and item.outcome().worst for item in loaded.expectations)


@pytest.mark.parametrize("steps", [0, 20, 60])
def test_what_is_still_to_come_is_written(steps: int) -> None:
    """A world that is written in between goes on to the same state."""
    loaded = load_text(HEAD + RAIN)
    loaded.simulation.step(steps)
    again = load_text(world_text(loaded)).simulation
    for one in (loaded.simulation, again):
        one.step(100 - steps)
    assert state_hash(again.world) == state_hash(loaded.simulation.world)


def test_python_says_it_in_the_same_words() -> None:
    """And is refused in sentences; nothing is added then."""
    simulation = Simulation(dt=0.01, gravity=(0.0, 0.0, 0.0))
    drop = {"name": "drop", "body": {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}}
    simulation.event(0.1, every=0.2, times=2, spawn=drop)
    simulation.step(40)
    assert simulation.world.names() == ["drop[0]", "drop[1]"]
    for words, message in (
        ({"every": 0.2}, "times: is missing; every and times go together"),
        ({"times": 2}, "every: is missing; every and times go together"),
        (
            {"every": 0.0, "times": 1.5},
            "every: must be finite and above 0 s, received 0; times: must be from 1 to 1000; received 1.5",
        ),
    ):
        with pytest.raises(DeclarationError) as caught:
            simulation.event(0.5, spawn=drop, **words)  # type: ignore[arg-type]
        assert str(caught.value) == message
    simulation.step(40)
    assert simulation.world.count(Transform) == 2


@pytest.mark.parametrize(
    ("event", "message"),
    [
        ("at: 0, every: 0 s, times: 2, despawn: [ball]", "w:7:13: events.0.every: must be above 0 s; received '0 s'"),
        ("at: 0, every: 1 s, times: 2000, despawn: [ball]", "w:7:25: events.0.times: must be a whole number; received 2000; accepted: 1 to 1000"),
        ("at: 0, every: 1 s, despawn: [ball]", "w:7:5: events.0.times: is missing; every and times go together"),
        ("at: 0, every: 1 s, times: 1000, spawn: {name: a, collider: {point: {}}, line: {count: 2000, step: [1, 0, 0]}}", "w:7:25: events.0.times: brings 2000000 entities, more than 1000000"),
        (f"at: 0, every: 1 s, times: 11, spawn: {{name: {45 * 'a'}, collider: {{point: {{}}}}}}", f"w:7:25: events.0.times: the name '{45 * 'a'}[10]' of who comes exceeds 48 characters"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_them_is_told(event: str, message: str) -> None:
    """Where it stands."""
    with pytest.raises(WorldError) as caught:
        load_text(f"{HEAD}  - {{{event}}}\n", "w")
    assert str(caught.value) == message


def test_check_tells_of_times_after_the_end() -> None:
    """Of the event that has them, once."""
    told = lint(load_text(f"{HEAD}{RAIN}  - {{at: 0.5 s, every: 0.2 s, times: 5, despawn: [rain]}}\n", "w"))
    assert told == ["w:8:6: events.1.at: comes after the end of the run, 1 s"]


def test_a_force_on_who_comes_is_told_to_go_by_layers() -> None:
    """Forces look for names at the start; layers are those of whoever comes."""
    with pytest.raises(WorldError) as caught:
        load_text(f"{HEAD}{RAIN}forces: [{{wind: {{velocity: [1, 0, 0]}}, entities: ['rain[1,0]', ran]}}]\n", "w")
    assert str(caught.value).split("\n") == [
        "w:8:51: forces.0.entities.0: unknown entity; received 'rain[1,0]'; accepted: ball; it comes by an event; state its layer in layers instead",
        "w:8:64: forces.0.entities.1: unknown entity; received 'ran'; accepted: ball",
    ]
