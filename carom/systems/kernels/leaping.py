"""Leaping: sweeps over the points of a blow that converge slowly go on at once to where they lead.

That is Aitken's extrapolation, of vectors: see Macleod, Acceleration of vector sequences, Communications in Applied
Numerical Methods 2, 385, 1986. Points that are redundant, or slide and press by turns, need it: without it 200 sweeps
leave a thousandth of the speed in a fifth of the blows in a wall of boxes that is struck.
"""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.point_coupling import part_points


@inlined
def times_of_way(given, start, way):
    """Return how many times the way of a sweep leads from impulses (n, 4) where it ended to where all sweeps lead.

    0 where that cannot be told from it and the ``way`` of the sweep before; no farther than the impulses are large, as
    what all but stays the same says little. Note where it ended (``start``) and its way.
    """
    both, before, now, size = 0.0, 0.0, 0.0, 0.0
    for m in range(len(given)):
        for k in range(4):
            change = given[m, k] - start[m, k]
            both, before = both + change * way[m, k], before + way[m, k] * way[m, k]
            now, size = now + change * change, size + given[m, k] * given[m, k]
            way[m, k], start[m, k] = change, given[m, k]
    if not (-before < both < before):  # longer than the one before, or there was none
        return 0.0
    return min(both / (before - both), sqrt(size / now) if now > 0.0 else 0.0)


@inlined
def leap(times, nx, ny, nz, friction, least, ease, way, coupling, given, start, slips):
    """Go on by so many ``times`` the way of the last sweep, to where sweeps lead that get shorter by one ratio.

    No point that touches (``ease``) pulls by that, nor rubs more than its cone allows. ``slips`` (n, 3) are how fast
    points then part, and ``start`` where the next sweep begins.
    """
    for m in range(len(given)):
        if ease[m] > 0.0:
            for k in range(4):
                given[m, k] += times * way[m, k]
            given[m, 0] = max(least[m], given[m, 0])
            squared, most = given[m, 1] ** 2 + given[m, 2] ** 2 + given[m, 3] ** 2, friction * given[m, 0]
            share = most / sqrt(squared) if squared > most * most else 1.0
            for k in range(1, 4):
                given[m, k] *= share
            j = given[m, 0] - start[m, 0]
            part_points(
                m, j * nx + given[m, 1] - start[m, 1], j * ny + given[m, 2] - start[m, 2],
                j * nz + given[m, 3] - start[m, 3], coupling, slips,
            )  # fmt: skip
            for k in range(4):
                start[m, k] = given[m, k]
