"""What lies on rollers that turn is driven by all that its weight lets them rub."""

from __future__ import annotations

from math import cos, sqrt

import pytest

from carom.systems.simulation import Simulation

RADIUS, APART, THICK, FRICTION, GRAVITY = 0.1, 1.0, 0.04, 0.3, 9.81
ALONG_Z = (sqrt(0.5), 0.0, 0.0, sqrt(0.5))


def plank_on_rollers(spin: float, dt: float) -> tuple[Simulation, int]:
    """Return a world with a plank, 0.1 m off the middle of two rollers that both run inwards (rad/s)."""
    simulation, material = Simulation(dt=dt, sleeping=False), {"friction": FRICTION}
    for side in (-1.0, 1.0):
        simulation.add(
            collider={"cylinder": {"radius": RADIUS, "length": 0.6}}, body={"type": "kinematic"}, material=material,
            transform={"position": (0.5 * side * APART, 0.0, 0.0), "rotation": ALONG_Z},
            motion={"angular": (0.0, 0.0, side * spin)},
        )  # fmt: skip
    plank = simulation.add(
        collider={"box": {"size": (3.0, THICK, 0.4)}}, body={"mass": 1.0}, material=material,
        transform={"position": (0.1, RADIUS + 0.5 * THICK, 0.0)},
    )  # fmt: skip
    return simulation, plank


@pytest.mark.parametrize("spin", [5.0, 15.0, 40.0])
@pytest.mark.parametrize("parts", [1, 4])
def test_a_plank_on_two_rollers_goes_to_and_fro(spin: float, parts: int) -> None:
    """By x'' = -2 mu g x / (L - mu d) for a plank of thickness d, at whichever of these speeds they turn.

    Each rubs by mu times what it bears; as they do so at the lower side, they shift the load. In 4 s, in one and a
    half periods, it is 2.5 mm off, and a quarter of that in steps of a quarter: that points are where they are in the
    middle of a substep damps it.
    """
    simulation, plank = plank_on_rollers(spin, 1.0 / (60.0 * parts))
    rate = sqrt(2.0 * FRICTION * GRAVITY / (APART - FRICTION * THICK))
    for _ in range(240 * parts):
        simulation.step()
        x, y, z = simulation[plank].transform.position
        assert x == pytest.approx(0.1 * cos(rate * simulation.time), abs=2.5e-3 / parts)
        assert y == pytest.approx(RADIUS + 0.5 * THICK, abs=1.2e-5)
        assert z == pytest.approx(0.0, abs=1e-6)
