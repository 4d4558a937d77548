"""Every kind of expectation holds when the world does what it says, and fails when it does not."""

from __future__ import annotations

import numpy as np
import pytest
from expectations import WORLD, outcomes

from carom.ecs import Motion, Transform
from carom.worlds import load_text
from carom.worlds.condition import read_condition
from carom.worlds.errors import WordError


@pytest.mark.parametrize(
    "expectation",
    [
        "energy: non-increasing",
        "energy: constant within 1e-9",
        "energy: constant within 1 mJ",
        "momentum: constant within 20 kg m/s",
        "angular_momentum: constant within 100 kg m2/s",
        "penetration: < 1 mm",
        "never: ball.position.y < 49 mm",
        "always: ball.position.y > 4.9 cm and speed(ball) <= 4.9051 m/s",
        "always: not (ball.position.x > 1 mm or stone.position.x < 2.9)",
        "always: 0 < ball.position.y < 1.3",
        "always: distance(ball, stone) > 2.9",
        "never: kinetic_energy(ball) > 24.06 J",
        "never: ball.position.y > stone.position.y and spin(stone) > 1 rad/s",
        "{at: 0, ball.position: {is: [0, 127.625 cm, 0], within: 0}}",
        "{at: 0.25 s, ball.linear.y: {is: -2.4525, within: 1 um/s}}",
        "{at: 1 s, ball.transform.position.y: {is: 1.27625, within: 1e-6}, speed(ball): {is: 0, within: 1e-6}}",
        "{at: 1 s, ball.position.y: {is: 1.3, within: 5 %}}",
        "{at: 0.25 s, 'sees(stone, ball)': {is: 1, within: 0}, 'sees(floor, ball)': {is: 1, within: 0}}",
        "always: sees(ball, stone) == 1",
        "{when: {impact: [ball, floor]}, time: {is: 0.5, within: 1e-6}, point: {is: [0, 0, 0], within: 1 um}}",
        "{when: {impact: [floor, ball], nth: 1}, speed: {is: 4.905, within: 1e-6}, impulse: {is: 19.62, within: 1e-5}}",
        "{when: {enter: [gate, ball]}, time: {is: 0.371308, within: 1e-6}, ball.position.y: {is: 0.6, within: 0.1}}",
        "{when: {exit: [gate, ball]}, time: {is: 0.422663, within: 1e-6}}",
    ],
)
def test_it_holds(expectation: str) -> None:
    """What the world does is found to hold."""
    for outcome in outcomes(expectation):
        assert outcome.held, outcome
        assert outcome.frame is None


@pytest.mark.parametrize(
    ("expectation", "frame", "received"),
    [
        ("momentum: constant within 1e-6", 1, "[0, -0.1635, 0] kg m/s, 0.164 from [0, 0, 0]"),
        ("momentum: constant within 1 kg m/s", 7, "[0, -1.1445, 0] kg m/s, 1.14 from [0, 0, 0]"),
        ("never: ball.position.y < 1.27", 5, "ball.position.y = 1.26773438 m"),
        ("always: ball.position.y < 1", 0, "ball.position.y = 1.27625 m"),
        ("always: ball.position.y > 1 or spin(ball) > 1", 29, "ball.position.y = 0.989784375 m, spin(ball) = 0 rad/s"),
        ("never: speed(b*) > 1 m/s", 13, "speed(ball) = 1.06275 m/s"),
        ("{at: 0, ball.position: {is: [0, 1, 0], within: 1 mm}}", 0, "ball.position = [0, 1.27625, 0] m, off by 0.276"),
        ("{at: 0.25 s, ball.position.y: {is: 1, within: 1 mm}}", 30, "ball.position.y = 0.9696875 m, off by 0.0303"),
        ("{at: 1.5 s, ball.position.y: {is: 1, within: 1}}", 120, "the run ended at frame 120, before frame 180"),
        ("{when: {impact: [ball, floor]}, speed: {is: 5, within: 1 mm/s}}", 61, "speed = 4.905 m/s, off by 0.095"),
        ("{when: {impact: [ball, floor], nth: 2}, time: {is: 1, within: 1}}", 120, "1 of 2 such events by the end of the run"),  # noqa: E501
        ("{when: {impact: [ball, stone]}, time: {is: 1, within: 1}}", 120, "0 of 1 such events by the end of the run"),
        ("{when: {enter: [gate, stone]}, time: {is: 1, within: 1}}", 120, "0 of 1 such events by the end of the run"),
    ],
)  # fmt: skip
def test_it_fails(expectation: str, frame: int, received: str) -> None:
    """What the world does not do fails, with the frame and the value that were first wrong."""
    (outcome,) = outcomes(expectation)
    assert (outcome.held, outcome.frame, outcome.received) == (False, frame, received)
    assert outcome.time == frame / 120


def test_energy_that_grows_is_noticed() -> None:
    """A pushed body gains energy, which both laws of energy tell."""
    pushed = WORLD.replace("expect:", "forces: [{constant_push: {force: [1, 0, 0]}, entities: [ball]}]\nexpect:")
    for law in ("non-increasing", "constant within 1e-6", "constant within 1 mJ"):
        (outcome,) = outcomes(f"energy: {law}", pushed)
        assert not outcome.held
        assert outcome.expected == f"energy {law}"
    assert outcomes("energy: constant within 1 J", pushed)[0].held


def test_energy_that_falls_is_not_constant() -> None:
    """A lossy bounce breaks constancy in its frame, and is no increase."""
    dull = WORLD.replace("restitution: 1", "restitution: 0.9")
    assert outcomes("energy: non-increasing", dull)[0].held
    (outcome,) = outcomes("energy: constant within 1e-6", dull)
    assert (outcome.held, outcome.frame) == (False, 61)


def test_angular_momentum_about_the_origin_changes_under_weight() -> None:
    """Weight beside the origin turns."""
    (outcome,) = outcomes("angular_momentum: constant within 1e-6", WORLD.replace("[0, 1.27625", "[2, 1.27625"))
    assert (outcome.held, outcome.frame) == (False, 1)


def test_penetration_looks_at_contacts() -> None:
    """A stone set into the ground is seen in the first frame."""
    sunk = WORLD.replace("[3, 0.1, 0]", "[3, 0.09, 0]")
    (outcome,) = outcomes("penetration: < 1 mm", sunk)
    assert (outcome.held, outcome.frame) == (False, 1)
    assert outcome.received.endswith(" m between floor and stone")


def test_a_failure_tells_the_whole_story() -> None:
    """The line of a failure says when, what, expected, received and worst."""
    (outcome,) = outcomes("never: ball.position.y < 1")
    assert str(outcome) == (
        "failed in frame 29 at 0.241667 s: never: ball.position.y < 1; expected never ball.position.y < 1; "
        "received ball.position.y = 0.989784375 m; worst ball.position.y = 0.05 m"
    )


@pytest.mark.parametrize(
    "text",
    [
        "",
        "and",
        "ball.position.y <",
        "(ball.position.y < 1",
        "ball.position.y < 1)",
        "1 < 2",
        "ball.position.y < 1 or",
        "a = 1",
        "ball.position.y < ball.linear.y",
        "speed() < 1",
        "ball.position.w < 1",
        "ball < 1",
        "()" * 100,
        "(" * 100,
        "ball.y < 1",
    ],
)
def test_what_is_no_condition_is_refused(text: str) -> None:
    """Whatever cannot be a condition is a fault, never an exception of Python."""
    with pytest.raises(WordError):
        read_condition(text, load_text(WORLD + "energy: non-increasing").simulation.world)


def test_conditions_follow_the_rules_of_logic() -> None:
    """And binds tighter than or, not tightest; the margin is positive just where the condition holds."""
    world = load_text(WORLD + "energy: non-increasing").simulation.world
    with world.edit(Transform) as transform, world.edit(Motion) as motion:
        generator = np.random.default_rng(0)
        for _ in range(50):
            transform.position[1], motion.linear[1] = generator.normal(size=(2, 3))
            x, y, z = transform.position[1]
            for text, expected in [
                ("ball.position.x < 0 and ball.position.y < 0 or ball.position.z < 0", (x < 0 and y < 0) or z < 0),
                ("ball.position.x < 0 and (ball.position.y < 0 or ball.position.z < 0)", x < 0 and (y < 0 or z < 0)),
                ("not ball.position.x < 0 and ball.position.y >= 0", not x < 0 and y >= 0),
                ("ball.position.x > ball.position.y > ball.position.z", x > y > z),
                ("ball.position.x != 0 and not ball.position.y == 0", True),
            ]:
                verdict = read_condition(text, world).evaluate(world)
                assert bool(verdict.holds.all()) == expected
                assert (verdict.margin[0] > 0) == expected


def test_what_stands_between_two_hides_them() -> None:
    """A wall does, from both sides; a sensor does not."""
    wall = "  - {name: wall, collider: {box: {size: [0.1, 9, 9]}}, transform: {position: [1.5, 1, 0]}}\nexpect:"
    walled = WORLD.replace("expect:", wall)
    for law in ("never: sees(ball, stone) == 1", "always: sees(stone, ball) == 0", "always: sees(ball, wall) == 1"):
        (outcome,) = outcomes(law, walled)
        assert outcome.held, outcome
    (outcome,) = outcomes("never: sees(ball, stone) == 1", walled.replace("9]}}", "9]}, sensor: true}"))
    assert (outcome.held, outcome.frame, outcome.received) == (False, 0, "sees(ball, stone) = 1 1")
