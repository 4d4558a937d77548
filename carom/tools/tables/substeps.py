"""Substeps: the pose of everything visible after every substep."""

from __future__ import annotations

import numpy as np

from carom.ecs.dataframe import Flat, flat
from carom.tools.tables.bodies import bodies
from carom.tools.tables.source import FRAME, Source


def substeps(source: Source, count: int) -> list[Flat]:
    """Return a row per substep and visible entity, by the poses of a source whose frames are substeps.

    A frame has ``count`` of them; the last is the frame itself.
    """
    (_, numbers), *others = bodies(source)
    whole = np.asarray(numbers)
    frames = -(-whole // count)
    return [
        flat("frame", FRAME, frames),
        flat("part", {"unit": "1", "doc": "which substep of the step, from 1 on"}, whole - count * (frames - 1)),
        *others,
    ]
