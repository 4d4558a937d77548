"""Unit quaternions xyzw over leading axes; a rotation takes vectors from the inner to the outer frame."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial.trigonometry import sine_cosine

IDENTITY: Floats = np.array([0.0, 0.0, 0.0, 1.0])


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
    """Return q over its length, shape (..., 4)."""
    q = np.asarray(q, np.float64)
    unit: Floats = q / np.sqrt((q * q).sum(axis=-1, keepdims=True))
    return unit


def from_axis_angle(axis: npt.ArrayLike, angle: float) -> Floats:
    """Return the rotation by ``angle`` (rad) about ``axis`` (3,) of any length but 0."""
    axis = np.asarray(axis, np.float64)
    sine, cosine = sine_cosine(angle / 2.0)
    return np.array([*(axis / np.sqrt((axis * axis).sum()) * sine), cosine])


def from_euler(angles: npt.ArrayLike, order: str) -> Floats:
    """Return rotations about the axes of ``order`` one after another: XYZ about turning axes, xyz about fixed ones."""
    turns = [
        from_axis_angle(np.eye(3)["xyz".index(o.lower())], float(a))
        for o, a in zip(order, np.asarray(angles), strict=True)
    ]
    total = IDENTITY
    for turn in turns:
        total = multiply(total, turn) if order.isupper() else multiply(turn, total)
    return total


def from_matrix(m: npt.ArrayLike) -> Floats:
    """Return the rotation of a matrix (3, 3) with orthonormal columns (Shepperd, 1978)."""
    m = np.asarray(m, np.float64)
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    k = int(np.argmax([m[0, 0], m[1, 1], m[2, 2], trace]))
    if k == 3:
        q = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1.0 + trace])
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q = np.zeros(4)
        q[k] = 1.0 + m[k, k] - m[i, i] - m[j, j]
        q[i], q[j], q[3] = m[i, k] + m[k, i], m[j, k] + m[k, j], m[j, i] - m[i, j]
    return normalise(q)


def look_at(direction: npt.ArrayLike, up: npt.ArrayLike = (0.0, 1.0, 0.0)) -> Floats:
    """Return the rotation that turns forward (-z) to ``direction`` and keeps y as near ``up`` as it can."""
    back = -np.asarray(direction, np.float64)
    back = back / np.sqrt((back * back).sum())
    right = np.cross(np.asarray(up, np.float64), back)
    if (right * right).sum() < 1e-18:
        right = np.cross((0.0, 0.0, 1.0), back) if abs(back[2]) < 0.9 else np.cross((1.0, 0.0, 0.0), back)
    right = right / np.sqrt((right * right).sum())
    return from_matrix(np.stack([right, np.cross(back, right), back], axis=1))
