"""Real time comes in frames of any length and goes out in steps, and what is drawn lies between them."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from faults import error
from hypothesis import given
from hypothesis import strategies as st

from carom.ecs import DeclarationError, Transform, restore_snapshot, take_snapshot
from carom.ecs.spatial import quaternion
from carom.systems.clock import Clock
from carom.systems.simulation import Simulation


def steps_of(frames: list[float], dt: float) -> int:
    """Return the steps that frames lead to when none is dropped."""
    clock = Clock()
    clock.catch_up = math.inf
    return sum(clock.steps(seconds, dt) for seconds in frames)


@pytest.mark.parametrize("dt", [1 / 30, 0.01, 1 / 60, 1 / 120, 0.0025, 1 / 144, 1e-3, 1 / 1000.5])
@pytest.mark.parametrize("count", [1, 2, 3, 7, 10, 30, 49, 60, 72, 100, 144, 240, 1000, 9973])
def test_a_second_is_a_second_in_any_number_of_frames(dt: float, count: int) -> None:
    """Though neither 1 / 144 nor 0.01 is a binary number, the steps in 1 s are those of the exact quotient."""
    assert steps_of([1.0 / count] * count, dt) == math.floor(1.0 / dt + 1e-9)


@given(st.lists(st.floats(0.0, 0.2), max_size=40), st.sampled_from([1 / 60, 1 / 120, 0.01]), st.randoms())
def test_the_order_of_frames_does_not_matter(frames: list[float], dt: float, random: object) -> None:
    """The steps are those of the exact sum, in any order, and what is owed is the exact rest."""
    turned = sorted(frames, key=lambda _: random.random())  # type: ignore[attr-defined]
    assert steps_of(frames, dt) == steps_of(turned, dt) == steps_of([math.fsum(frames)], dt)
    clock = Clock()
    clock.catch_up = math.inf
    steps = sum(clock.steps(seconds, dt) for seconds in frames)
    assert float(sum(map(Fraction, frames)) - steps * Fraction(dt)) == pytest.approx(clock.owed, abs=1e-17)
    assert 0.0 <= clock.part(dt) < 1.0


def test_readings_of_a_clock_are_kept_to_the_nanosecond_for_a_day() -> None:
    """A day of differences between readings in nanoseconds, 1000 a second, adds up to no step more or less."""
    generator = np.random.default_rng(1)
    differences = generator.integers(1, 2_000_000, 100_000)
    clock = Clock()
    steps = sum(clock.steps(int(difference) / 1e9, 1 / 240) for difference in differences)
    assert steps == int(differences.sum()) * 240 // 10**9


def test_a_slow_machine_falls_behind() -> None:
    """Beyond a quarter of a second a frame is not made up for; what was dropped is told, whole steps of it."""
    simulation = Simulation(dt=1 / 128)
    assert simulation.advance(1.0 + 0.25 / 128) == 0.25
    assert (simulation.frame, simulation.clock.dropped, simulation.clock.owed) == (32, 0.75, 0.25 / 128)
    assert simulation.advance(0.5 / 128) == 0.75
    assert (simulation.frame, simulation.clock.dropped) == (32, 0.75)
    simulation.clock.catch_up = 1.0
    assert simulation.advance(1.0) == 0.75
    assert (simulation.frame, simulation.clock.dropped) == (160, 0.75)


def test_a_step_longer_than_the_limit_is_still_taken() -> None:
    """One step of half a second, though a frame asks for a quarter at most."""
    simulation = Simulation(dt=0.5)
    assert simulation.advance(0.6) == pytest.approx(0.2)
    assert simulation.frame == 1
    simulation.advance(1.2)
    assert (simulation.frame, simulation.clock.dropped) == (2, 0.5)


@pytest.mark.parametrize("seconds", [-0.01, math.nan, math.inf])
def test_time_that_is_none_is_refused(seconds: float) -> None:
    """A clock that was set back shows in the first frame, and nothing is stepped."""
    simulation = Simulation()
    message = f"real time must be finite and at least 0 s, received {seconds:g} s"
    with error(DeclarationError, message):
        simulation.advance(seconds)
    assert simulation.frame == 0


def spinning() -> Simulation:
    """Return a bar that flies to the right and spins by 30 degrees a step about y, and a floor."""
    simulation = Simulation(dt=1 / 64, gravity=(0.0, 0.0, 0.0))
    simulation.add(
        collider={"box": {"size": (1.0, 1.0, 1.0)}},
        body={},
        motion={"linear": (64.0, 0.0, 0.0), "angular": (0.0, math.radians(30.0) * 64, 0.0)},
    )
    simulation.add(collider={"plane": {"offset": -9.0}})
    return simulation


@pytest.mark.parametrize("part", [0.0, 0.25, 0.5, 0.9])
@pytest.mark.parametrize("steps", [1, 4, 10, 16])
def test_what_is_drawn_lies_between_two_steps(part: float, steps: int) -> None:
    """One step behind and ``part`` of one further: on the chord, and within 0.1 degrees of the even turn."""
    simulation = spinning()
    found = simulation.advance((steps + part) / 64)
    assert found == pytest.approx(part)
    shown = simulation.between(found)
    assert shown.position[0] == pytest.approx([steps - 1 + part, 0.0, 0.0], abs=1e-12)
    turn = quaternion.from_axis_angle((0.0, 1.0, 0.0), math.radians(30.0) * (steps - 1 + part))
    assert abs(turn @ shown.rotation[0]) > math.cos(math.radians(0.1) / 2)
    assert np.linalg.norm(shown.rotation, axis=1) == pytest.approx([1.0, 1.0])
    assert shown.position[1].tolist() == [0.0, 0.0, 0.0]
    assert simulation[Transform].position[0, 0] == pytest.approx(steps)


def test_who_came_or_went_with_a_step_is_drawn_where_it_is() -> None:
    """A row that another entity has now is not drawn on a way between the two."""
    simulation = spinning()
    simulation.advance(1 / 64)
    simulation.world.despawn(simulation.world.entity(0))
    new = simulation.add(collider={"sphere": {"radius": 1.0}}, body={}, transform={"position": (7.0, 0.0, 0.0)})
    further = simulation.add(collider={"sphere": {"radius": 1.0}}, transform={"position": (8.0, 0.0, 0.0)})
    rows = simulation.world.slots.rows(np.array([new, further]))
    assert rows.tolist() == [0, 2]
    assert simulation.between(0.5).position[rows, 0].tolist() == [7.0, 8.0]


def test_between_is_the_last_step_where_no_frame_led_to_it() -> None:
    """Before the first, after a step that was taken directly, and after a snapshot was restored."""
    simulation = spinning()
    start = take_snapshot(simulation.world)
    assert simulation.between(0.5).position[0].tolist() == [0.0, 0.0, 0.0]
    simulation.advance(2 / 64)
    assert simulation.between(0.5).position[0, 0] == pytest.approx(1.5)
    simulation.step()
    assert simulation.between(0.5).position[0, 0] == pytest.approx(3.0)
    restore_snapshot(simulation.world, start)
    assert simulation.between(0.5).position[0].tolist() == [0.0, 0.0, 0.0]
