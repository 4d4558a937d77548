"""The numbers of the worlds of joints are those of their formulas, integrated or solved here on their own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from expected import G, stated, stepped

from carom.worlds import load_world


def test_spring_mass() -> None:
    """Sines, and what is just damped enough not to be one."""
    rate, reach = math.tau, G / math.tau**2
    for time in (0.5, 1.0, 1.75):
        below = reach * (1 - math.cos(rate * time))
        told = stated("spring_mass", f"{time:g} s", "weight.position.y", "m")
        assert told == pytest.approx(1.4 - below, abs=1e-6)
    assert stated("spring_mass", "1.75 s", "weight.linear.y", "m/s") == pytest.approx(reach * rate, abs=1e-6)
    for time in (0.25, 0.5, 2.0):
        told = stated("spring_mass", f"{time:g} s", "calm.position.y", "m")
        below = reach * (1 - (1 + rate * time) * math.exp(-rate * time))
        assert told == pytest.approx(1.4 - below, abs=1e-6)
    assert stated("spring_mass", "1.75 s", "light.linear.x", "m/s") == pytest.approx(-0.15 * rate, abs=1e-6)


def test_door() -> None:
    """The gate falls against rust, strikes and goes back."""
    width, depth, mass, lean, rust, bounce = 1.0, 0.06, 30.0, math.radians(8.0), 5.0, 0.5
    inertia = mass * (width**2 + depth**2) / 12 + mass * width**2 / 4
    weight = mass * G * width / 2 * math.sin(lean)

    def rate(state: np.ndarray) -> np.ndarray:
        return np.array([state[1], (weight * math.cos(state[0]) - math.copysign(rust, state[1])) / inertia])

    h, state, found = 1e-4, np.array([0.0, 1e-12]), {}
    for n in range(30001):
        if n % 5000 == 0:
            found[n // 5000] = state
        state = stepped(rate, state, h)
        if state[0] >= math.pi / 2:
            arrives = math.sqrt(2 * (weight - rust * math.pi / 2) / inertia)
            assert state[1] == pytest.approx(arrives, abs=1e-4)
            over = (state[0] - math.pi / 2) / state[1]
            state = np.array([math.pi / 2 - bounce * state[1] * over, -bounce * state[1]])
    for time, half_seconds in (("1 s", 2), ("1.5 s", 3), ("2 s", 4), ("3 s", 6)):
        angle, speed = found[half_seconds]
        assert stated("door", time, "hinge.angle", "rad") == pytest.approx(angle, abs=1e-4)
        assert stated("door", time, "hinge.velocity.rotation_x", "rad/s") == pytest.approx(speed, abs=1e-4)


def test_double_pendulum() -> None:
    """Lagrange's equations of two bobs that turn with their rods."""
    m, n, a, b, radius = 1.0, 0.6, 0.5, 0.5, 0.06
    own, other = 0.4 * m * radius**2, 0.4 * n * radius**2

    def rate(state: np.ndarray) -> np.ndarray:
        t, u, p, q = state
        mixed, sine = n * a * b * math.cos(t - u), n * a * b * math.sin(t - u)
        inertia = np.array([[(m + n) * a * a + own, mixed], [mixed, n * b * b + other]])
        force = [-sine * q * q - (m + n) * G * a * math.sin(t), sine * p * p - n * G * b * math.sin(u)]
        return np.array([p, q, *np.linalg.solve(inertia, force)])

    state = np.array([math.pi / 2, math.pi, 0.0, 0.0])
    for time in range(1, 5):
        for _ in range(2000):
            state = stepped(rate, state, 0.5 / 2000)
        if time == 3:
            continue
        first = np.array([a * math.sin(state[0]), -a * math.cos(state[0]), 0.0])
        second = first + np.array([b * math.sin(state[1]), -b * math.cos(state[1]), 0.0])
        for name, place in (("first", first), ("second", second)):
            told = stated("double_pendulum", f"{time / 2:g} s", f"{name}.position", "m")
            np.testing.assert_allclose(told, place, rtol=0, atol=1e-5)


def test_spinning_top() -> None:
    """The slow root of steady precession, and the velocities that it is started with."""
    across, along, spin, lean, reach = 0.1, 0.02, 100.0, math.radians(30.0), 0.3
    a, b, c = across * math.cos(lean), along * spin, G * reach
    precession = (b - math.sqrt(b * b - 4 * a * c)) / (2 * a)
    own = spin - precession * math.cos(lean)
    motion = load_world("spinning_top").simulation["top"].motion
    angular = [own * math.sin(lean), precession + own * math.cos(lean), 0.0]
    np.testing.assert_allclose(motion.angular, angular, rtol=0, atol=1e-4)
    np.testing.assert_allclose(motion.linear, [0.0, 0.0, -0.15 * precession], rtol=0, atol=1e-6)
    for time in (1.0, 2.5, 5.0):
        turn = precession * time
        place = [0.15 * math.cos(turn), reach * math.cos(lean), -0.15 * math.sin(turn)]
        np.testing.assert_allclose(stated("spinning_top", f"{time:g} s", "top.position", "m"), place, atol=1e-6)


def test_slider_crank() -> None:
    """The piston's place by the crank's angle; torque and load from energy and momentum at both ends of a step."""
    crank, rod, piston, mass, inertia, speed, dt = 0.2, 0.6, 2.0, 0.5, 0.015, math.tau, 1 / 480

    def at(time: float) -> tuple[float, float, float]:
        """Return where the piston is, energy and upward momentum of rod and piston."""
        turn = speed * time
        lean = math.asin(crank * math.sin(turn) / rod)
        leaning = crank * speed * math.cos(turn) / (rod * math.cos(lean))
        place = crank * math.cos(turn) + rod * math.cos(lean)
        rises = -crank * speed * math.sin(turn) - rod * math.sin(lean) * leaning
        middle = (crank * math.cos(turn) + place) / 2
        across, up = -crank * speed * math.cos(turn) / 2, (rises - crank * speed * math.sin(turn)) / 2
        kinetic = piston * rises**2 / 2 + mass * (across**2 + up**2) / 2 + inertia * leaning**2 / 2
        return place, kinetic + G * (piston * place + mass * middle), piston * rises + mass * up

    for time in (2.25, 2.5, 2.75):
        place, energy, _ = at(time)
        torque = (energy - at(time - dt)[1]) / dt / speed
        told = [stated("slider_crank", f"{time:g} s", term, unit)
                for term, unit in (("piston.position.y", "m"), ("motor.effort.rotation_x", "N m"))]  # fmt: skip
        np.testing.assert_allclose(told, [place, torque], rtol=0, atol=1e-5)
    for time in (2.5, 3.0):
        force = (at(time)[2] - at(time - dt)[2]) / dt + 5.5 * G
        assert stated("slider_crank", f"{time:g} s", "motor.force.y", "N") == pytest.approx(force, abs=1e-4)


def test_newtons_cradle() -> None:
    """The speed at the bottom, the elliptic quarter of a swing, and two ropes that share a weight."""
    height, start, gap = 0.6, math.radians(60.0), 0.0002
    arrives = math.sqrt(2 * G * height * (1 - math.cos(start)))
    mean, other = 1.0, math.cos(start / 2)
    for _ in range(10):  # Gauss: K = pi / 2 over the arithmetic-geometric mean of 1 and the cosine of half the angle
        mean, other = (mean + other) / 2, math.sqrt(mean * other)
    quarter = math.pi / 2 / mean * math.sqrt(height / G)
    first, last = "{'impact': ['ball_1', 'ball_2']}", "{'impact': ['ball_4', 'ball_5']}"
    for moment in (first, last):
        assert stated("newtons_cradle", moment, "speed", "m/s") == pytest.approx(arrives, abs=1e-6)
    assert stated("newtons_cradle", first, "time", "s") == pytest.approx(quarter - gap / arrives, abs=1e-5)
    assert stated("newtons_cradle", last, "time", "s") == pytest.approx(quarter + 2 * gap / arrives, abs=1e-5)
    load = 0.5 * G / 2 * math.hypot(height, 0.2) / height
    assert stated("newtons_cradle", "0.25 s", "load(rope_5_near)", "N") == pytest.approx(load, abs=1e-6)
    top = [0.2004 + height * math.sin(start), 1 - height * math.cos(start), 0]
    np.testing.assert_allclose(stated("newtons_cradle", "400/480 s", "ball_5.position", "m"), top, atol=1e-6)


def test_robot_arm() -> None:
    """Springs give way until their torque is that of all beyond them, in gravity and as they go round."""
    upper, lower, load, turning = (0.6, 0.1, 4.0), (0.5, 0.08, 2.0), 3.0, math.radians(30.0)

    def torque(limb: tuple[float, float, float], begin: np.ndarray, angle: float, joint: np.ndarray) -> float:
        """Return what a limb asks of a joint: its weight, and its mass going round the axis of the post."""
        length, thick, mass = limb
        sine, cosine = math.sin(angle), math.cos(angle)
        x, y = begin + length / 2 * np.array([cosine, sine])
        spread = mass * (length**2 - thick**2) / 12 * sine * cosine
        return mass * G * (x - joint[0]) + turning**2 * (mass * x * (y - joint[1]) + spread)

    shoulder, t, u = np.zeros(2), math.radians(60.0), math.radians(-75.0)
    for _ in range(100):
        elbow = shoulder + upper[0] * np.array([math.cos(t), math.sin(t)])
        hand = elbow + lower[0] * np.array([math.cos(t + u), math.sin(t + u)])
        asked = [torque(lower, elbow, t + u, joint) + torque((0.0, 0.0, load), hand, 0.0, joint)
                 for joint in (shoulder, elbow)]  # fmt: skip
        asked[0] += torque(upper, shoulder, t, shoulder)
        t, u = math.radians(60.0) - asked[0] / 2000.0, math.radians(-75.0) - asked[1] / 1000.0
    told = {term: stated("robot_arm", "4 s", term, unit) for term, unit in (
        ("shoulder.angle", "rad"), ("elbow.angle", "rad"), ("shoulder.effort.rotation_x", "N m"),
        ("elbow.effort.rotation_x", "N m"), ("load.position.y", "m"), ("base.force.y", "N"),
    )}  # fmt: skip
    np.testing.assert_allclose(list(told.values()), [t, u, *asked, 0.6 + hand[1], 21 * G], rtol=1e-5)
