"""What the property tests of space draw: vectors, directions, angles and rotations of sane sizes."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion

EPSILON = 1e-14  # a few roundings of numbers near 1

components = st.floats(-1.0, 1.0)
vectors = st.tuples(*[st.integers(-(10**9), 10**9)] * 3).map(lambda v: np.array(v) * 1e-6)
directions = vectors.filter(lambda v: float(v @ v) > 1e-4)
angles = st.floats(-10.0, 10.0)
fractions = st.floats(0.0, 1.0)


@st.composite
def rotations(draw: st.DrawFn) -> Floats:
    """Draw a unit quaternion."""
    q = np.array(draw(st.tuples(*[components] * 4)))
    assume(q @ q > 1e-4)
    return quaternion.normalise(q)


def units_off(found: float, true: float) -> float:
    """Return how many units in the last place of ``true`` a number is off."""
    return abs(found - true) / math.ulp(true)


def apart(a: Floats, b: Floats) -> float:
    """Return how far two quaternions are apart as rotations: q and -q are one."""
    return float(min(np.abs(a - b).max(), np.abs(a + b).max()))
