"""A thousand bounces in a room of tilted mirrors, against a solution that goes from bounce to bounce."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation

RADIUS = 0.05
WALLS = [
    ((1.0, 0.11, -0.07), -2.0), ((-1.0, 0.05, 0.13), -2.1), ((0.09, 1.0, 0.06), -1.4),
    ((-0.12, -1.0, 0.08), -1.6), ((0.04, -0.1, 1.0), -2.4), ((0.15, 0.07, -1.0), -2.2),
]  # fmt: skip
START = np.array([0.1, 0.2, -0.3])
VELOCITY = 40.0 * np.array([0.48, 0.6, 0.64])


def bounces(count: int) -> list[tuple[float, np.ndarray]]:
    """Return (time, centre) of each bounce by solving for the next wall alone, in extended precision."""
    normals = np.array(
        [np.array(n, np.longdouble) / np.sqrt((np.array(n, np.longdouble) ** 2).sum()) for n, _ in WALLS]
    )
    offsets = np.array([offset for _, offset in WALLS], np.longdouble)
    place, velocity, time = START.astype(np.longdouble), VELOCITY.astype(np.longdouble), np.longdouble(0.0)
    found = []
    for _ in range(count):
        closing = -(normals * velocity).sum(axis=1)
        gaps = (normals * place).sum(axis=1) - offsets - np.longdouble(RADIUS)
        times = np.where(closing > 0.0, gaps / np.where(closing > 0.0, closing, 1.0), np.inf)
        wall = int(np.argmin(times))
        place, time = place + velocity * times[wall], time + times[wall]
        velocity = velocity + 2.0 * closing[wall] * normals[wall]
        found.append((float(time), place.astype(np.float64)))
    return found


@pytest.mark.parametrize(
    ("dt", "count"), [(1 / 60, 1000), (1 / 240, 250), pytest.param(1 / 240, 1000, marks=pytest.mark.slow)]
)
def test_bounces_happen_when_and_where_they_should(dt: float, count: int) -> None:
    """Positions within 1e-6 m, times within 1e-9 s, energy within 1e-9."""
    simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
    mirror = {"restitution": 1.0, "friction": 0.0}
    for normal, offset in WALLS:
        simulation.add(collider={"plane": {"normal": normal, "offset": offset}}, material=mirror)
    ball = simulation.add(
        collider={"sphere": {"radius": RADIUS}}, body={}, material=mirror,
        transform={"position": START}, motion={"linear": VELOCITY},
    )  # fmt: skip
    seen: list[tuple[float, np.ndarray]] = []
    worst_speed = 0.0
    while len(seen) < count:
        simulation.step()
        impact = simulation.world[Impact]
        for k in range(impact.count):
            seen.append((float(impact.time[k]), impact.point[k] + RADIUS * impact.normal[k]))
        speed = float(np.sqrt((simulation[ball].motion.linear ** 2).sum()))
        worst_speed = max(worst_speed, abs(speed / 40.0 - 1.0))
    for (time, place), (true_time, true_place) in zip(seen, bounces(count), strict=False):
        assert abs(time - true_time) <= 1e-9
        assert np.abs(place - true_place).max() <= 1e-6
    assert worst_speed <= 0.5e-9  # energy is its square
