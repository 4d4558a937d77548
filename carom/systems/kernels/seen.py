"""Seen: how fast one of a pair moves as the other sees it, which turns: what goes round with a drum hardly does."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import GLIDING, TOLD
from carom.systems.kernels.bodies import length_of
from carom.systems.kernels.fast_pairs import between, motion_of
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.spatial import cross
from carom.systems.kernels.swinging import REACH


@inlined
def speeds_seen(p, i, o, side, span, pull, numbers, center, linear, angular, other_linear, other_angular):
    """Return how fast any point of body i, on a ``side`` of pair p, may come to any of o as o sees it.

    That is within ``span`` (s), in which forces may hasten it by a ``pull``. And how fast trust in contacts goes, which
    stay on their faces while it glides: their normals and points go straight on meanwhile instead of round with o, so
    that they may be off by what both turn aside, of which they bear a part (TOLD).
    """
    way, wx, wy, wz = motion_of(i, o, center, linear, angular, other_linear, other_angular)
    own, other = length_of(i, angular), length_of(o, other_angular)
    gliding = way + pull + drift_seen(i, o, span, pull, linear, other_linear, other)
    swing = sqrt(wx * wx + wy * wy + wz * wz) * numbers[p, REACH + side]
    aside = own * own * numbers[p, REACH + side] + other * other * numbers[p, REACH + 1 - side]
    aside = span * (0.5 * aside + other * way)
    return gliding + swing, GLIDING * gliding + swing + aside / TOLD


@inlined
def closing_seen(p, i, o, side, span, pull, nx, ny, nz, numbers, center, linear, angular):
    """Return how fast any point of body i may go along n, as o sees it, with which n turns."""
    x, y, z = center[i, 0] - center[o, 0], center[i, 1] - center[o, 1], center[i, 2] - center[o, 2]
    x, y, z = cross(angular[o, 0], angular[o, 1], angular[o, 2], x, y, z)
    x, y, z = linear[i, 0] - linear[o, 0] - x, linear[i, 1] - linear[o, 1] - y, linear[i, 2] - linear[o, 2] - z
    wx, wy, wz = angular[i, 0] - angular[o, 0], angular[i, 1] - angular[o, 1], angular[i, 2] - angular[o, 2]
    wx, wy, wz = cross(nx, ny, nz, wx, wy, wz)
    drift = drift_seen(i, o, span, pull, linear, linear, length_of(o, angular))
    swing = sqrt(wx * wx + wy * wy + wz * wz) * numbers[p, REACH + side]
    return nx * x + ny * y + nz * z + pull + drift + swing


@woven
def drift_seen(i, o, span, pull, linear, other_linear, spin):
    """Return by how much the velocity of body i changes within ``span`` (s) as o sees it, which turns at ``spin``."""
    return span * spin * (between(i, o, linear, other_linear) + pull)
