"""Smooth ways through points: passed on time, without jumps of velocity, closed, there and back, at rest."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs.column import Floats
from carom.ecs.components.path import Repeat
from carom.systems.curves import Curve

AT = np.array([0.5, 1.0, 2.5, 3.0, 4.5])
POINTS = np.random.default_rng(5).normal(size=(5, 3))
CLOSED = np.vstack([POINTS[:-1], POINTS[:1]])
EVER = {"once": (Repeat.ONCE, POINTS), "loop": (Repeat.LOOP, CLOSED), "back": (Repeat.PING_PONG, POINTS)}


def velocity(curve: Curve, time: float, step: float) -> Floats:
    """Return how fast it goes towards or, with a step below 0, from where it is at a time."""
    found: Floats = (curve.point(time + step) - curve.point(time)) / step
    return found


@pytest.mark.parametrize("name", EVER)
def test_points_are_passed_on_time_at_one_velocity(name: str) -> None:
    """Whatever follows the last: also where the path ends, turns back or begins anew."""
    repeat, points = EVER[name]
    curve = Curve(AT, points, repeat)
    for time, point in zip(AT.tolist(), points, strict=True):
        np.testing.assert_allclose(curve.point(time), point, rtol=0, atol=1e-12)
    for time in (*AT[name == "loop" :].tolist(), 6.5, 7.0, 8.5, 12.5):  # a loop sets out from rest once, at its speed
        np.testing.assert_allclose(velocity(curve, time, 1e-6), velocity(curve, time, -1e-6), rtol=0, atol=1e-4)


def test_what_follows_the_last_point() -> None:
    """It stays; it begins anew after one period; it goes back as it came."""
    once, loop, back = (Curve(AT, points, repeat) for repeat, points in EVER.values())
    for since in (0.1, 0.9, 2.2, 3.9):
        np.testing.assert_allclose(once.point(4.5 + since), POINTS[-1], rtol=0, atol=1e-15)
        assert once.point(0.5 - since).tolist() == POINTS[0].tolist()
        np.testing.assert_allclose(loop.point(4.5 + since), loop.point(0.5 + since), rtol=0, atol=1e-12)
        np.testing.assert_allclose(back.point(4.5 + since), back.point(4.5 - since), rtol=0, atol=1e-12)


def test_points_on_a_line_at_even_times_are_passed_evenly() -> None:
    """But for the ends, where it comes from rest: d of the way is s^2 (2 - s) of the first stretch."""
    curve = Curve(np.arange(5.0), np.outer(np.arange(5.0), (3.0, -1.0, 2.0)), Repeat.ONCE)
    for s in np.linspace(0.0, 1.0, 11):
        np.testing.assert_allclose(curve.point(s), s * s * (2.0 - s) * np.array((3.0, -1.0, 2.0)), rtol=0, atol=1e-12)
        np.testing.assert_allclose(curve.point(2.0 + s), (2.0 + s) * np.array((3.0, -1.0, 2.0)), rtol=0, atol=1e-12)


def test_a_loop_of_points_on_a_circle_is_nearly_one() -> None:
    """Twelve points: the middle between two is at cos(w) + sin(w) sin(2 w) / 4, w half of their angle."""
    angle = np.arange(13) * (2.0 * math.pi / 12.0)
    circle = np.column_stack([np.cos(angle), np.zeros(13), np.sin(angle)])
    circle[-1] = circle[0]
    curve = Curve(np.arange(13.0), circle, Repeat.LOOP)
    half = math.pi / 12.0
    for k in range(12):
        middle = float(np.linalg.norm(curve.point(k + 0.5)))
        assert middle == pytest.approx(math.cos(half) + math.sin(half) * math.sin(2.0 * half) / 4.0, abs=1e-12)


def test_it_rests_where_a_point_is_stated_twice() -> None:
    """It stands there from the one time to the other, and does not swing beyond."""
    points = np.array([(0.0, 0.0, 0.0), (1.0, 2.0, 0.0), (1.0, 2.0, 0.0), (4.0, 0.0, 0.0)])
    curve = Curve(np.arange(4.0), points, Repeat.ONCE)
    for time in (1.0, 1.2, 1.7, 2.0):
        assert curve.point(time).tolist() == [1.0, 2.0, 0.0]
    assert max(curve.point(time)[1] for time in np.linspace(0.0, 3.0, 301)) == 2.0
