"""What is expected of nothing that is there is refused in whole sentences."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import pytest
from refusals import messages


@pytest.mark.parametrize(
    ("expectation", "message"),
    [
        (
            "{at: 1 s, bal.position: {is: [0, 0, 0], within: 1}}",
            "bal.position: unknown entity; received 'bal'; accepted: ball, floor; did you mean 'ball'?",
        ),
        (
            "{at: 1 s, floor.linear: {is: [0, 0, 0], within: 1}}",
            ("floor.linear: floor has no such column; received 'linear'; accepted: position, rotation, friction, restitution, "
            "density, rolling_friction, spinning_friction, friction_combine, restitution_combine, number, color"),
        ),
        ("{never: bal.position.y < 0}", "never: unknown entity; received 'bal'; accepted: ball, floor; did you mean 'ball'?"),
        (
            "{when: {impact: [ball, flor]}, time: {is: 1, within: 1}}",
            "when: unknown entity; received 'flor'; accepted: ball, floor; did you mean 'floor'?",
        ),
        (
            "{when: {impact: [ball, floor], exit: [floor, ball]}, time: {is: 1, within: 1}}",
            "when: must state one event; received impact and exit; accepted: impact, enter, exit, break",
        ),
        (
            "{when: {enter: [floor, ball]}, time: {is: 1, within: 1}}",
            "when: is no sensor; received 'floor'; accepted: a collider with sensor: true",
        ),
        (
            "{when: {impact: [ball, floor]}, tim: {is: 1, within: 1}}",
            ("tim: is nothing the event tells; received 'tim'; accepted: time, point, normal, speed, impulse, work, "
            "friction_impulse or <entity>.<column>; did you mean 'time'?"),
        ),
        (
            "{always: speed(ball) < 3 kg}",
            ("always: must be a speed; received '3 kg', which is a mass; "
            "accepted: a number in m/s, or one with a unit: m/s, mph, kn, km/h, ft/s"),
        ),
        (
            "{always: ball.position < 1}",
            ("always: ball.position has 3 components; received 'ball.position < 1'; "
            "accepted: one component, such as ball.position.x"),
        ),
        (
            "{always: __import__('os')}",
            ("always: unknown function; received \"__import__('os')\"; accepted: speed(entity), spin(entity), "
            "kinetic_energy(entity), load(entity), error(entity), distance(entity, entity), sees(entity, entity), visible(entity, camera), "
            "visible_share(entity, camera), overlap(entity, entity, camera), left_of(entity, entity, camera), "
            "above(entity, entity, camera), center_of_mass(entity, ...), count(entity, ...)"),
        ),
        (
            "{always: ball.position.y + 1 > 0}",
            ("always: is no condition at '+ 1 > 0'; received 'ball.position.y + 1 > 0'; accepted: comparisons such as "
            "'left.position.y < 0', 'speed(left) > 3 m/s', joined by and, or, not"),
        ),
        (
            "{always: ball.position.y => 1}",
            ("always: is no condition at '=> 1'; received 'ball.position.y => 1'; accepted: comparisons such as "
            "'left.position.y < 0', 'speed(left) > 3 m/s', joined by and, or, not; did you mean '>='?"),
        ),
        (
            "{always: ball.position.y = 1}",
            ("always: is no condition at '= 1'; received 'ball.position.y = 1'; accepted: comparisons such as "
            "'left.position.y < 0', 'speed(left) > 3 m/s', joined by and, or, not; did you mean '=='?"),
        ),
        ("{energy: falling}", "energy: is no law of energy; received 'falling'; accepted: constant within X or non-increasing"),
        ("{penetration: 1 mm}", "penetration: is no bound; received '1 mm'; accepted: '< 1 mm'"),
        (
            "{at: 0.123 s, ball.position: {is: [0, 0, 0], within: 1}}",
            "at: is between two steps; received 0.123 s; accepted: a multiple of dt = 0.0166666667 s, such as 0.116666667 s",
        ),
        (
            "{at: 0, ball.position: {is: 3, within: 1}}",
            "ball.position: 'is' must be a list of 3 numbers; received 3; accepted: numbers in m",
        ),
        (
            "{visible: ball}",
            ("visible: tells nothing visible; received 'ball'; accepted: 'crate >= 400 px from main', or a share such as "
            "'crate > 50 % from main'"),
        ),
        (
            "{visible: bal > 3 px from main}",
            ("visible: unknown entity; received 'bal'; accepted: ball, floor; did you mean 'ball'?"),
        ),
        (
            "{visible: ball > 3 px from main}",
            ("visible: unknown camera; received 'main'; accepted: none is defined"),
        ),
        (
            "{visible: ball > 3 m}",
            ("visible: must be a number of pixels; received '3 m', which is a length; "
            "accepted: a number in px, or one with a unit: px"),
        ),
        (
            "{}",
            (": must state a law, or a moment with values; received none; accepted: energy, momentum, angular_momentum, "
            "penetration, bounds, never, always, eventually, settles_by, order, visible; or at or when, with values such as ball.position: {is, within}"),
        ),
    ],
)  # fmt: skip
def test_an_expectation_that_names_nothing_is_refused(expectation: str, message: str) -> None:
    """Entities, columns, sensors, functions and laws that are not there are faults of the file."""
    world = "entities:\n  - {name: ball, body: {mass: 1}, collider: {point: {}}}\n  - {name: floor, collider: {plane: {}}}\n"
    (line,) = messages(world + f"expect:\n  - {expectation}\n")
    place, _, rest = line.partition(": expect.0")
    assert place.startswith("w.yaml:6:")
    assert rest.removeprefix(".") == message
