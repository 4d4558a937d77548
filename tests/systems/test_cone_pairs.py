"""Cones and ellipsoids against everything that moves, and planes: FCL's guarded answers by coal's measure."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pairs import SHAPES, Pair, shallow_poses

from carom.systems.shapes.cone import Cone
from carom.systems.shapes.ellipsoid import Ellipsoid

ROUND: dict[str, Any] = {"cone": Cone(0.4, 1.1), "ellipsoid": Ellipsoid((0.3, 0.7, 0.5))}
OTHERS: dict[str, Any] = {key: SHAPES[key] for key in ("box", "capsule", "cylinder", "convex", "plane")} | ROUND


@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("key", ROUND)
def test_shallow_overlaps_agree_with_coal(key: str, other: str) -> None:
    """1 mm and 1 cm deep, in both orders: depth within 1e-5 m, normal within half a degree; with planes to 2e-9 m.

    FCL's own answer for cones in half spaces is up to 25 cm off. Two cones, where it may hang, are moved apart along
    its first normal and measured there, to 0.1 mm and a degree.
    """
    pair = Pair(ROUND[key], OTHERS[other])
    within, turned = (2e-9, 1e-6) if other == "plane" else (1e-5, np.deg2rad(0.5))
    if key == other == "cone":
        within, turned = 1e-4, np.deg2rad(1.0)
    for poses, depth, normal in shallow_poses(ROUND[key], OTHERS[other], 20, seed=5):
        for swapped, sense in ((False, 1.0), (True, -1.0)):
            _, found, overlap = max(pair.measure(poses, swapped=swapped), key=lambda point: point[2])
            assert overlap == pytest.approx(depth, abs=within)
            assert np.linalg.norm(sense * found - normal) <= turned


@pytest.mark.parametrize("gap", [1e-3, 1e-2])
@pytest.mark.parametrize("key", ROUND)
def test_a_plane_is_seen_before_it_is_met(key: str, gap: float) -> None:
    """Within reach the gap is exact; beyond it there is no contact, also of a cone, where FCL sees some."""
    pair = Pair(ROUND[key], SHAPES["plane"])
    for poses, depth, normal in shallow_poses(ROUND[key], SHAPES["plane"], 20, seed=7):
        apart = poses._replace(position_b=poses.position_b + normal * (depth + gap))
        assert max(depth for _, _, depth in pair.measure(apart, 2.0 * gap)) == pytest.approx(-gap, abs=2e-9)
        assert pair.measure(apart, 0.5 * gap) == []
