"""The numbers of the world `glider` are those of its formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs.column import Floats
from carom.worlds import load_world

WING = 0.5 * 1.225 * 0.1  # 1/2 rho A, kg/m
SLOPE = math.atan(0.1)
TRIM = math.sqrt(9.81 * math.cos(SLOPE) / WING)


def rate(state: Floats) -> Floats:
    """Return the change per second of height, way, and speeds up and ahead, of 1 kg under weight, lift and drag."""
    _, _, up, ahead = state
    pull = WING * math.hypot(up, ahead)
    return np.array([up, ahead, pull * ahead - 0.1 * pull * up - 9.81, -pull * up - 0.1 * pull * ahead])


def after(time: float, speed: float) -> Floats:
    """Return height, way and speeds after a time (s) from 30 m on down the slope, by Runge and Kutta's fourth order."""
    state, h = np.array([30.0, 0.0, -speed * math.sin(SLOPE), speed * math.cos(SLOPE)]), 1 / 240
    for _ in range(round(time / h)):
        first = rate(state)
        second = rate(state + h / 2.0 * first)
        third = rate(state + h / 2.0 * second)
        state = state + h / 6.0 * (first + 2.0 * second + 2.0 * third + rate(state + h * third))
    return state


def test_the_gliders_fly_as_integrated() -> None:
    """Places to 1 mm; the trim is that of the comment, and begins so."""
    world = load_world("glider")
    assert (math.degrees(SLOPE), TRIM) == pytest.approx((5.7106, 12.6241), abs=1e-4)
    begun = world.simulation["steady"].motion.linear
    assert begun == pytest.approx([0.0, -TRIM * math.sin(SLOPE), -TRIM * math.cos(SLOPE)], abs=1e-5)
    told = 0
    for item in world.document["expect"]:
        for name, speed in (("steady", TRIM), ("fast", 16.0)):
            if f"{name}.position" in item:
                height, way, _, _ = after(float(item["at"].removesuffix(" s")), speed)
                _, y, z = item[f"{name}.position"]["is"]
                assert (y, z) == pytest.approx((height, -way), abs=1e-3)
                told += 1
    assert told == 3


def test_small_departures_swing_as_the_formula_says() -> None:
    """They are 1 % of the speed: w^2 = 2 n^2 - d^2 / 4, by which 2 pi / w = 5.75 s, and fall off by 3 d / 2."""
    n, d = 9.81 * math.cos(SLOPE) / TRIM, 9.81 * math.sin(SLOPE) / TRIM
    period, fall = 2.0 * math.pi / math.sqrt(2.0 * n * n - d * d / 4.0), math.exp(-1.5 * d * 5.75)
    assert (n, d, period) == pytest.approx((0.7732, 0.0773, 5.75), abs=5e-3)
    begun, over = (np.array(after(time, 1.01 * TRIM)[2:]) - after(time, TRIM)[2:] for time in (0.0, 5.75))
    assert over == pytest.approx(fall * begun, abs=0.02 * float(np.linalg.norm(begun)))
