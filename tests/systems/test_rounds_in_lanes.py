"""How the normal turns between two that are round: with the line from one core to the other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.systems.kernels import groups as of
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

ALONG_Z, ALONG_X = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)), (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))
UP = (0.0, 0.0, 0.0, 1.0)
X, Z, BOTH, NONE = np.diag([1.0, 0.0, 0.0]), np.diag([0.0, 0.0, 1.0]), np.diag([1.0, 0.0, 1.0]), np.zeros((3, 3))


def round_one(shape: str, rotation: tuple[float, ...], y: float) -> dict[str, Any]:
    """Return the words of what is round, of radius 0.5 m, at such a height."""
    size = {"radius": 0.5} if shape == "sphere" else {"radius": 0.5, "length": 1.0}
    return {"collider": {shape: size}, "transform": {"position": (0.0, y, 0.0), "rotation": rotation}}


@pytest.mark.parametrize("first", ["below", "above"])
@pytest.mark.parametrize(
    ("below", "under", "above", "over", "curved"),
    [
        ("capsule", ALONG_Z, "sphere", UP, X),
        ("cylinder", ALONG_Z, "sphere", UP, X),
        ("cylinder", ALONG_X, "sphere", UP, Z),
        ("cylinder", ALONG_Z, "cylinder", ALONG_Z, X),
        ("cylinder", ALONG_Z, "capsule", ALONG_Z, X),
        ("capsule", ALONG_Z, "capsule", ALONG_X, NONE),  # which glide along each other
        ("capsule", UP, "sphere", UP, BOTH),  # on its cap
        ("cylinder", UP, "sphere", UP, NONE),  # on its end
        ("cylinder", UP, "capsule", ALONG_Z, NONE),
    ],
)
def test_normals_turn_across_the_axes(
    below: str, under: tuple[float, ...], above: str, over: tuple[float, ...], curved: np.ndarray, first: str
) -> None:
    """By one over the distance of the cores, 1 m, in whichever order the bodies came; FCL finds normals to 1e-4."""
    simulation = Simulation(sleeping=False)
    ground = {"body": {"type": "kinematic", "center_of_mass": (0.0, 0.0, 0.0)}, **round_one(below, under, 0.0)}
    height = 1.5 if (below, under) == ("capsule", UP) else 1.0
    body = {"body": {"mass": 1.0}, **round_one(above, over, height)}
    for words in (ground, body) if first == "below" else (body, ground):
        simulation.add(**words)
    simulation.step()
    resting = simulation.world[Resting]
    assert resting.groups == 1
    row, lanes = resting.row[0], resting.lanes[:, 0]
    t, u = (lanes[row + of.TANGENT + k : row + of.TANGENT + k + 3] for k in (0, 3))
    tt, tu, uu = lanes[row + of.CURVE : row + of.CURVE + 3]
    found = tt * np.outer(t, t) + tu * (np.outer(t, u) + np.outer(u, t)) + uu * np.outer(u, u)
    np.testing.assert_allclose(found, curved, atol=2e-4)
