"""What lies and rolls on a face that turns, whatever shape it is a face of: a turntable is a cylinder, too."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.simulation import Simulation

DT, RADIUS = 1.0 / 60.0, 0.1
BALL: dict[str, Any] = {"sphere": {"radius": RADIUS}}
ROUGH = {"friction": 1.0}
CORNERS = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
UPSIDE_DOWN = (1.0, 0.0, 0.0, 0.0)
TABLES: dict[str, dict[str, Any]] = {
    "box": {"collider": {"box": {"size": (20.0, 0.5, 20.0)}}, "transform": {"position": (0.0, -0.25, 0.0)}},
    "hull": {
        "collider": {"shape": Convex(hull_of(CORNERS * (20.0, 0.5, 20.0)))},
        "transform": {"position": (0.0, -0.25, 0.0)},
    },
    "cylinder": {
        "collider": {"cylinder": {"radius": 10.0, "length": 0.5}}, "transform": {"position": (0.0, -0.25, 0.0)}
    },
    "cone": {
        "collider": {"cone": {"radius": 10.0, "length": 0.5}},
        "transform": {"position": (0.0, -0.25, 0.0), "rotation": UPSIDE_DOWN},
    },
}  # fmt: skip


def rolling_on(table: str, spin: float, speed: float, dt: float = DT) -> tuple[Simulation, int]:
    """Return a world with a ball 1 m from the axis of a turntable (rad/s), on which it rolls at a speed along z."""
    simulation = Simulation(dt=dt, sleeping=False)
    simulation.add(body={"type": "kinematic"}, motion={"angular": (0.0, spin, 0.0)}, material=ROUGH, **TABLES[table])
    slips = -spin - speed  # m/s, of the surface against the centre
    ball = simulation.add(
        collider=BALL, body={"mass": 1.0}, material=ROUGH, transform={"position": (1.0, RADIUS, 0.0)},
        motion={"linear": (0.0, 0.0, speed), "angular": (-slips / RADIUS, 0.0, 0.0)},
    )  # fmt: skip
    return simulation, ball


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize(("spin", "bound"), [(2.0, 5e-6), (-2.0, 5e-6), (8.0, 2e-4)])
def test_a_ball_on_a_turntable_goes_in_circles(table: str, spin: float, bound: float) -> None:
    """At 2/7 of the spin, about wherever it began: Weltner, Am. J. Phys. 47, 984 (1979); in a second."""
    simulation, ball = rolling_on(table, spin, 0.5)
    rate = 2.0 / 7.0 * spin
    for _ in range(60):
        simulation.step()
        angle = rate * simulation.time
        x, z = 0.5 / rate * (1.0 - np.cos(angle)), 0.5 / rate * np.sin(angle)
        assert simulation[ball].transform.position == pytest.approx((1.0 + x, RADIUS, z), abs=bound)


@pytest.mark.parametrize("table", TABLES)
def test_one_that_stands_still_stays_there(table: str) -> None:
    """It spins in its place, as the table glides beneath it: in 5 s it goes 0.1 mm, on exact arcs 1 um."""
    simulation, ball = rolling_on(table, 8.0, 0.0)
    simulation.step(300)
    bound = 1e-6 if table == "box" else 1e-4
    assert simulation[ball].transform.position == pytest.approx([1.0, RADIUS, 0.0], abs=bound)


def test_it_errs_by_the_square_of_the_step() -> None:
    """A ball on a hull: a quarter in steps of half the length."""
    errors = []
    for dt in (DT, DT / 2.0):
        simulation, ball = rolling_on("hull", 4.0, 0.5, dt)
        simulation.step(round(1.0 / dt))
        angle = 8.0 / 7.0
        errors.append(simulation[ball].transform.position[0] - 1.0 - 3.5 / 8.0 * (1.0 - np.cos(angle)))
    assert errors[1] / errors[0] == pytest.approx(0.25, abs=0.03)
