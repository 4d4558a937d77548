"""Masses of links: their own and those of the links they carry, as the words of one body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from carom.ecs.spatial import quaternion
from carom.systems.shapes.solid import principal
from carom.worlds.importing.model import Inertia, Pose

LIGHTEST = 1e-3  # kg, of a body of which the file says no mass
SMALLEST = 1e-3  # m, the radius of gyration that a body has at least: none could turn without

ROUNDING = 1e-12  # share of its trace below which a product of inertia is that of rotations


def placed(inertia: Inertia, pose: Pose) -> Inertia:
    """Return an inertia of a frame at a pose in the outer frame."""
    if not pose.position.any() and np.array_equal(pose.rotation, quaternion.IDENTITY):
        return inertia
    turn = quaternion.matrix(pose.rotation)
    return Inertia(inertia.mass, pose.point(inertia.center), turn @ inertia.tensor @ turn.T)


def joined(parts: Sequence[Inertia]) -> Inertia:
    """Return several as one, moved to the common centre by Steiner's theorem."""
    if len(parts) == 1:
        return parts[0]
    mass = sum(part.mass for part in parts)
    center = sum((part.mass * part.center for part in parts), np.zeros(3)) / mass
    tensor = np.zeros((3, 3))
    for part in parts:
        away = part.center - center
        tensor += part.tensor + part.mass * (away @ away * np.eye(3) - np.multiply.outer(away, away))
    return Inertia(mass, center, tensor)


def body_words(inertia: Inertia) -> tuple[dict[str, Any], bool]:
    """Return the words of a body, and whether its moments had to be raised so that it can turn."""
    tensor = np.where(np.abs(inertia.tensor) > ROUNDING * np.trace(inertia.tensor), inertia.tensor, 0.0)
    words: dict[str, Any] = {"mass": inertia.mass}
    if np.array_equal(tensor, np.diag(np.diag(tensor))):
        moments = np.diag(tensor)
    else:
        found, axes = principal(tensor.tolist())
        moments, words["principal_axes"] = np.array(found), quaternion.from_matrix(axes)
    least = inertia.mass * SMALLEST**2
    raised = bool((moments < least * 1e-3).any())
    words["inertia"] = np.maximum(moments, least) if raised else moments
    if np.asarray(inertia.center).any():
        words["center_of_mass"] = inertia.center
    return words, raised
