"""Unit quaternions xyzw over leading axes; a rotation takes vectors from the inner to the outer frame.

Functions broadcast their arguments and take only + - * / sqrt and carom's own trigonometry, so that they are equal on
every machine. q and -q are one rotation.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial import vector
from carom.ecs.spatial.angles import arc_tangent, sines_cosines
from carom.ecs.spatial.checks import refuse, refuse_unless_rotation, shaped
from carom.ecs.spatial.constants import BACK, IDENTITY_MATRIX, IDENTITY_ROTATION, RIGHT, UP
from carom.ecs.spatial.euler import axes_of, to_euler

__all__ = [
    "IDENTITY",
    "change_handedness",
    "conjugate",
    "from_axis_angle",
    "from_euler",
    "from_matrix",
    "look_at",
    "matrix",
    "multiply",
    "normalise",
    "rotate",
    "slerp",
    "to_axis_angle",
    "to_euler",
    "unit",
]

IDENTITY = IDENTITY_ROTATION
AXES = (4,)
ROUNDING = 1e-15  # how far from 1 the length of a quaternion may be that has been normalised
PARALLEL = 1e-18  # squared sine below which the direction of a cross product would be rounding


def multiply(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return the rotation b followed by a, shapes (..., 4)."""
    a, b = np.asarray(a, np.float64), np.asarray(b, np.float64)
    ax, ay, az, aw = a[..., 0], a[..., 1], a[..., 2], a[..., 3]
    bx, by, bz, bw = b[..., 0], b[..., 1], b[..., 2], b[..., 3]
    found = np.zeros(np.broadcast_shapes(a.shape, b.shape))
    found[..., 0] = aw * bx + ax * bw + ay * bz - az * by
    found[..., 1] = aw * by - ax * bz + ay * bw + az * bx
    found[..., 2] = aw * bz + ax * by - ay * bx + az * bw
    found[..., 3] = aw * bw - ax * bx - ay * by - az * bz
    return found


def conjugate(q: npt.ArrayLike) -> Floats:
    """Return the inverse rotation, shape (..., 4)."""
    flipped: Floats = np.asarray(q, np.float64) * np.array([-1.0, -1.0, -1.0, 1.0])
    return flipped


def rotate(q: npt.ArrayLike, v: npt.ArrayLike) -> Floats:
    """Return vectors (..., 3) turned by rotations (..., 4): v + 2 u x (u x v + w v) with q = (u, w)."""
    q, v = np.asarray(q, np.float64), np.asarray(v, np.float64)
    qx, qy, qz, qw = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    tx, ty, tz = 2.0 * (qy * z - qz * y), 2.0 * (qz * x - qx * z), 2.0 * (qx * y - qy * x)
    found = np.zeros((*np.broadcast_shapes(q.shape[:-1], v.shape[:-1]), 3))
    found[..., 0] = x + qw * tx + qy * tz - qz * ty
    found[..., 1] = y + qw * ty + qz * tx - qx * tz
    found[..., 2] = z + qw * tz + qx * ty - qy * tx
    return found


def matrix(q: npt.ArrayLike) -> Floats:
    """Return rotation matrices (..., 3, 3) whose columns are the turned axes."""
    q = np.asarray(q, np.float64)
    return np.stack([rotate(q, np.broadcast_to(axis, (*q.shape[:-1], 3))) for axis in np.eye(3)], axis=-1)


def normalise(q: npt.ArrayLike) -> Floats:
    """Return q over its length, shape (..., 4); a zero or infinite q is a GeometryError."""
    q = np.asarray(q, np.float64)
    size = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    refuse(~((size > 0.0) & (size < np.inf))[..., 0], "a quaternion of length 0 or infinity is no rotation")
    unit: Floats = q / size
    return unit


def unit(q: npt.ArrayLike) -> Floats:
    """Return q over its length, shape (..., 4), and as it is where that is 1 but for rounding: twice changes no bit."""
    q, scaled = np.asarray(q, np.float64), normalise(q)
    size = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    return np.where(np.abs(size - 1.0) <= ROUNDING, q, scaled)


def slerp(a: npt.ArrayLike, b: npt.ArrayLike, t: npt.ArrayLike) -> Floats:
    """Return the rotations (..., 4) a fraction t (...) of the shorter way from a to b, at constant angular speed.

    a at 0; b at 1, or -b, which is the same rotation, where -b is the nearer. Half a turn apart both ways are equally
    short, and the way is the one towards b as it is given. Outside of 0..1 the turning goes on. Source: Shoemake,
    Animating rotation with quaternion curves, SIGGRAPH 1985, section 3.3; the angle is Kahan's, see ``vector.angle``.
    """
    a, b = shaped(a, AXES, "a quaternion"), shaped(b, AXES, "a quaternion")
    t = np.asarray(t, np.float64)[..., None]
    b = np.where((a * b).sum(axis=-1, keepdims=True) < 0.0, -b, b)
    apart, together = (np.sqrt((part * part).sum(axis=-1, keepdims=True)) for part in (a - b, a + b))
    angle = 2.0 * arc_tangent(apart, together)
    (whole, _), (before, _), (after, _) = (sines_cosines(share * angle) for share in (1.0, 1.0 - t, t))
    same = whole == 0.0
    divisor = np.where(same, 1.0, whole)
    between: Floats = np.where(same, 1.0 - t, before / divisor) * a + np.where(same, t, after / divisor) * b
    return between


def from_axis_angle(axis: npt.ArrayLike, angle: npt.ArrayLike) -> Floats:
    """Return the rotations (..., 4) by ``angle`` (...) in rad about ``axis`` (..., 3), by the right-hand rule.

    The axis may have any length but 0 (GeometryError).
    """
    return _turn(vector.normalise(axis), np.asarray(angle, np.float64))


def to_axis_angle(q: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Return unit axes (..., 3) and angles (...) in rad, 0..pi, of rotations (..., 4) of any length but 0.

    Where nothing turns every axis is right, and +x is given.
    """
    q = shaped(q, AXES, "a quaternion")
    refuse(~q.any(axis=-1), "a zero quaternion is no rotation")
    q = np.where(q[..., 3:] < 0.0, -q, q)
    angle = 2.0 * arc_tangent(vector.length(q[..., :3]), q[..., 3])
    return vector.normalise(q[..., :3], otherwise=RIGHT), angle


def from_euler(angles: npt.ArrayLike, order: str) -> Floats:
    """Return rotations (..., 4) by angles (..., n) in rad about the n axes of ``order`` one after another.

    XYZ about turning axes, xyz about fixed ones; another order, or another number of angles, is a GeometryError.
    """
    axes = axes_of(order)
    angles = shaped(angles, (len(axes),), f"angles in the order '{order}'")
    total = IDENTITY
    for k, axis in enumerate(axes):
        turn = _turn(IDENTITY_MATRIX[axis, :3], angles[..., k])
        total = multiply(total, turn) if order.isupper() else multiply(turn, total)
    return total


def from_matrix(m: npt.ArrayLike) -> Floats:
    """Return the rotations (..., 4) of matrices (..., 3, 3) whose columns are the turned axes.

    Columns that are not orthonormal within 1e-3, or left-handed, are a GeometryError. Of the four ways to take q from
    m, each matrix goes the one that divides by the largest part (Shepperd, Quaternion from rotation matrix, Journal of
    Guidance and Control 1, 223, 1978).
    """
    m = shaped(m, (3, 3), "a rotation matrix")
    refuse_unless_rotation(m, "a matrix")
    return _from_axes(m)


def look_at(direction: npt.ArrayLike, up: npt.ArrayLike = UP) -> Floats:
    """Return the rotations (..., 4) that turn forward (-z) to ``direction`` (..., 3), y as near ``up`` (..., 3) as can.

    A zero direction is a GeometryError. An ``up`` that is zero or along the direction says nothing; then +z takes its
    place, or +x where the direction is near z.
    """
    back = vector.normalise(-np.asarray(direction, np.float64))
    up = shaped(up, vector.AXES, "up")
    right = vector.cross(up, back)
    level = vector.dot(right, right) > PARALLEL * vector.dot(up, up)
    instead = np.where(np.abs(back[..., 2:]) < 0.9, BACK, RIGHT)
    right = vector.normalise(np.where(level[..., None], right, vector.cross(instead, back)))
    back = np.broadcast_to(back, right.shape)
    return _from_axes(np.stack([right, vector.cross(back, right), back], axis=-1))


def change_handedness(q: npt.ArrayLike) -> Floats:
    """Return rotations (..., 4) of a right-handed frame in the left-handed one with +z forward, or back.

    A mirror keeps the part of a turning axis across itself and turns the parts along it round, against what it does to
    a direction: x and y change their signs.
    """
    changed: Floats = shaped(q, AXES, "a quaternion") * np.array([-1.0, -1.0, 1.0, 1.0])
    return changed


def _turn(axis: Floats, angle: Floats) -> Floats:
    """Return the rotations (..., 4) by angles (...) about unit axes (..., 3)."""
    sine, cosine = sines_cosines(angle / 2.0)
    found = np.zeros((*np.broadcast_shapes(axis.shape[:-1], angle.shape), 4))
    found[..., :3], found[..., 3] = axis * sine[..., None], cosine
    return found


def _from_axes(m: Floats) -> Floats:
    """Return the rotations (..., 4) of matrices (..., 3, 3) known to be rotations."""
    trace = m[..., 0, 0] + m[..., 1, 1] + m[..., 2, 2]
    ways = np.zeros((*m.shape[:-2], 4, 4))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        ways[..., k, k] = 1.0 + m[..., k, k] - m[..., i, i] - m[..., j, j]
        ways[..., k, i], ways[..., k, j] = m[..., i, k] + m[..., k, i], m[..., j, k] + m[..., k, j]
        ways[..., k, 3] = ways[..., 3, k] = m[..., j, i] - m[..., i, j]
    ways[..., 3, 3] = 1.0 + trace
    sizes = np.stack([m[..., 0, 0], m[..., 1, 1], m[..., 2, 2], trace], axis=-1)
    best = np.argmax(sizes, axis=-1)[..., None, None]
    return normalise(np.take_along_axis(ways, best, axis=-2)[..., 0, :])
