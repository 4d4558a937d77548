"""Bodies that tests of locked axes share."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion

ROTATIONS = ["rotation_x", "rotation_y", "rotation_z"]
SHAPES: list[dict[str, Any]] = [
    {"box": {"size": (0.3, 0.5, 0.4)}},
    {"sphere": {"radius": 0.2}},
    {"capsule": {"radius": 0.1, "length": 0.3}},
    {"cylinder": {"radius": 0.2, "length": 0.3}},
    {"sphere": {"radius": 0.15}, "position": (0.1, 0.05, -0.02)},
]


def askew(generator: np.random.Generator) -> Floats:
    """Return any rotation."""
    return quaternion.normalise(generator.normal(size=4))
