"""A ball on cloth slides, rolls and stops when and where theory says."""

from __future__ import annotations

import numpy as np
import pytest

from carom.systems.simulation import Simulation

G = 9.81
RADIUS = 0.028575
SLIDING, ROLLING = 0.2, 0.012


@pytest.mark.parametrize("dt", [1 / 240, 1 / 60])
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.6, 0.0, -0.8)], ids=["along x", "askew"])
def test_a_sliding_ball_comes_to_roll_at_five_sevenths_and_stops(
    direction: tuple[float, float, float], dt: float
) -> None:
    """Rolls after 2 v / (7 mu g) and 12 v^2 / (49 mu g) at 5/7 v, then slows by 5/7 mu_r g (Shepard, 1997).

    The rolling resistance acts as a torque mu_r N r on the ball, which friction at the cloth shares: 5/7 of mu_r g.
    Within 1 %: semi-implicit substeps lose half a substep of friction, h mu g / 2 in v and 7/12 h mu g / v in distance.
    """
    speed = 3.0
    ball, simulation = ball_on_cloth(dt, np.multiply(speed, direction))
    slide_time = 2.0 * speed / (7.0 * SLIDING * G)
    slide_length = 12.0 * speed**2 / (49.0 * SLIDING * G)
    rolled_at = rolled_after = None
    while rolled_at is None:
        simulation.step()
        body = simulation[ball]
        slip = body.motion.linear + np.cross(body.motion.angular, [0.0, -RADIUS, 0.0])
        if np.linalg.norm(slip) < 1e-9:
            rolled_at, rolled_after = simulation.time, float(body.transform.position @ direction)
            rolled_speed = float(np.linalg.norm(body.motion.linear))
    assert rolled_speed == pytest.approx(5.0 / 7.0 * speed, rel=0.01)
    assert rolled_at == pytest.approx(slide_time, rel=0.01, abs=dt)
    # The step in which rolling is seen may be one late: take its way back at rolling speed.
    assert rolled_after - rolled_speed * (rolled_at - slide_time) == pytest.approx(slide_length, rel=0.01)
    slowing = 5.0 / 7.0 * ROLLING * G
    stop_length = slide_length + (5.0 / 7.0 * speed) ** 2 / (2.0 * slowing)
    stop_time = slide_time + 5.0 / 7.0 * speed / slowing
    while np.linalg.norm(simulation[ball].motion.linear) > 1e-6:
        simulation.step()
    assert simulation.time == pytest.approx(stop_time, rel=0.01)
    assert float(simulation[ball].transform.position @ direction) == pytest.approx(stop_length, rel=0.01)
    assert np.abs(simulation[ball].motion.angular).max() < 1e-3


def test_a_rolling_ball_without_resistance_keeps_rolling() -> None:
    """Rolling without slip is kept to rounding: friction does no work on it."""
    speed = 2.0
    ball, simulation = ball_on_cloth(1 / 240, [speed, 0.0, 0.0], spin=[0.0, 0.0, -speed / RADIUS], rolling=0.0)
    simulation.step(480)
    assert simulation[ball].motion.linear == pytest.approx([speed, 0.0, 0.0], abs=1e-12)
    assert simulation[ball].transform.position == pytest.approx([2.0 * speed, 0.0, 0.0], abs=1e-10)


def ball_on_cloth(
    dt: float, velocity: object, spin: object = (0.0, 0.0, 0.0), rolling: float = ROLLING
) -> tuple[int, Simulation]:
    """Return a pool ball at the origin that touches the cloth, with this velocity."""
    simulation = Simulation(dt=dt)
    cloth = {"friction": {"value": SLIDING, "combine": "max"}, "rolling_friction": rolling}
    simulation.add(collider={"plane": {"offset": -RADIUS}}, material=cloth)
    ball = simulation.add(
        collider={"sphere": {"radius": RADIUS}},
        body={"mass": 0.17},
        material={"friction": 0.06, "restitution": 0.95},
        motion={"linear": velocity, "angular": spin},
    )
    return ball, simulation
