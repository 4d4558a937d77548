"""Expectations of who comes and goes by events: they speak of those who are there."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import pytest
from expectations import outcomes

from carom.ecs.errors import CaromError
from carom.systems.breakpoints import StoppedError
from carom.worlds import WorldError, load_text
from carom.worlds.assignment import assign
from carom.worlds.breaks import break_when

# Three hailstones come at 0.2 s and fall 1.25 m in 0.5 s; one of them, and the pebble, go at 0.6 s; a ghost would come at 9 s.
WORLD = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/100}
run: {duration: 1 s}
prefabs:
  ball: {collider: {sphere: {radius: 0.1}}, body: {mass: 1}}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: gate, collider: {box: {size: [9, 0.1, 1]}, sensor: true}, transform: {position: [0, 0.7, 0]}}
  - {name: pebble, prefab: ball, transform: {position: [-3, 0.1, 0]}}
events:
  - {at: 0.2 s, spawn: {name: hail, prefab: ball, transform: {position: [0, 1.35, 0]}, line: {count: 3, step: [1, 0, 0]}}}
  - {at: 0.6 s, despawn: [pebble, "hail[2]"]}
  - {at: 9 s, spawn: {name: ghost, prefab: ball}}
expect:
  - """
NEVER = "never asked, since ghost has not come"


@pytest.mark.parametrize(
    "expectation",
    [
        "never: hail[*].position.y < 0.0999",
        "always: speed(hail) < 5.001 and hail.position.y < 1.3501",
        "eventually: hail[0].position.y < 0.101",
        "never: pebble.position.y < 0.0999",
        "always: count(hail) < 4",
        "never: distance(hail[0], pebble) < 3",
        "eventually: count(hail) == 3",
        "{at: 0.1 s, count(hail): {is: 0, within: 0}, count(): {is: 1, within: 0}, 'count(hail, pebble)': {is: 1, within: 0}}",
        "{at: 0.3 s, count(hail): {is: 3, within: 0}, hail.position.y: {is: 1.3, within: 1e-9}, 'speed(hail[1])': {is: 1, within: 1e-9}}",
        "{at: 0.3 s, center_of_mass(hail): {is: [1, 1.3, 0], within: 1e-9}, 'distance(hail[0], hail[2])': {is: 2, within: 1e-9}}",
        "{at: 0.65 s, count(hail): {is: 2, within: 0}, center_of_mass(hail).x: {is: 0.5, within: 1e-9}, hail.position.y: {is: 0.3375, within: 1e-9}}",
        "{when: {impact: ['hail[0]', floor]}, time: {is: 0.7, within: 1e-6}, speed: {is: 5, within: 1e-6}}",
        "order: [{enter: [gate, hail]}, {exit: [gate, 'hail[2]']}, {impact: [hail, floor], nth: 2}]",
        "bounds: {y: [0, 1.46], entities: [hail]}",
        "settles_by: {time: 0.75 s, entities: [hail]}",
        "settles_by: {time: 0.75 s, entities: [pebble]}",
    ],
)
def test_it_holds_of_who_is_there(expectation: str) -> None:
    """From when they come until they go; nothing is asked of those who are not there."""
    for outcome in outcomes(expectation, WORLD):
        assert outcome.held, outcome


@pytest.mark.parametrize(
    ("expectation", "frame", "received"),
    [
        ("never: hail[*].position.y < 1.3", 31, "hail[0].position.y = 1.2895 m"),
        ("always: count(hail) == 3", 0, "count(hail) = 0 1"),
        ("eventually: hail[*].position.y < 0.5", 100, "nearest hail[2].position.y = 0.55 m by the end of the run"),
        ("{at: 0.1 s, 'hail[0].position.y': {is: 1, within: 9}}", 10, "hail[0] has not come"),
        ("{at: 0.1 s, hail.position.y: {is: 1, within: 9}}", 10, "hail[0], hail[1], hail[2] are not there"),
        ("{at: 0.7 s, 'hail[2].position.y': {is: 1, within: 9}}", 70, "hail[2] is gone"),
        ("{at: 0.7 s, pebble.position.y: {is: 1, within: 9}}", 70, "pebble is gone"),
        ("{at: 0.7 s, 'distance(hail[0], pebble)': {is: 1, within: 9}}", 70, "pebble is gone"),
        ("{at: 0.1 s, visible: 'hail[0] > 1 px'}", 10, "hail[0] has not come"),
        ("bounds: {y: [0.2, 2], entities: [hail]}", 66, "hail[0] reaches y = 0.192 m"),
        ("settles_by: {time: 0.5 s, entities: [hail]}", 50, "3 m/s, hail[0]"),
        ("never: ghost.position.y < 0", 100, NEVER),
        ("always: ghost.position.y < 0 or hail[0].position.y > 0", 100, NEVER),
        ("eventually: ghost.position.y < 0", 100, NEVER),
        ("bounds: {y: [0, 1], entities: [ghost]}", 100, NEVER),
        ("settles_by: {time: 0.5 s, entities: [ghost]}", 100, NEVER),
        ("order: [{impact: [hail, floor]}, {impact: [ghost, floor]}]", 100, "no impact 1 of ghost and floor by the end of the run"),
    ],
)  # fmt: skip
def test_it_fails_of_who_is_there_or_where_nobody_is(expectation: str, frame: int, received: str) -> None:
    """Who never came is told, so that no expectation holds because it was never asked."""
    (outcome,) = outcomes(expectation, WORLD)
    assert (outcome.held, outcome.frame, outcome.received) == (False, frame, received)


COLUMNS = "accepted: position, rotation, linear, angular, linear_acceleration, angular_acceleration, still, asleep, type, mass, inverse_mass, inertia, inverse_inertia, center_of_mass, principal_axes, freedom, gravity_scale, linear_damping, angular_damping, continuous, sleeps, friction, restitution, density, rolling_friction, spinning_friction, friction_combine, restitution_combine, number, color"
ACCEPTED = "accepted: floor, gate, pebble, hail[0], hail[1], hail[2], ghost"


@pytest.mark.parametrize(
    ("expectation", "message"),
    [
        ("never: 'hial[0].position.y < 0'", f"expect.0.never: unknown entity; received 'hial[0]'; {ACCEPTED}; did you mean 'hail[0]'?"),
        ("bounds: {y: [0, 1], entities: [goast]}", f"expect.0.bounds: unknown entity; received 'goast'; {ACCEPTED}; did you mean 'ghost'?"),
        ("order: [{impact: [gost, floor]}, {impact: [hail, floor]}]", f"expect.0.order: unknown entity; received 'gost'; {ACCEPTED}; did you mean 'ghost'?"),
        ("never: ghost.radius < 0", f"expect.0.never: ghost has no such column; received 'radius'; {COLUMNS}"),
        ("never: load(ghost) > 1", f"expect.0.never: ghost has no such column; received 'break_force'; {COLUMNS}"),
        ("never: error(ghost) > 1", "expect.0.never: oracle says nothing of ghost; accepted: an entity of the section oracle"),
        ("never: count(ghost).x > 1", "expect.0.never: count has no x; received 'count(ghost).x'"),
        ("order: [{enter: [hail, pebble]}, {impact: [hail, floor]}]", "expect.0.order: is no sensor; received 'hail[0]'; accepted: a collider with sensor: true"),
        ("{when: {break: ghost}, time: {is: 1, within: 1}}", "expect.0.when: is no joint; received 'ghost'; accepted: an entity with joint"),
    ],
)  # fmt: skip
def test_only_who_can_come_is_named(expectation: str, message: str) -> None:
    """Names, columns and parts are held against what events bring, before anything runs."""
    with pytest.raises(WorldError) as caught:
        load_text(WORLD + expectation)
    assert [line.partition(": ")[2] for line in str(caught.value).split("\n")] == [message]


def test_breaks_wait_for_who_comes_and_assignments_tell_who_is_not_there() -> None:
    """A break stops at the step in which it holds of a hailstone; nothing is assigned to who is not there."""
    simulation = load_text(WORLD + "penetration: < 1 cm").simulation
    break_when(simulation, "hail[*].position.y < 1.3")
    with pytest.raises(CaromError) as caught:
        assign(simulation, "hail.linear.x = 1 m/s")
    assert str(caught.value) == (
        "assign: hail.linear.x = 1 m/s: hail[0], hail[1], hail[2] are not there; received 'hail.linear.x'; accepted: who is there"
    )
    with pytest.raises(StoppedError) as stopped:
        simulation.step(100)
    assert (stopped.value.frame, stopped.value.names) == (31, ["hail[0]"])
    assign(simulation, "hail.linear.x = 1 m/s")
    assert simulation["hail[1]"].motion.linear[0] == 1.0
