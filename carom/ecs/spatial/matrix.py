"""Matrices over leading axes, 4x4 where nothing else is said, read for column vectors: M v, and A B is B before A.

Sums are written out, as the order in which BLAS adds differs between machines. ``affine`` makes matrices that place
things, ``projection`` those of cameras.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial.checks import GeometryError, refuse, shaped
from carom.ecs.spatial.constants import LEFT_FROM_RIGHT

AXES = (4, 4)


def product(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return the products (..., m, p) of matrices (..., m, n) and (..., n, p) of any size.

    Other sizes are a GeometryError: the columns of the first are paired with the rows of the second.
    """
    a, b = np.asarray(a, np.float64), np.asarray(b, np.float64)
    if min(a.ndim, b.ndim) < 2 or a.shape[-1] != b.shape[-2]:
        accepted = "(..., m, n) and (..., n, p)"
        raise GeometryError(f"matrices have shapes {a.shape} and {b.shape}; accepted: {accepted}")
    found: Floats = a[..., :, :1] * b[..., :1, :]
    for k in range(1, a.shape[-1]):
        found = found + a[..., :, k, None] * b[..., k, None, :]
    return found


def transpose(m: npt.ArrayLike) -> Floats:
    """Return matrices (..., n, m) of (..., m, n) with rows and columns exchanged: the other reading of vectors.

    Texts and libraries that write vectors as rows (DirectX, XNA) put v M where carom puts M v; their matrix is the
    transpose of ours, has its translation in the last row, and A B is there A before B.
    """
    m = np.asarray(m, np.float64)
    if m.ndim < 2:
        raise GeometryError(f"a matrix has shape {m.shape}; accepted: (..., m, n)")
    return np.swapaxes(m, -1, -2)


def determinant(m: npt.ArrayLike) -> Floats:
    """Return the determinants (...) of matrices (..., 4, 4): the factor of volumes, negative where it mirrors.

    Laplace's expansion by the 2x2 minors of the upper and the lower two rows (Eberly, The Laplace expansion theorem:
    computing the determinants and inverses of matrices, 2008, section 2).
    """
    upper, lower = _minors(shaped(m, AXES, "a matrix"))
    found: Floats = (
        (upper[0] * lower[5] - upper[1] * lower[4] + upper[2] * lower[3])
        + (upper[3] * lower[2] - upper[4] * lower[1])
        + upper[5] * lower[0]
    )
    return found


def inverse(m: npt.ArrayLike) -> Floats:
    """Return the inverses (..., 4, 4) of matrices (..., 4, 4): the adjugate over the determinant.

    A matrix of determinant 0 has none, which is a GeometryError; of one next to it the digits are lost in proportion.
    Source as in ``determinant``. What only turns and moves is undone better by ``affine.inverse_rigid``.
    """
    m = shaped(m, AXES, "a matrix")
    det = determinant(m)
    refuse(~((np.abs(det) > 0.0) & np.isfinite(det)), "a matrix has no inverse: its determinant is 0 or not finite")
    upper, lower = _minors(m)
    found = np.zeros(m.shape)
    for column, row, minors in ((0, 1, lower), (1, 0, lower), (2, 3, upper), (3, 2, upper)):
        a, b, c, d = (m[..., row, k] for k in range(4))
        sign = 1.0 if column % 2 == 0 else -1.0
        found[..., 0, column] = sign * (b * minors[5] - c * minors[4] + d * minors[3])
        found[..., 1, column] = -sign * (a * minors[5] - c * minors[2] + d * minors[1])
        found[..., 2, column] = sign * (a * minors[4] - b * minors[2] + d * minors[0])
        found[..., 3, column] = -sign * (a * minors[3] - b * minors[1] + c * minors[0])
    return found / det[..., None, None]


def transform_points(m: npt.ArrayLike, points: npt.ArrayLike) -> Floats:
    """Return points (..., 3) taken through matrices (..., 4, 4), as (x, y, z, 1) and then over their new w.

    The division does nothing but after a perspective. A point in the plane of the eye (w = 0) is a GeometryError.
    """
    m, points = shaped(m, AXES, "a matrix"), shaped(points, (3,), "a point")
    weight = _rows_times(m[..., 3:, :3], points) + m[..., 3:, 3]
    refuse(weight[..., 0] == 0.0, "a point has no image: it lies in the plane of the eye")
    found: Floats = (_rows_times(m[..., :3, :3], points) + m[..., :3, 3]) / weight
    return found


def transform_directions(m: npt.ArrayLike, directions: npt.ArrayLike) -> Floats:
    """Return directions (..., 3) taken through matrices (..., 4, 4), as (x, y, z, 0): translation does nothing.

    Lengths change with the matrix's scale. Normals of a surface are directions only where nothing but turns and equal
    scales act on it.
    """
    m, directions = shaped(m, AXES, "a matrix"), shaped(directions, (3,), "a direction")
    return _rows_times(m[..., :3, :3], directions)


def change_handedness(m: npt.ArrayLike) -> Floats:
    """Return what transforms (..., 4, 4) of a right-handed frame are in the left-handed one with +z forward, or back.

    F M F with F = diag(1, 1, -1, 1) = ``constants.LEFT_FROM_RIGHT``: out of the mirror, through, and back into it. The
    determinant stays; that of F alone is -1. A projection has the frame on one side only: ``product(P, F)``.
    """
    sign = np.diagonal(LEFT_FROM_RIGHT)
    changed: Floats = sign[:, None] * shaped(m, AXES, "a matrix") * sign
    return changed


def _rows_times(rows: Floats, v: Floats) -> Floats:
    """Return the scalar products (..., n) of rows (..., n, 3) and vectors (..., 3)."""
    x, y, z = (v[..., k, None] for k in range(3))
    found: Floats = rows[..., 0] * x + rows[..., 1] * y + rows[..., 2] * z
    return found


def _minors(m: Floats) -> tuple[list[Floats], list[Floats]]:
    """Return the 2x2 minors of the upper and of the lower two rows, by columns 01, 02, 03, 12, 13, 23."""
    pairs = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
    upper, lower = (
        [m[..., r, i] * m[..., r + 1, j] - m[..., r + 1, i] * m[..., r, j] for i, j in pairs] for r in (0, 2)
    )
    return upper, lower
