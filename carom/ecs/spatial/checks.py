"""What the functions of this folder ask of their arrays, and the error that says it is not so."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.errors import CaromError

TYPED_SLACK = 1e-3  # of products of columns; lets a rotation typed to three digits pass, and no visible shear or scale


class GeometryError(CaromError, ValueError):
    """The numbers describe no such thing: no direction, no rotation, no inverse, no picture."""


def shaped(value: npt.ArrayLike, axes: tuple[int, ...], what: str) -> Floats:
    """Return a value as float64 whose last axes are ``axes``; any other shape is a GeometryError."""
    array = np.asarray(value, np.float64)
    if array.shape[-len(axes) :] != axes:
        raise GeometryError(f"{what} has shape {array.shape}; accepted: (..., {', '.join(map(str, axes))})")
    return array


def refuse(faulty: Any, what: str) -> None:
    """Raise a GeometryError that says ``what`` is wrong and where it first is, if any entry of a mask is true."""
    faulty = np.asarray(faulty)
    if faulty.any():
        place = [int(k) for k in np.unravel_index(int(np.argmax(faulty)), faulty.shape)]
        raise GeometryError(f"{what} (at index {place})" if place else what)


def refuse_unless_rotation(m: Floats, what: str) -> None:
    """Raise a GeometryError unless matrices (..., 3, 3) have orthonormal columns that are right-handed."""
    gram = sum(m[..., k, :, None] * m[..., k, None, :] for k in range(3))
    # Not `> slack`: an entry that is no number fails too.
    crooked = ~(np.abs(gram - np.eye(3)).max(axis=(-2, -1)) <= TYPED_SLACK)
    refuse(crooked, f"{what} is no rotation: its columns are not orthonormal within {TYPED_SLACK}")
    x, y, z = m[..., 0], m[..., 1], m[..., 2]
    volume = x[..., 0] * (y[..., 1] * z[..., 2] - y[..., 2] * z[..., 1])
    volume = volume + x[..., 1] * (y[..., 2] * z[..., 0] - y[..., 0] * z[..., 2])
    volume = volume + x[..., 2] * (y[..., 0] * z[..., 1] - y[..., 1] * z[..., 0])
    refuse(volume < 0.0, f"{what} is no rotation: its columns are left-handed, a mirror image")
