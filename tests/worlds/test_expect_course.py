"""What comes about, in which order, where bodies are and by when they rest: expectations of a whole run."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import pytest
from expectations import WORLD, outcomes

from carom.worlds import WorldError, load_text

SLIDER = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/100}
run: {duration: 2 s}
entities:
  - {name: floor, collider: {plane: {}}, material: {friction: 0.5}}
  - {name: puck, collider: {box: {size: [1, 0.2, 1]}}, body: {mass: 3}, transform: {position: [0, 0.1, 0]}, motion: {linear: [5, 0, 0]}, material: {friction: 0.5}}
  - {name: stone, collider: {sphere: {radius: 0.5}}, body: {mass: 1}, transform: {position: [0, 0.5, 8]}}
  - {name: fork, body: {type: kinematic}, transform: {position: [0, 0.9, 8]}}
  - {name: tine, parent: {entity: fork, position: [3, 0, 0]}, collider: {box: {size: [2, 1, 2]}}}
expect:
  - """


@pytest.mark.parametrize(
    "expectation",
    [
        "eventually: ball.position.y < 0.06",
        "eventually: ball.position.y > 1.2762",
        "eventually: speed(b*) > 4.9 m/s",
        "order: [{enter: [gate, ball]}, {exit: [gate, ball]}, {impact: [ball, floor]}, {enter: [gate, ball], nth: 2}]",
        "bounds: {y: [-1 um, 132.7 cm], x: [-0.11, 3.11]}",
        "bounds: {y: [-1 um, 0.2001], entities: [stone]}",
        "settles_by: {time: 0, entities: [stone]}",
        "{at: 0, center_of_mass(): {is: [1, 0.884167, 0], within: 1e-6}}",
        "{at: 0.25 s, center_of_mass(ball).y: {is: 0.9696875, within: 1e-6}}",
        "{at: 0.5 s, 'center_of_mass(b*, stone).x': {is: 1, within: 1 um}}",
        "always: 0 < center_of_mass().y < 0.8842 and center_of_mass(stone).x > 2.999",
    ],
)
def test_it_holds(expectation: str) -> None:
    """What the world does is found to hold."""
    for outcome in outcomes(expectation):
        assert outcome.held, outcome


@pytest.mark.parametrize(
    ("expectation", "frame", "received"),
    [
        ("eventually: ball.position.y < 0.049", 120, "nearest ball.position.y = 0.05 m by the end of the run"),
        ("eventually: spin(b*) > 1 rad/s", 120, "nearest spin(ball) = 0 rad/s by the end of the run"),
        ("order: [{impact: [ball, floor]}, {exit: [gate, ball]}]", 51, "exit 1 of gate and ball at 0.422663 s, before impact 1 of ball and floor"),
        ("order: [{impact: [ball, floor]}, {impact: [ball, floor], nth: 2}]", 120, "no impact 2 of ball and floor by the end of the run"),
        ("order: [{impact: [ball, stone]}, {impact: [stone, ball]}]", 120, "no impact 1 of ball and stone by the end of the run"),
        ("bounds: {y: [0.1, 2]}", 0, "stone reaches y = 0 m"),
        ("bounds: {x: [-1, 3.05], entities: [ball, stone]}", 0, "stone reaches x = 3.1 m"),
        ("bounds: {y: [0.2, 2], entities: [ball]}", 55, "ball reaches y = 0.195859 m"),
        ("settles_by: 0.25 s", 30, "2.45 m/s, ball"),
        ("settles_by: 1.5 s", 120, "the run ended at frame 120, before frame 180"),
        ("{at: 0.25 s, center_of_mass(): {is: [1, 0.884167, 0], within: 1 mm}}", 30, "center_of_mass() = [1, 0.679791667, 0] m, off by 0.204"),
        ("never: center_of_mass().y < 0.8", 20, "center_of_mass().y = 0.793333333 m"),
    ],
)  # fmt: skip
def test_it_fails(expectation: str, frame: int, received: str) -> None:
    """What the world does not do fails, with the frame and the value that were first wrong."""
    (outcome,) = outcomes(expectation)
    assert (outcome.held, outcome.frame, outcome.received) == (False, frame, received)


def test_a_slider_rests_when_friction_has_taken_its_speed() -> None:
    """5 m/s over 0.5 g of 10 m/s2 is 1 s; a hundredth before it still moves."""
    for words, held in (("1.02 s", True), ("0.98 s", False), ("{time: 0.98 s, speed: 20 cm/s}", True)):
        (outcome,) = outcomes(f"settles_by: {words}", SLIDER)
        assert outcome.held is held, outcome


def test_bounds_are_those_of_all_that_a_body_carries() -> None:
    """The fork has no shape of its own; its tine reaches to 4 m."""
    assert outcomes("bounds: {x: [1.9, 4.1], entities: [fork]}", SLIDER)[0].held
    (outcome,) = outcomes("bounds: {x: [1.9, 3.9], entities: [fork]}", SLIDER)
    assert (outcome.held, outcome.frame, outcome.received) == (False, 0, "fork reaches x = 4 m")


@pytest.mark.parametrize(
    ("expectation", "message"),
    [
        ("bounds: {}", "expect.0.bounds: must state one axis at least; received none; accepted: x, y, z"),
        ("bounds: {x: [3, 1 m]}", "expect.0.bounds: x must go from low to high; received [3, 1]"),
        ("bounds: {y: [0, 1], entities: [bal]}", "expect.0.bounds: unknown entity; received 'bal'; accepted: floor, ball, gate, stone; did you mean 'ball'?"),
        ("settles_by: 3 kg", "expect.0.settles_by: must be a time; received '3 kg', which is a mass; accepted: a number in s, or one with a unit: s, ms, us, min, h, d"),
        ("settles_by: {tim: 3 s}", "expect.0.settles_by.time: is missing; accepted: from when on until the end (s)"),
        ("order: [{impact: [ball, floor]}]", "expect.0.order: must be two events or more; received 1"),
        ("order: [{impact: [ball, flor]}, {exit: [gate, ball]}]", "expect.0.order: unknown entity; received 'flor'; accepted: floor, ball, gate, stone; did you mean 'floor'?"),
        ("eventually: ball.position.y", "expect.0.eventually: compares nothing; received 'ball.position.y'; accepted: comparisons such as 'left.position.y < 0', 'speed(left) > 3 m/s', joined by and, or, not"),
        ("always: centre_of_mass(ball).x < 1", "expect.0.always: unknown function; received 'centre_of_mass(ball).x'; accepted: speed(entity), spin(entity), kinetic_energy(entity), load(entity), error(entity), distance(entity, entity), sees(entity, entity), visible(entity, camera), visible_share(entity, camera), overlap(entity, entity, camera), left_of(entity, entity, camera), above(entity, entity, camera), center_of_mass(entity, ...), count(entity, ...); did you mean 'center_of_mass'?"),
        ("always: speed(ball).x < 1", "expect.0.always: is no value of the world; received 'speed(ball).x'; accepted: <entity>.<column>, speed(entity), spin(entity), kinetic_energy(entity), load(entity), error(entity), center_of_mass(entity, ...), count(entity, ...), distance(entity, entity) or sees(entity, entity)"),
        ("always: center_of_mass(floor).x < 1", "expect.0.always: is of no body; received 'center_of_mass(floor).x'; accepted: names of entities with body"),
        ("always: center_of_mass(ball) < 1", "expect.0.always: center_of_mass(ball) has 3 components; received 'center_of_mass(ball) < 1'; accepted: one component, such as center_of_mass(ball).x"),
    ],
)  # fmt: skip
def test_faults_are_told_where_they_stand(expectation: str, message: str) -> None:
    """In whole sentences, with names that are near."""
    with pytest.raises(WorldError) as caught:
        load_text(WORLD + expectation)
    assert message in [line.partition(": ")[2] for line in str(caught.value).split("\n")]
