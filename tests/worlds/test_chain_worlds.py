"""The numbers of the worlds of chains are those of Lagrange's equations and of statics, solved here on their own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from expected import G, stated, stepped

from carom.ecs.spatial import quaternion
from carom.worlds import load_world


class Chain:
    """Links of a library world that hang in a plane, from the angles (below: 0) and with the masses they have there."""

    def __init__(self, world: str, name: str, count: int) -> None:
        simulation = load_world(world).simulation
        links = [simulation[f"{name}[{number}]"] for number in range(count)]
        along = quaternion.rotate(np.array([link.transform.rotation for link in links]), (0.0, 1.0, 0.0))
        joint = simulation[f"{name}.joint[0]"].joint
        self.length, self.hook = 2.0 * float(np.linalg.norm(joint.anchor_b)), joint.anchor_a.copy()
        self.mass, inertia = float(links[0].rigid_body.mass), float(links[0].rigid_body.inertia[0])
        self.angles, self.count = np.arctan2(along[:, 0], -along[:, 1]), count
        number = np.arange(count)
        inert = self.mass * self.length**2
        self.inertia = inert * (count - np.maximum.outer(number, number) - 0.5)
        self.inertia[number, number] = inert * (count - number - 0.75) + inertia
        self.weight = self.mass * G * self.length * (count - number - 0.5)

    def rate(self, state: np.ndarray) -> np.ndarray:
        """Return how angles and their speeds change."""
        angles, speeds = np.split(state, 2)
        apart = np.subtract.outer(angles, angles)
        force = -(self.inertia * np.sin(apart)) @ speeds**2 - self.weight * np.sin(angles)
        return np.concatenate([speeds, np.linalg.solve(self.inertia * np.cos(apart), force)])

    def after(self, time: float, dt: float = 0.0005) -> np.ndarray:
        """Return the state after a time, s."""
        state = np.concatenate([self.angles, np.zeros(self.count)])
        for _ in range(round(time / dt)):
            state = stepped(self.rate, state, dt)
        return state

    def middles(self, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return where the links' centres are and how fast they move (n, 2)."""
        angles, speeds = np.split(state, 2)
        way = self.length * np.stack([np.sin(angles), -np.cos(angles)], axis=1)
        pace = self.length * speeds[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        return self.hook[:2] + way.cumsum(axis=0) - way / 2, pace.cumsum(axis=0) - pace / 2

    def load(self, before: np.ndarray, after: np.ndarray, dt: float) -> float:
        """Return what the hook bears between two states: all weight and all change of momentum, N."""
        change = self.mass * (self.middles(after)[1] - self.middles(before)[1]).sum(axis=0) / dt
        return math.hypot(change[0], change[1] + self.count * self.mass * G)


def test_chain() -> None:
    """A pendulum of twelve parts; and what hangs still bears what is below."""
    chain = Chain("chain", "swinging", 12)
    for time in (0.5, 1.0, 2.0):
        place = chain.middles(chain.after(time))[0][-1]
        told = stated("chain", f"{time:g} s", "swinging[11].position", "m")
        np.testing.assert_allclose(told, [*place, 0.0], rtol=0, atol=1e-5)
    before = chain.after(0.5 - 1 / 240, 1 / 2400)
    load = chain.load(before, stepped(chain.rate, before, 1 / 240), 1 / 240)
    assert stated("chain", "0.5 s", "load(swinging.joint[0])", "N") == pytest.approx(load, abs=1e-3)
    for term, mass in (("load(carrying.joint[0])", 56.0), ("load(carrying.joint[12])", 50.0)):
        assert stated("chain", "3 s", term, "N") == pytest.approx(mass * G, abs=1e-6)


def test_whip() -> None:
    """The end overtakes the stone."""
    whip = Chain("whip", "whip", 16)
    for time in (0.25, 0.375, 0.5):
        places, speeds = whip.middles(whip.after(time))
        told = stated("whip", f"{time:g} s", "whip[15].position", "m")
        np.testing.assert_allclose(told, [*places[-1], 0.0], rtol=0, atol=1e-5)
        speed = math.hypot(*speeds[-1])
        assert stated("whip", f"{time:g} s", "speed(whip[15])", "m/s") == pytest.approx(speed, abs=1e-4)
        assert speed > G * time
    before = whip.after(0.125 - 1 / 480, 1 / 4800)
    load = whip.load(before, stepped(whip.rate, before, 1 / 480), 1 / 480)
    assert stated("whip", "0.125 s", "load(whip.joint[0])", "N") == pytest.approx(load, abs=1e-3)


def test_bridge() -> None:
    """Planks lie along the pull at their middles, and the level part of it is such that they reach across."""
    simulation = load_world("bridge").simulation
    length = 2.0 * float(np.linalg.norm(simulation["plank.joint[1]"].joint.anchor_b))
    weights = np.full(25, 15.0 * G)
    weights[12] += 60.0 * G
    upright = weights.sum() / 2 - weights.cumsum() + weights / 2  # at the middle of each plank
    low, high = 1.0, 1e5
    for _ in range(100):
        level = (low + high) / 2
        slopes = np.arctan2(upright, level)
        low, high = (level, high) if (length * np.cos(slopes)).sum() < 10.0 else (low, level)
    down = -(length * np.sin(slopes)).cumsum() + length * np.sin(slopes) / 2
    told = {term: stated("bridge", "5 s", term, unit) for term, unit in (
        ("plank.joint[0].force.x", "N"), ("plank.joint[0].force.y", "N"), ("plank[12].position.y", "m"),
        ("load(rope)", "N"),
    )}  # fmt: skip
    np.testing.assert_allclose(list(told.values()), [-level, weights.sum() / 2, down[12], 60.0 * G], rtol=1e-6)
