"""Lanes: eight numbers at a time, which the compiler keeps in one register where the processor has such.

Vectors are of LLVM's own kind: a loop over eight numbers need not become one. Without the JIT a lane is a NumPy array
of eight, so that the same kernels run either way, with the same bits.
"""

from __future__ import annotations

from math import prod

import numba
import numpy as np

from carom.ecs.column import Floats
from carom.systems.kernels.lane_widths import WIDTH

if numba.config.DISABLE_JIT:
    from carom.systems.kernels.lanes_plain import (
        address,
        choose,
        fetch,
        gather,
        gather_four,
        larger,
        load,
        planes,
        root,
        scatter,
        scatter_four,
        smaller,
        some,
        spread,
        store,
        which,
        whole,
    )
else:
    from carom.systems.kernels.lanes_compiled import (
        address,
        choose,
        larger,
        load,
        root,
        smaller,
        some,
        spread,
        store,
        which,
        whole,
    )
    from carom.systems.kernels.lanes_of_bodies import fetch, gather, gather_four, planes, scatter, scatter_four

__all__ = [
    "WIDTH",
    "address",
    "aligned",
    "choose",
    "fetch",
    "gather",
    "gather_four",
    "larger",
    "load",
    "planes",
    "root",
    "scatter",
    "scatter_four",
    "smaller",
    "some",
    "spread",
    "store",
    "which",
    "whole",
]


def aligned(*shape: int) -> Floats:
    """Return zeros of a shape that begin where a line of the cache does: no row of eight lies across two."""
    count = prod(shape)
    room = np.zeros(count + 8)
    skip = -room.ctypes.data // room.itemsize % 8
    return room[skip : skip + count].reshape(shape)
