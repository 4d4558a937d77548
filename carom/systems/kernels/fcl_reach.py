"""Whom FCL need not be asked about: most pairs whose bounds overlap are farther apart than they reach."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ROUGHLY, SURELY_APART
from carom.systems.kernels.cores import (
    AROUND,
    CORE,
    FIRST,
    HALF_SPACE,
    KIND,
    NONE,
    PLACE,
    SECOND,
    write_core,
    write_place,
)
from carom.systems.kernels.distance import FAR
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.narrow import PLANE_SHAPE
from carom.systems.kernels.nearing import MOST_STEPS, near
from carom.systems.kernels.parting_cores import normal_or_centers, part_from_half_space


@kernel("kept", makes_arrays=True)
def keep_near(which, pairs, reaches, shape, size, position, rotation, geometry, hulls, kept):
    """Write those of the pairs ``which`` that are not surely farther apart than they reach; return how many.

    A pair of a shape whose farthest points kernels do not know is kept.
    """
    core, place = np.empty(2 * CORE), np.empty(PLACE)
    corner, name, weight, seen = np.empty(12), np.empty(8, np.int64), np.empty(4), np.empty(3 * MOST_STEPS)
    count = 0
    for p in which:
        a, b = pairs[p, 0], pairs[p, 1]
        if shape[a] == PLANE_SHAPE:
            a, b = b, a
        write_core(shape, size, geometry, a, hulls, core, FIRST)
        write_core(shape, size, geometry, b, hulls, core, SECOND)
        write_place(position, rotation, a, b, place)
        reach = reaches[p] + core[AROUND] + core[CORE + AROUND] + SURELY_APART
        far = False
        if core[KIND] == NONE or core[CORE + KIND] == NONE:
            pass
        elif core[CORE + KIND] == HALF_SPACE:
            far = part_from_half_space(core, place, hulls.vertices)[0] > reach
        else:
            x, y, z = normal_or_centers(place, 0.0, 0.0, 0.0)
            far = near(
                core, place, hulls.vertices, x, y, z, reach, ROUGHLY * reach, corner, name, weight, seen
            )[0] == FAR  # fmt: skip
        if not far:
            kept[count] = p
            count += 1
    return count
