"""Laws: one body in every engine that is installed, and how far each is off the closed form."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from math import inf

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.tools.bench.law_engines import DENSITY, DT, ENGINES, State, Trial
from carom.tools.bench.measure import Figure

BOOK = np.array((1.0, 0.5, 0.1))  # edges, m


@dataclass(frozen=True)
class Law:
    """A trial, how long it takes (s), what is off then, and by how much ours may be; ``without`` cannot state it."""

    trial: Trial
    seconds: float
    off: Callable[[State, State], float]
    unit: str
    bound: float
    without: tuple[str, ...] = ()


def figures() -> Iterator[Figure]:
    """Yield what each engine is off in each law."""
    for name, law in LAWS.items():
        for engine, make in ENGINES.items():
            if engine in law.without or (engine != "carom" and find_spec(engine) is None):
                continue
            made = make(law.trial)
            before = made.state()
            for _ in range(round(law.seconds / DT)):
                made.step()
            value = law.off(before, made.state())
            yield Figure(f"{name}, {engine}", law.unit, value, value, law.bound if engine == "carom" else inf, "value")


def height(expected: float) -> Callable[[State, State], float]:
    """Return by how many mm a body is not where it should be."""
    return lambda _, end: 1e3 * abs(float(end.position[2]) - expected)


def moments() -> Floats:
    """Return those of the book, kg m2: m (b^2 + c^2) / 12 and so on."""
    squares = BOOK * BOOK
    found: Floats = DENSITY * BOOK.prod() * (squares.sum() - squares) / 12.0
    return found


def spin(state: State) -> tuple[float, Floats]:
    """Return the book's energy of turning (J) and its angular momentum (N m s), world frame."""
    turning = quaternion.rotate(quaternion.conjugate(state.rotation), state.angular)
    return float(0.5 * (moments() * turning * turning).sum()), quaternion.rotate(state.rotation, moments() * turning)


def energy_of_turning(before: State, end: State) -> float:
    """Return by how many percent the energy of turning has changed."""
    return 100.0 * abs(spin(end)[0] / spin(before)[0] - 1.0)


def angular_momentum(before: State, end: State) -> float:
    """Return by how many percent angular momentum is another one, its direction too."""
    first = spin(before)[1]
    return 100.0 * float(np.linalg.norm(spin(end)[1] - first) / np.linalg.norm(first))


FALL = Trial((0.1,), (0.0, 0.0, 20.0))
DROP = Trial((0.1,), (0.0, 0.0, 1.32625), restitution=0.8)  # half a second to the ground, from 1.22625 m
SLIDE = Trial((0.2, 0.2, 0.1), (0.0, 0.0, 0.1), (3.0, 0.0, 0.0), friction=0.5)
ROLL = Trial((0.1,), (0.0, 0.0, 0.1), (3.0, 0.0, 0.0), friction=0.5)
TUMBLE = Trial(tuple(BOOK / 2.0), angular=(0.01, 6.0, 0.0), gravity=0.0)
LAWS = {
    "a fall of 1 s": Law(FALL, 1.0, height(20.0 - 9.81 / 2.0), "mm", 1e-9),
    "the top after a bounce": Law(DROP, 0.9, height(0.1 + 0.64 * 1.22625), "mm", 1e-9, without=("mujoco",)),
    "where a box stops that slides": Law(
        SLIDE, 2.0, lambda _, end: 1e3 * abs(float(end.position[0]) - 9.0 / 9.81), "mm", 10.0
    ),
    "the speed of a ball that rolls": Law(
        ROLL, 2.0, lambda _, end: 1e3 * abs(float(end.linear[0]) - 15.0 / 7.0), "mm/s", 1e-6
    ),
    "energy of a book that tumbles for 10 s": Law(TUMBLE, 10.0, energy_of_turning, "%", 1e-6),
    "its angular momentum": Law(TUMBLE, 10.0, angular_momentum, "%", 1e-6),
}
