"""Cameras as 4x4 matrices, as OpenGL has them: looking along -z, and what is seen within -1..1 on all three axes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial import affine, quaternion
from carom.ecs.spatial.angles import sines_cosines
from carom.ecs.spatial.checks import refuse, shaped
from carom.ecs.spatial.constants import UP


def view(eye: npt.ArrayLike, target: npt.ArrayLike, up: npt.ArrayLike = UP) -> Floats:
    """Return ``camera_from_world`` (..., 4, 4) of cameras at ``eye`` (..., 3) that look at ``target`` (..., 3), in m.

    The inverse of where the camera stands, whose y is as near ``up`` as can be; as ``quaternion.look_at`` where it
    looks along ``up``. An eye at its target is a GeometryError.
    """
    eye, target = shaped(eye, (3,), "an eye"), shaped(target, (3,), "a target")
    refuse((eye == target).all(axis=-1), "a camera stands where it looks")
    return affine.inverse_rigid(affine.compose(eye, quaternion.look_at(target - eye, up)))


def perspective(fov: npt.ArrayLike, aspect: npt.ArrayLike, near: npt.ArrayLike, far: npt.ArrayLike) -> Floats:
    """Return ``clip_from_camera`` (..., 4, 4) of a pinhole: the plane at ``near`` (m) goes to z = -1, ``far`` to +1.

    ``fov`` is the vertical angle of view in rad, between 0 and pi, ``aspect`` width over height; all are (...). Points
    go through ``matrix.transform_points``, which divides by w, their distance along -z. Angles, aspects and distances
    out of order (0 < near < far) are GeometryErrors. Source: OpenGL 2.1 reference, gluPerspective; Akenine-Moeller et
    al., Real-Time Rendering, 4th edition, 2018, section 4.7.2.
    """
    fov, aspect, near, far = (np.asarray(number, np.float64) for number in (fov, aspect, near, far))
    refuse(~((fov > 0.0) & (fov < np.pi)), "an angle of view is not between 0 and pi")
    refuse(~((aspect > 0.0) & (aspect < np.inf)), "an aspect is not above 0")
    refuse(~((near > 0.0) & (near < far) & (far < np.inf)), "planes are not in the order 0 < near < far")
    sine, cosine = sines_cosines(0.5 * fov)
    found = np.zeros((*np.broadcast_shapes(fov.shape, aspect.shape, near.shape, far.shape), 4, 4))
    found[..., 0, 0], found[..., 1, 1] = cosine / sine / aspect, cosine / sine
    found[..., 2, 2], found[..., 2, 3] = (far + near) / (near - far), 2.0 * far * near / (near - far)
    found[..., 3, 2] = -1.0
    return found


def orthographic(
    left: npt.ArrayLike,
    right: npt.ArrayLike,
    bottom: npt.ArrayLike,
    top: npt.ArrayLike,
    near: npt.ArrayLike,
    far: npt.ArrayLike,
) -> Floats:
    """Return ``clip_from_camera`` (..., 4, 4) of parallel light: a box of the camera's frame becomes -1..1.

    Its sides are in m, each (...); ``near`` and ``far`` are distances along -z and may be negative, behind the camera.
    A box without width, height or depth is a GeometryError. Source: OpenGL 2.1 reference, glOrtho; Akenine-Moeller et
    al., Real-Time Rendering, 4th edition, 2018, section 4.7.1.
    """
    sides = [np.asarray(number, np.float64) for number in (left, right, bottom, top, near, far)]
    found = np.zeros((*np.broadcast_shapes(*(side.shape for side in sides)), 4, 4))
    found[..., 3, 3] = 1.0
    for axis, (low, high) in enumerate(zip(sides[::2], sides[1::2], strict=True)):
        refuse(~((low != high) & np.isfinite(high - low)), f"a box has no {('width', 'height', 'depth')[axis]}")
        found[..., axis, axis] = (-2.0 if axis == 2 else 2.0) / (high - low)
        found[..., axis, 3] = -(high + low) / (high - low)
    return found
