"""Orders of Euler angles, and the angles of a rotation in each; ``quaternion.from_euler`` goes the other way."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial.angles import arc_tangent
from carom.ecs.spatial.checks import GeometryError, refuse, shaped

LOCKED = 1e-9  # rad from the lock within which the two outer angles would be made of rounding


def axes_of(order: str) -> list[int]:
    """Return the axes an order names, x = 0; a mix of cases or another letter is a GeometryError."""
    if not order or not set(order.lower()) <= set("xyz") or not (order.isupper() or order.islower()):
        accepted = "X, Y, Z for the turning axes, or x, y, z for fixed ones"
        raise GeometryError(f"'{order}' is no order of axes; accepted: {accepted}")
    return ["xyz".index(letter) for letter in order.lower()]


def to_euler(q: npt.ArrayLike, order: str) -> Floats:
    """Return the angles (..., 3) in rad of rotations (..., 4), about the axes of ``order`` one after another.

    XYZ turns about the turning axes, xyz about fixed ones; the first and third axis may be the same (ZXZ). The outer
    angles are within -pi..pi, the middle one within -pi/2..pi/2 of three different axes and 0..pi of two.

    At the gimbal lock (the middle angle at an end of its range) the outer two turn about one line and only their sum or
    difference is known: the third is 0 there and the first takes all of it, so that the angles still are the rotation.

    An order that names no three axes, or the same one twice running, and a zero quaternion are GeometryErrors. Source:
    Bernardes and Viollet, Quaternion to Euler angles conversion: a direct, general and computationally efficient
    method, PLoS ONE 17, e0276302 (2022), algorithm 1.
    """
    q = shaped(q, (4,), "a quaternion")
    refuse(~q.any(axis=-1), "a zero quaternion is no rotation")
    axes = axes_of(order)
    if len(axes) != 3 or axes[0] == axes[1] or axes[1] == axes[2]:
        raise GeometryError(f"'{order}' leaves angles open; accepted: three axes, no two neighbours alike")
    fixed = order.islower()
    i, j, k = axes if fixed else axes[::-1]
    proper = i == k  # Euler's own: two axes, and the paper's formulas as they stand
    if proper:
        k = 3 - i - j
    sign = (i - j) * (j - k) * (k - i) / 2.0
    a, b, c, d = q[..., 3], q[..., i], q[..., j], q[..., k] * sign
    if not proper:
        a, b, c, d = a - c, b + d, c + a, d - b
    middle = 2.0 * arc_tangent(np.sqrt(c * c + d * d), np.sqrt(a * a + b * b))
    half_sum, half_difference = arc_tangent(b, a), arc_tangent(d, c)
    low, high = middle <= LOCKED, middle >= math.pi - LOCKED
    last = half_sum + half_difference if fixed else half_sum - half_difference
    first = half_sum - half_difference if fixed else half_sum + half_difference
    first = np.where(low, 2.0 * half_sum, np.where(high, 2.0 * half_difference * (-1.0 if fixed else 1.0), first))
    last = np.where(low | high, 0.0, last)
    if not proper:
        middle = middle - 0.5 * math.pi
        first, last = (first, sign * last) if fixed else (sign * first, last)
    return np.stack([_within_half_turn(first), middle, _within_half_turn(last)], axis=-1)


def _within_half_turn(angle: Floats) -> Floats:
    """Return angles of at most a turn and a half within -pi..pi."""
    return np.where(angle > math.pi, angle - 2.0 * math.pi, np.where(angle < -math.pi, angle + 2.0 * math.pi, angle))
