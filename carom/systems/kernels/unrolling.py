"""Unrolling: what is round touches with another part of itself as it rolls, but beneath itself as before."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ON_END
from carom.systems.kernels.blow_points import is_smooth
from carom.systems.kernels.cores import ELLIPSOID, ELLIPSOID_SHAPE, farthest_of_round
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.polyhedra import CAPSULE_SHAPE
from carom.systems.kernels.spatial import product, turn


@woven
def rolls(i, shape):
    """Tell whether a collider is round, and no ball."""
    return shape[i] == CAPSULE_SHAPE or is_smooth(i, shape)


@woven
def roll_back(q, i, first, end, outward, shape, size, of_other, lean_of_other, both, normal, seat, lean):
    """Return the rotation by which contacts ``first`` to ``end`` of a collider that rolls are beneath it; seat them so.

    They face the normal that the other has, or where both roll the one that they had. Those of an ellipsoid, whose
    normal goes ``outward`` (1) or inward (-1), are seated anew; all others are turned about the axis of the shape.
    """
    if shape[i] != ELLIPSOID_SHAPE:
        return unrolled(q, first, lean, faced(first, of_other, lean_of_other, both, normal))
    for c in range(first, end):
        seat_ellipsoid(q, i, c, outward, size, faced(c, of_other, lean_of_other, both, normal), seat, lean)
    return q


@woven
def faced(c, q, lean, both, normal):
    """Return the normal of contact c as the other collider has it, turned by q; where both roll, as it was."""
    if both:
        return normal[c, 0], normal[c, 1], normal[c, 2]
    return turn(q[0], q[1], q[2], q[3], lean[c, 0], lean[c, 1], lean[c, 2])


@woven
def unrolled(q, c, lean, n):
    """Return the rotation of what is round about its axis, turned about that until the normal it had meets one now.

    That is where contact c had it in its frame, ``lean``, and n in the world. It stays as it is where either is along
    the axis (ON_END).
    """
    qx, qy, qz, qw = q
    mx, _, mz = turn(-qx, -qy, -qz, qw, n[0], n[1], n[2])
    lx, lz = lean[c, 0], lean[c, 2]
    before, now = lx * lx + lz * lz, mx * mx + mz * mz
    if min(before, now) < ON_END * ON_END:
        return qx, qy, qz, qw
    scale = 1.0 / sqrt(before * now)
    cosine, sine = scale * (lx * mx + lz * mz), scale * (lz * mx - lx * mz)
    larger = sqrt(0.5 * (1.0 + abs(cosine)))  # of the sine and cosine of half the angle, which has no sign of its own
    smaller = 0.5 * sine / larger
    if cosine < 0.0:
        larger, smaller = smaller, larger
    return product(qx, qy, qz, qw, 0.0, smaller, 0.0, larger)


@woven
def seat_ellipsoid(q, i, c, outward, size, n, seat, lean):
    """Seat contact c of an ellipsoid where it faces n (in the world), ``outward`` (1) or inward (-1)."""
    x, y, z = turn(-q[0], -q[1], -q[2], q[3], n[0], n[1], n[2])
    lean[c, 0], lean[c, 1], lean[c, 2] = x, y, z
    x, y, z = farthest_of_round(ELLIPSOID, size[i, 0], size[i, 1], size[i, 2], x, y, z)
    seat[c, 0], seat[c, 1], seat[c, 2] = outward * x, outward * y, outward * z
