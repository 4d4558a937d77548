"""Drags in world files against closed forms, at 1/240 s."""

from __future__ import annotations

import math

import pytest

from carom.systems.simulation import Simulation
from carom.worlds import load_text

BALL = "collider: {sphere: {radius: 0.0366}, layer: none}, body: {mass: 0.145}"


def flying(line: str, law: str, settings: str = "gravity: [0, 0, 0]") -> Simulation:
    """Return a world with one body that a law acts on."""
    text = f"carom: 1\nname: drag\n{settings}\nstep: {{dt: 1/240}}\nentities:\n  - {{name: ball, {line}}}\nforces:\n"
    return load_text(f"{text}  - {law}\n", "drag.yaml").simulation


def test_linear_drag() -> None:
    """The speed is v0 exp(-c t / m), the way v0 m / c (1 - exp(-c t / m)): after 2 s 0.183156 m/s and 4.908422 m."""
    simulation = flying("body: {mass: 1}, motion: {linear: [10, 0, 0]}", "linear_drag: {coefficient: 2}")
    simulation.step(480)
    left = math.exp(-4.0)
    assert (10.0 * left, 5.0 * (1.0 - left)) == pytest.approx((0.183156, 4.908422), abs=5e-7)
    assert simulation["ball"].motion.linear == pytest.approx([10.0 * left, 0.0, 0.0], rel=1e-12)
    assert simulation["ball"].transform.position == pytest.approx([5.0 * (1.0 - left), 0.0, 0.0], rel=1e-6)


@pytest.mark.parametrize("coefficient", [1e3, 1e9, 1e300])
def test_linear_drag_is_bounded_however_strong(coefficient: float) -> None:
    """A body stops without turning back, and goes no farther than v0 m / c, or v0 h / 2 where that is more."""
    simulation = flying("body: {mass: 1}, motion: {linear: [10, 0, 0]}", f"linear_drag: {{coefficient: {coefficient}}}")
    for _ in range(480):
        simulation.step()
        assert 0.0 <= simulation["ball"].motion.linear[0] <= 10.0
    assert simulation["ball"].motion.linear[0] == pytest.approx(0.0, abs=1e-12)
    assert 0.0 <= simulation["ball"].transform.position[0] <= max(10.0 / coefficient, 10.0 / 1920)


def test_a_ball_falls_through_air() -> None:
    """0.145 kg, r 0.0366 m, Cd 0.47: v = U tanh(g t / U), U^2 / g log cosh(g t / U) down, 1e-4 after 3 s."""
    area = math.pi * 0.0366**2
    law = f"quadratic_drag: {{area: {area}, drag_coefficient: 0.47, density: 1.225}}"
    simulation = flying(BALL, law, "gravity: [0, -9.81, 0]")
    simulation.step(720)
    most = math.sqrt(2.0 * 0.145 * 9.81 / (1.225 * 0.47 * area))
    speed, way = most * math.tanh(9.81 * 3.0 / most), most**2 / 9.81 * math.log(math.cosh(9.81 * 3.0 / most))
    assert (speed, way) == pytest.approx((23.8379, 39.592), rel=1e-5)
    assert simulation["ball"].motion.linear == pytest.approx([0.0, -speed, 0.0], rel=1e-4)
    assert simulation["ball"].transform.position == pytest.approx([0.0, -way, 0.0], rel=1e-4)
