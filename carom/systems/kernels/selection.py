"""The lower and the higher half of numbered things along an axis, parted in place."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined


@inlined
def widest_axis(order, middle, first, last):
    """Return the axis along which the middles of ``order[first:last]`` spread most."""
    x, y, z = middle[order[first], 0], middle[order[first], 1], middle[order[first], 2]
    lx, ly, lz, hx, hy, hz = x, y, z, x, y, z
    for k in range(first + 1, last):
        x, y, z = middle[order[k], 0], middle[order[k], 1], middle[order[k], 2]
        lx, ly, lz = min(lx, x), min(ly, y), min(lz, z)
        hx, hy, hz = max(hx, x), max(hy, y), max(hz, z)
    wide, high, deep = hx - lx, hy - ly, hz - lz
    if wide >= high and wide >= deep:
        return 0
    return 1 if high >= deep else 2


@inlined
def select(order, middle, axis, first, last, wanted):
    """Reorder ``order[first:last]`` so that none before ``wanted`` has its middle beyond any from there on.

    Hoare's FIND (Communications of the ACM 4, 321, 1961).
    """
    last -= 1
    while first < last:
        pivot = middle[order[(first + last) // 2], axis]
        i, j = first, last
        while i <= j:
            while middle[order[i], axis] < pivot:
                i += 1
            while middle[order[j], axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i, j = i + 1, j - 1
        if wanted <= j:
            last = j
        elif wanted >= i:
            first = i
        else:
            return
