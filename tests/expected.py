"""What the files of library worlds expect, and integrating their equations apart from the engine."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from carom.worlds import load_world
from carom.worlds.units import read_quantity

G = 9.81
Rate = Callable[[np.ndarray], np.ndarray]


def stated(name: str, moment: str, term: str, unit: str) -> Any:
    """Return what a library world expects of a term at a time or event, in SI."""
    for item in load_world(name).document["expect"]:
        if term in item and moment in (str(item.get("at", "")), str(item.get("when", ""))):
            value = item[term]["is"]
            return [read_quantity(v, unit) for v in value] if isinstance(value, list) else read_quantity(value, unit)
    raise AssertionError(f"{name} expects nothing of {term} at {moment}")


def stepped(rate: Rate, state: np.ndarray, h: float) -> np.ndarray:
    """Return the state after h seconds by the classical rule of Runge and Kutta."""
    a = rate(state)
    b = rate(state + h / 2 * a)
    c = rate(state + h / 2 * b)
    return state + h / 6 * (a + 2 * b + 2 * c + rate(state + h * c))
