"""The numbers of the library world `dominoes` are those of a row of dominoes with one freedom."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.worlds import load_world

HEIGHT, THICK, SPACE = 0.6, 0.1, 0.2
PITCH, WEIGHT, PUSH = THICK + SPACE, 9.81, 2.0
INERTIA = (HEIGHT**2 + THICK**2) / 3.0  # about the lower edge, of 1 kg
CONTACT = math.asin(SPACE / HEIGHT)
INTERVALS = 2000


def row(head: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the tilts of ``count`` dominoes from the foremost back, and how fast each tilts for 1 of the foremost."""
    tilts, shares = [head], [1.0]
    for _ in range(count - 1):
        next_one = tilts[-1]
        lean = math.asin((PITCH * math.cos(next_one) - THICK) / HEIGHT)
        tilts.append(next_one + lean)
        shares.append(shares[-1] * (1.0 - PITCH * math.sin(next_one) / (HEIGHT * math.cos(lean))))
    return np.array(tilts), np.array(shares)


def rate(head: float, count: int, energy: float) -> float:
    """Return how fast the foremost tilts (rad/s) where the row has this energy (J/kg)."""
    tilts, shares = row(head, count)
    height = (HEIGHT * np.cos(tilts) + THICK * np.sin(tilts)).sum() / 2.0
    return math.sqrt(2.0 * (energy - WEIGHT * height) / (INERTIA * (shares**2).sum()))


def blows(count: int) -> list[tuple[float, float]]:
    """Return time and closing speed at which each domino strikes the next, by the midpoint rule over the tilt."""
    found: list[tuple[float, float]] = []
    time, turning = 0.0, PUSH
    for length in range(1, count):
        tilts, shares = row(0.0, length)
        height = (HEIGHT * np.cos(tilts) + THICK * np.sin(tilts)).sum() / 2.0
        energy = INERTIA * (shares**2).sum() * turning**2 / 2.0 + WEIGHT * height
        part = CONTACT / INTERVALS
        time += sum(part / rate((number + 0.5) * part, length, energy) for number in range(INTERVALS))
        before = rate(CONTACT, length, energy)
        found.append((time, before * HEIGHT * math.cos(CONTACT)))
        handed = (row(CONTACT, length)[1] ** 2).sum() * before
        _, after = row(0.0, length + 1)
        turning = handed * after[1] / (after**2).sum()
    return found


def test_times_and_speeds_are_those_of_one_freedom() -> None:
    """To the last digit of the file, blow by blow."""
    predicted = blows(16)
    names = ["first", *(f"domino[{number},0,0]" for number in range(15))]
    stated: list[Any] = [item for item in load_world("dominoes").document["expect"] if "when" in item]
    assert len(stated) == 8
    for item in stated:
        one, other = item["when"]["impact"]
        assert names.index(other) == names.index(one) + 1
        time, speed = predicted[names.index(one)]
        assert item["time"]["is"] == pytest.approx(time, abs=1e-5)
        if "speed" in item:
            assert item["speed"]["is"] == pytest.approx(speed, abs=1e-5)


def test_a_long_row_leans_at_one_angle() -> None:
    """Behind one that lies, tilts tend to where each is like the next; the file has the height of the centres there."""
    tilts, _ = row(math.pi / 2.0, 40)
    assert PITCH * math.cos(tilts[-1]) == pytest.approx(THICK, abs=1e-9)
    assert (HEIGHT * math.cos(tilts[-1]) + THICK * math.sin(tilts[-1])) / 2.0 == pytest.approx(0.14714, abs=1e-5)
