"""The numbers of the world `ship_in_water` are those of the wall-sided formula."""

from __future__ import annotations

import math

import pytest

from carom.worlds import load_world

AREA, SECOND_MOMENT = 8.0 * 3.0 + 3.0 * 3.0 / 2.0, 8.0 * 3.0**3 / 12.0 + 3.0 * 3.0**3 / 48.0  # of the waterplane


def test_the_ship_rolls_as_the_formula_integrated_says() -> None:
    """The masthead is 3.85 sin t off, t'' = -g / k^2 sin t (GM + BM tan^2 t / 2), 0.1 mm."""
    world = load_world("ship_in_water")
    volume = 23370.0 / 1025.0
    draft, metacentric = volume / AREA, SECOND_MOMENT / volume
    height = draft / 2.0 + metacentric - 0.75
    assert (draft, volume, metacentric, height) == pytest.approx((0.8, 22.8, 0.863487, 0.513487), abs=1e-6)
    assert 2.0 * math.pi * 1.1 / math.sqrt(9.81 * height) == pytest.approx(3.079, abs=5e-4)

    def turning(angle: float) -> float:
        """Return the angular acceleration."""
        return -9.81 / 1.1**2 * math.sin(angle) * (height + 0.5 * metacentric * math.tan(angle) ** 2)

    step, angle, rate = 1.0 / 24000.0, 0.0, 0.25
    angles = [angle]
    for _ in range(8 * 24000):
        rate += 0.5 * step * turning(angle)
        angle += step * rate
        rate += 0.5 * step * turning(angle)
        angles.append(angle)
    stated = {item["at"]: item["masthead.position.z"]["is"] for item in world.document["expect"] if "at" in item}
    assert len(stated) == 4
    for time, place in stated.items():
        seconds = float(time.removesuffix(" s"))
        assert place == pytest.approx(3.85 * math.sin(angles[round(seconds * 24000)]), abs=1e-4)
