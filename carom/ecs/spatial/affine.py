"""4x4 matrices that place things: translation, rotation, scale and shear, for column vectors, over leading axes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion, vector
from carom.ecs.spatial.checks import refuse, refuse_unless_rotation, shaped
from carom.ecs.spatial.constants import IDENTITY_MATRIX, ONE, ZERO
from carom.ecs.spatial.matrix import AXES, determinant, product


class Parts(NamedTuple):
    """What an affine matrix does, in the order scale, shear, rotation, translation."""

    translation: Floats  # (..., 3), in the unit of the points
    rotation: Floats  # (..., 4), quaternion xyzw
    scale: Floats  # (..., 3), factors along x, y, z
    shear: Floats  # (..., 3), xy, xz, yz as in ``shear``


def translation(offset: npt.ArrayLike) -> Floats:
    """Return the matrices (..., 4, 4) that move points by ``offset`` (..., 3), in their unit."""
    return _joined(np.eye(3), shaped(offset, (3,), "an offset"))


def rotation(q: npt.ArrayLike) -> Floats:
    """Return the matrices (..., 4, 4) of rotations, unit quaternions xyzw (..., 4), about the origin."""
    return _joined(quaternion.matrix(shaped(q, (4,), "a quaternion")), ZERO)


def scale(factors: npt.ArrayLike) -> Floats:
    """Return the matrices (..., 4, 4) that stretch by ``factors`` (..., 3) along x, y and z; negative ones mirror."""
    return _joined(np.eye(3) * shaped(factors, (3,), "factors of scale")[..., None, :], ZERO)


def shear(
    *,
    xy: npt.ArrayLike = 0.0,
    xz: npt.ArrayLike = 0.0,
    yx: npt.ArrayLike = 0.0,
    yz: npt.ArrayLike = 0.0,
    zx: npt.ArrayLike = 0.0,
    zy: npt.ArrayLike = 0.0,
) -> Floats:
    """Return the matrices (..., 4, 4) that push points along one axis by a factor (...) of another coordinate.

    ``xy`` pushes along x with y: x becomes x + xy y + xz z, and so on for y and z.
    """
    factors = np.broadcast_arrays(*(np.asarray(factor, np.float64) for factor in (xy, xz, yx, yz, zx, zy)))
    found = np.broadcast_to(IDENTITY_MATRIX, (*factors[0].shape, 4, 4)).copy()
    for (row, column), factor in zip(((0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)), factors, strict=True):
        found[..., row, column] = factor
    return found


def compose(
    translation: npt.ArrayLike = ZERO,
    rotation: npt.ArrayLike = quaternion.IDENTITY,
    scale: npt.ArrayLike = ONE,
    shear: npt.ArrayLike = ZERO,
) -> Floats:
    """Return the matrices (..., 4, 4) that scale, then shear, then rotate, then translate: T R H S.

    Shapes are those of ``Parts``. With the columns ``Transform.position`` and ``Transform.rotation`` alone this is
    ``world_from_body``.
    """
    shear, scale = shaped(shear, (3,), "factors of shear"), shaped(scale, (3,), "factors of scale")
    leaned = np.broadcast_to(np.eye(3), (*shear.shape[:-1], 3, 3)).copy()
    leaned[..., 0, 1], leaned[..., 0, 2], leaned[..., 1, 2] = (shear[..., k] for k in range(3))
    turned = product(quaternion.matrix(shaped(rotation, (4,), "a quaternion")), leaned * scale[..., None, :])
    return _joined(turned, shaped(translation, (3,), "a translation"))


def decompose(m: npt.ArrayLike) -> Parts:
    """Return what ``compose`` takes to make affine matrices (..., 4, 4) again.

    Gram and Schmidt's procedure on the columns (Thomas, Decomposing a matrix into simple transformations, Graphics Gems
    II, 1991, section VII.1); a mirror shows as a negative scale along x. A matrix that flattens space, or whose last
    row is not 0 0 0 1, is a GeometryError.
    """
    m = _affine(m)
    mirrors = np.where(determinant(m) < 0.0, -1.0, 1.0)[..., None]
    x, y, z = (m[..., :3, k] for k in range(3))
    flat = "a matrix flattens space: its columns lie in one plane"
    width = vector.length(x)
    refuse(width == 0.0, flat)
    right = vector.normalise(x) * mirrors
    xy = vector.dot(right, y)
    y = y - right * xy[..., None]
    height = vector.length(y)
    refuse(height == 0.0, flat)
    up = y / height[..., None]
    xz, yz = vector.dot(right, z), vector.dot(up, z)
    z = z - right * xz[..., None] - up * yz[..., None]
    depth = vector.length(z)
    refuse(depth == 0.0, flat)
    axes = np.stack([right, up, z / depth[..., None]], axis=-1)
    factors = np.stack([width * mirrors[..., 0], height, depth], axis=-1)
    lean = np.stack([xy / height, xz / depth, yz / depth], axis=-1)
    return Parts(m[..., :3, 3].copy(), quaternion.from_matrix(axes), factors, lean)


def inverse_rigid(m: npt.ArrayLike) -> Floats:
    """Return the inverses (..., 4, 4) of matrices (..., 4, 4) that only turn and move: the turn back, then the way.

    No determinant is divided by, so no digit is lost. A matrix that scales, shears, mirrors or projects is a
    GeometryError; ``matrix.inverse`` takes it.
    """
    m = _affine(m)
    turn = m[..., :3, :3]
    refuse_unless_rotation(turn, "a matrix")
    back = np.swapaxes(turn, -1, -2)
    return _joined(back, -product(back, m[..., :3, 3:])[..., 0])


def _affine(m: npt.ArrayLike) -> Floats:
    m = shaped(m, AXES, "a matrix")
    refuse((m[..., 3, :] != IDENTITY_MATRIX[3]).any(axis=-1), "a matrix is not affine: its last row is not 0 0 0 1")
    return m


def _joined(linear: Floats, offset: Floats) -> Floats:
    """Return matrices (..., 4, 4) of their upper left (..., 3, 3) and their translations (..., 3)."""
    found = np.zeros((*np.broadcast_shapes(linear.shape[:-2], offset.shape[:-1]), 4, 4))
    found[..., :3, :3], found[..., :3, 3], found[..., 3, 3] = linear, offset, 1.0
    return found
