"""Expectations ask joints where they are, how loaded they are, and when they break."""

from __future__ import annotations

import pytest
from lessons import run

from carom.worlds import WorldError, load_text
from carom.worlds.expect import Outcome

# A weight of 10 N on a rope that bears 15 N, which falls asleep in the run; a wheel and a cart that motors speed up.
FILE = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/240}
run: {duration: 1 s}
entities:
  - {name: weight, body: {mass: 1}, transform: {position: [0, -1, 0]}}
  - {name: rope, joint: {rope: {b: weight, anchor_a: [0, 0, 0], break_force: 15 N}}}
  - {name: wheel, body: {mass: 1, inertia: [1, 1, 1], gravity_scale: 0}, transform: {position: [3, 0, 0]}}
  - {name: axle, joint: {hinge: {b: wheel, at: [3, 0, 0], axis: [0, 0, 1], motor: {speed: 2, most: 4 N m}}}}
  - {name: cart, body: {mass: 2, gravity_scale: 0}, transform: {position: [6, 0, 0]}}
  - {name: rail, joint: {slider: {b: cart, at: [6, 0, 0], axis: [1, 0, 0], motor: {speed: 1 m/s, most: 4 N}}}}
expect:
"""


def outcomes(*expect: str, text: str = FILE) -> list[Outcome]:
    """Return what becomes of expectations in a second."""
    return run(load_text(text + "".join(f"  - {item}\n" for item in expect)))


def test_where_it_is_and_how_loaded() -> None:
    """Angle, distance, length and load have their words; every way of a column has its name, in its own unit."""
    told = outcomes(
        "{at: 0 s, rope.length: {is: 1 m, within: 0}}",
        "{at: 1 s, rope.length: {is: 1 m, within: 0.1 mm}, load(rope): {is: 10 N, within: 0.1 %}}",
        # 4 N m speed up 1 kg m2 to 2 rad/s in 0.5 s, 4 N speed up 2 kg to 1 m/s in 0.5 s.
        "{at: 0.5 s, axle.angle: {is: 0.5 rad, within: 5 mrad}, axle.velocity.rotation_x: {is: 2, within: 1e-3}}",
        "{at: 0.25 s, axle.effort.rotation_x: {is: 4 N m, within: 1 mN m}, rail.effort.x: {is: 4 N, within: 1 mN}}",
        "{at: 1 s, rail.distance: {is: 75 cm, within: 3 mm}, axle.position.rotation_x: {is: 1.5 rad, within: 5 mrad}}",
        "{at: 1 s, rope.force: {is: [0, 10, 0], within: 10 mN}}",
        "{always: load(rope) < 15 N and rail.distance <= 0.76 m and rope.limit.x >= 0}",
    )
    assert [outcome.text for outcome in told if not outcome.held] == []


def test_breaking_is_an_event() -> None:
    """A rope of 9 N breaks under 10 N in the first step, and tells with which force; one of 15 N does not."""
    item = "{when: {break: rope}, time: {is: 1/240 s, within: 1e-9}, force: {is: 10 N, within: 1 %}}"
    assert all(outcome.held for outcome in outcomes(item, text=FILE.replace("15 N", "9 N")))
    whole = outcomes(item)
    assert [outcome.received for outcome in whole] == ["0 of 1 such events by the end of the run"] * 2


@pytest.mark.parametrize(
    ("item", "fault"),
    [
        ("{always: axle.swing < 1}", "received 'swing'; accepted: angle, distance, second_angle, a, b, "),
        ("{always: rope.angle < 1}", "rope has no such column; received 'angle'; accepted: length, a, b, anchor_a, "),
        (
            "{always: axle.position < 1}",
            "has a value for each way; received 'axle.position'; accepted: x, y, z, rotation_x, rotation_y, rotation_z",
        ),
        ("{always: axle.force.w < 1}", "force has no w; received 'axle.force.w'; accepted: x, y, z"),
        ("{always: load(wheel) < 1}", "wheel has no such column; received 'break_force'; accepted: "),
        ("{at: 1, axle.angle: {is: 3 m, within: 1}}", "must be an angle; received '3 m', which is a length"),
        ("{when: {break: wheel}, time: {is: 1, within: 1}}", "received 'wheel'; accepted: an entity with joint"),
        ("{when: {break: axel}, time: {is: 1, within: 1}}", "unknown entity; received 'axel'"),
    ],
)  # fmt: skip
def test_faults(item: str, fault: str) -> None:
    """Words of another kind of joint are refused with those it has."""
    with pytest.raises(WorldError) as caught:
        load_text(FILE + f"  - {item}\n")
    assert fault in str(caught.value)
