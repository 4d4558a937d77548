"""Vectors (..., 3) over leading axes, from + - * / sqrt alone; every function broadcasts its arguments."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial.angles import arc_tangent
from carom.ecs.spatial.checks import refuse, shaped

AXES = (3,)


def dot(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return the scalar products (...) of vectors (..., 3), in the product of their units."""
    a, b = shaped(a, AXES, "a vector"), shaped(b, AXES, "a vector")
    found: Floats = a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]
    return found


def cross(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return a x b (..., 3), right-handed: right x up = back."""
    a, b = shaped(a, AXES, "a vector"), shaped(b, AXES, "a vector")
    ax, ay, az, bx, by, bz = (v[..., k] for v in (a, b) for k in range(3))
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length(v: npt.ArrayLike) -> Floats:
    """Return the lengths (...) of vectors (..., 3), in their unit; no square over- or underflows on the way."""
    scaled, exponent = _scaled(v)
    return np.ldexp(np.sqrt(dot(scaled, scaled)), exponent)


def distance(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return the distances (...) between points (..., 3), in their unit."""
    return length(shaped(b, AXES, "a point") - shaped(a, AXES, "a point"))


def normalise(v: npt.ArrayLike, *, otherwise: npt.ArrayLike | None = None) -> Floats:
    """Return the directions (..., 3) of vectors (..., 3) of any length but 0, unit.

    A zero vector has no direction: it becomes ``otherwise`` (..., 3) where that is given and is a GeometryError where
    not. A vector that is not finite is a GeometryError.
    """
    scaled, _ = _scaled(v)
    size = np.sqrt(dot(scaled, scaled))[..., None]
    refuse(~np.isfinite(size[..., 0]), "a vector is not finite")
    if otherwise is None:
        refuse(size[..., 0] == 0.0, "a zero vector has no direction")
        return scaled / size
    return np.where(size == 0.0, shaped(otherwise, AXES, "a vector"), scaled / np.where(size == 0.0, 1.0, size))


def lerp(a: npt.ArrayLike, b: npt.ArrayLike, t: npt.ArrayLike) -> Floats:
    """Return the points (..., 3) a fraction t (...) of the way from a to b: a at 0 and b at 1, to the bit.

    Outside of 0..1 the line goes on. Each half is reckoned from its own end, so that neither end is off by rounding.
    """
    a, b = shaped(a, AXES, "a point"), shaped(b, AXES, "a point")
    t = np.asarray(t, np.float64)[..., None]
    way = b - a
    return np.where(t < 0.5, a + way * t, b - way * (1.0 - t))


def project(v: npt.ArrayLike, onto: npt.ArrayLike) -> Floats:
    """Return the parts (..., 3) of vectors along ``onto`` (..., 3), of any length but 0 (GeometryError)."""
    unit = normalise(onto)
    along: Floats = unit * dot(v, unit)[..., None]
    return along


def reject(v: npt.ArrayLike, from_: npt.ArrayLike) -> Floats:
    """Return the parts (..., 3) of vectors across ``from_`` (..., 3), of any length but 0: v less its projection."""
    across: Floats = shaped(v, AXES, "a vector") - project(v, from_)
    return across


def reflect(v: npt.ArrayLike, normal: npt.ArrayLike) -> Floats:
    """Return vectors (..., 3) mirrored by the plane across ``normal`` (..., 3), of any length but 0: v - 2 (v.n) n."""
    mirrored: Floats = shaped(v, AXES, "a vector") - 2.0 * project(v, normal)
    return mirrored


def angle(a: npt.ArrayLike, b: npt.ArrayLike) -> Floats:
    """Return the angles (...) between vectors (..., 3) in rad, 0..pi; a zero vector is a GeometryError.

    2 arctan(|u - v| / |u + v|) of the unit vectors keeps its digits where the arc cosine loses half of them (Kahan,
    How Futile are Mindless Assessments of Roundoff in Floating-Point Computation?, 2006, section 12).
    """
    u, v = normalise(a), normalise(b)
    return 2.0 * arc_tangent(length(u - v), length(u + v))


def change_handedness(v: npt.ArrayLike) -> Floats:
    """Return points or directions (..., 3) of a right-handed frame in the left-handed one with +z forward, or back.

    z changes its sign; doing it twice changes nothing. Turning axes are not directions: see ``quaternion``.
    """
    changed: Floats = shaped(v, AXES, "a vector") * np.array([1.0, 1.0, -1.0])
    return changed


def _scaled(v: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.int32]]:
    """Return vectors over the power of two next to their largest part, which loses no bit, and its exponents (...)."""
    v = shaped(v, AXES, "a vector")
    _, exponent = np.frexp(np.abs(v).max(axis=-1))
    return np.ldexp(v, -exponent[..., None]), exponent
