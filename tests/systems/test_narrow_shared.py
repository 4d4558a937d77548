"""What threads measure of many pairs is what one does, and each keeps to its room."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from carom.ecs.relations.contact import Contact
from carom.systems.simulation import Simulation

pytestmark = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="kernels are not shared without the JIT")

COUNT = 90
ANGLES = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
RIMS = [(0.3 * np.cos(a), y, 0.3 * np.sin(a)) for a in ANGLES for y in (-0.1, 0.1)]
#: Shapes whose middles are 10 cm above what they lie on, faces of many corners among them.
LYING: dict[str, Any] = {
    "prism": {"convex": {"points": RIMS}},
    "cylinder": {"cylinder": {"radius": 0.3, "length": 0.2}},
    "cone": {"cone": {"radius": 0.3, "length": 0.2}},
    "ellipsoid": {"ellipsoid": {"radii": (0.3, 0.1, 0.3)}},
    "box": {"box": {"size": (0.6, 0.2, 0.6)}},
    "ball": {"sphere": {"radius": 0.1}},
}
FLOORS: dict[str, Any] = {
    "box": {"collider": {"box": {"size": (40.0, 2.0, 40.0)}}, "transform": {"position": (0.0, -1.0, 0.0)}},
    "mesh": {"collider": {"height_field": {"heights": np.zeros((41, 41)).tolist(), "spacing": 1.0}}},
    "plane": {"collider": {"plane": {}}},
    "prism": {"collider": {"convex": {"points": (np.array(RIMS) * (70.0, 10.0, 70.0) - (0.0, 1.0, 0.0)).tolist()}}},
}


def touching(shape: str, floor: str, threads: int) -> list[bytes]:
    """Return the contacts of many bodies that lie on a floor after two steps, shared by so many threads."""
    simulation = Simulation(sleeping=False, threads=threads)
    simulation.add(**FLOORS[floor])
    random = np.random.default_rng(6)
    place = np.stack(np.divmod(np.arange(COUNT), 10), axis=1)[:, [0, 0, 1]] * (1.0, 0.0, 1.0) - (4.5, -0.1, 4.5)
    simulation.add_many(place + random.uniform(-0.1, 0.1, (COUNT, 3)) * (1.0, 0.0, 1.0), collider=LYING[shape], body={})
    simulation.step(2)
    contact = simulation.world[Contact]
    assert contact.count >= COUNT
    return [
        getattr(contact, name)[: contact.count].tobytes() for name in ("a", "feature", "normal", "depth", "impulse")
    ]


@pytest.mark.parametrize("floor", FLOORS)
@pytest.mark.parametrize("shape", LYING)
def test_threads_measure_what_one_does(shape: str, floor: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of all shapes on all floors, also where faces have more corners than contacts have points."""
    monkeypatch.setattr("carom.systems.threads.processors", lambda: 8)
    monkeypatch.setattr("carom.systems.threads.FEWEST", 4)
    alone = touching(shape, floor, 1)
    assert touching(shape, floor, 2) == alone
    assert touching(shape, floor, 3) == alone
