"""Directions and identities of carom's frame: right-handed, +x right, +y up, forward -z. All are read-only."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats


def _fixed(value: npt.ArrayLike) -> Floats:
    array = np.array(value, np.float64)
    array.flags.writeable = False
    return array


ZERO = _fixed((0.0, 0.0, 0.0))
ONE = _fixed((1.0, 1.0, 1.0))
RIGHT = _fixed((1.0, 0.0, 0.0))
LEFT = _fixed((-1.0, 0.0, 0.0))
UP = _fixed((0.0, 1.0, 0.0))
DOWN = _fixed((0.0, -1.0, 0.0))
BACK = _fixed((0.0, 0.0, 1.0))
FORWARD = _fixed((0.0, 0.0, -1.0))

IDENTITY_ROTATION = _fixed((0.0, 0.0, 0.0, 1.0))  # quaternion xyzw
IDENTITY_MATRIX = _fixed(np.eye(4))

# Left-handed engines with +y up look along +z (DirectX, Unity): the same picture with z the other way round.
LEFT_FROM_RIGHT = _fixed(np.diag((1.0, 1.0, -1.0, 1.0)))
