"""Mass properties of the solid inside a closed surface, by + - * / and sqrt alone: equal on every machine.

LAPACK and BLAS, which numpy.linalg and trimesh call, choose other code by CPU.
"""

from __future__ import annotations

import math

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.constants import JACOBI_SWEEPS
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.shape import MassProperties


def solid_properties(geometry: Geometry) -> MassProperties:
    """Return volume, centre of mass and principal moments of the enclosed solid at density 1.

    Each face spans a tetrahedron with the middle of the vertices: det / 6 is its volume, and its second moment is
    det / 120 times the sum of v v^T over its three corners and over their sum (Tonon, J. Math. Stat. 1, 8, 2005).
    """
    middle = (geometry.vertices.min(axis=0) + geometry.vertices.max(axis=0)) / 2.0
    a, b, c = ((geometry.vertices - middle)[geometry.faces[:, k]] for k in range(3))
    across, corners = np.cross(b, c), a + b + c
    det = a[:, 0] * across[:, 0] + a[:, 1] * across[:, 1] + a[:, 2] * across[:, 2]
    volume = math.fsum(det) / 6.0
    center = [math.fsum(det * corners[:, i]) / 24.0 / volume for i in range(3)]
    second = [[0.0] * 3 for _ in range(3)]
    for i in range(3):
        for j in range(3):
            products = sum(v[:, i] * v[:, j] for v in (a, b, c, corners))
            second[i][j] = math.fsum(det * products) / 120.0 / volume - center[i] * center[j]
    trace = second[0][0] + second[1][1] + second[2][2]
    inertia = [[(trace if i == j else 0.0) - second[i][j] for j in range(3)] for i in range(3)]
    moments, axes = principal(inertia)
    x, y, z = (float(m + c) for m, c in zip(middle, center, strict=True))
    turned = quaternion.from_matrix(axes)
    return MassProperties(volume, (x, y, z), moments, tuple(map(float, turned)))  # type: ignore[arg-type]


def principal(matrix: list[list[float]]) -> tuple[tuple[float, float, float], Floats]:
    """Return a symmetric matrix's eigenvalues and a rotation with their axes as columns (Jacobi, 1846).

    Each turn is at most an eighth, so that axes stay near those they come from and a diagonal matrix keeps its order:
    the hull of a box's corners turns as the box does, to the last step of the integrator.
    """
    m = [row[:] for row in matrix]
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]  # rows
    for _ in range(JACOBI_SWEEPS):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if m[p][q] == 0.0:
                continue
            slope = (m[q][q] - m[p][p]) / (2.0 * m[p][q])
            t = (1.0 if slope >= 0.0 else -1.0) / (abs(slope) + math.sqrt(slope * slope + 1.0))
            cosine = 1.0 / math.sqrt(t * t + 1.0)
            sine = t * cosine
            for k in range(3):
                m[k][p], m[k][q] = cosine * m[k][p] - sine * m[k][q], sine * m[k][p] + cosine * m[k][q]
            for k in range(3):
                m[p][k], m[q][k] = cosine * m[p][k] - sine * m[q][k], sine * m[p][k] + cosine * m[q][k]
                axes[p][k], axes[q][k] = (
                    cosine * axes[p][k] - sine * axes[q][k],
                    sine * axes[p][k] + cosine * axes[q][k],
                )
            m[p][q] = m[q][p] = 0.0
    return (m[0][0], m[1][1], m[2][2]), np.array(axes).T
