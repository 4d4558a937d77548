"""Where a line first meets the triangles of a mesh, in the frame of the mesh.

The test is watertight: a line between two triangles meets one of them (Woop, Benthin and Wald, Watertight Ray/Triangle
Intersection, JCGT 2 (1), 2013).
"""

from __future__ import annotations

from math import copysign

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ON_SURFACE
from carom.systems.kernels.eights import FIRST_BLOCK, LOWEST, look_into, push_seen
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.lanes import choose, larger, load, smaller, spread, store, which
from carom.systems.kernels.ray_solids import FAR

STEEPEST = 1e-290  # of a direction along an axis; one over it is still a number


@inlined
def one_over(d):
    """Return 1 / d, and a number as large as can be multiplied where that is none."""
    return 1.0 / d if abs(d) > STEEPEST else copysign(1.0 / STEEPEST, d)


@inlined
def order_of_axes(dx, dy, dz):
    """Return the axes, that along which a direction is longest last, wound so that it points along it."""
    if abs(dz) >= abs(dx) and abs(dz) >= abs(dy):
        return (0, 1, 2) if dz > 0.0 else (1, 0, 2)
    if abs(dy) >= abs(dx):
        return (2, 0, 1) if dy > 0.0 else (0, 2, 1)
    return (1, 2, 0) if dx > 0.0 else (2, 1, 0)


@woven
def first_triangle(
    node, boxes, inside, blocks, corners, x, y, z, dx, dy, dz, start, limit, fronts_only, stack, ahead, seen, lanes
):  # fmt: skip
    """Return (s, triangle, whether it is its back) of the first one from ``start`` to ``limit`` along the line.

    It is -1 where there is none. Backs count from ON_SURFACE beyond the start on, fronts from as much before it, and
    fronts alone if so asked. ``node`` is the root of a tree of eights; ``seen`` are two lanes, at address ``lanes``.
    """
    ix, iy, iz = one_over(dx), one_over(dy), one_over(dz)
    i, j, k = order_of_axes(dx, dy, dz)
    steep = dz if k == 2 else dy if k == 1 else dx
    along_i = (dz if i == 2 else dy if i == 1 else dx) / steep
    along_j = (dz if j == 2 else dy if j == 1 else dx) / steep
    oi = z if i == 2 else y if i == 1 else x
    oj = z if j == 2 else y if j == 1 else x
    ok = z if k == 2 else y if k == 1 else x
    nearest, best, back = limit, -1, False
    stack[0], ahead[0], waiting = node, start, 1
    one, zero = spread(1.0), spread(0.0)
    while waiting > 0:
        waiting -= 1
        if ahead[waiting] > nearest + ON_SURFACE:
            continue
        at = stack[waiting]
        if at >= 0:
            bits = look_into(boxes, 6 * at, x, y, z, ix, iy, iz, start, nearest, lanes)
            waiting = push_seen(inside, at, bits, seen, stack, ahead, waiting)
            continue
        block = FIRST_BLOCK - at
        a = 9 * block
        b, c = a + 3, a + 6
        az, bz, cz = load(corners, a + k) - ok, load(corners, b + k) - ok, load(corners, c + k) - ok
        ax, ay = load(corners, a + i) - oi - along_i * az, load(corners, a + j) - oj - along_j * az
        bx, by = load(corners, b + i) - oi - along_i * bz, load(corners, b + j) - oj - along_j * bz
        cx, cy = load(corners, c + i) - oi - along_i * cz, load(corners, c + j) - oj - along_j * cz
        of_a, of_b, of_c = cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax
        whole = of_a + of_b + of_c  # positive where its front is seen
        outside = smaller(-smaller(of_a, smaller(of_b, of_c)), larger(of_a, larger(of_b, of_c)))
        outside = choose(larger(whole, -whole), outside, one)
        if fronts_only:
            outside = larger(outside, -whole)
        s = (of_a * az + of_b * bz + of_c * cz) / choose(larger(whole, -whole), whole * steep, one)
        early = choose(whole, start - ON_SURFACE - s, start + ON_SURFACE - s)
        bits = which(choose(larger(outside, larger(early, s - nearest)), zero, one))
        if bits == 0:
            continue
        store(lanes, 0, s)
        store(lanes, 1, whole)
        while bits > 0:
            lane = LOWEST[bits]
            bits &= bits - 1
            if seen[0, lane] < nearest or best < 0:
                nearest, best, back = seen[0, lane], blocks[block, 0] + lane, seen[1, lane] < 0.0
    return (nearest, best, back) if best >= 0 else (FAR, -1, False)
