"""Kernels of media: their surfaces as shapes see them, and what they do to who is in them."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.observing import centre
from carom.systems.kernels.spatial import cross, product, turn
from carom.systems.kernels.submersion import CENTER, VOLUME, WHOLE


@kernel("place", "turns", "normal", "depth")
def look_down(rows, position, rotation, at, turned, ux, uy, uz, height, place, turns, normal, depth):
    """Write poses of shapes ``rows`` (n,) in the world, and the surface in their frames: normal . x = depth there.

    Those of their entities are position and rotation, ``at`` and ``turned`` those of shapes in the entities' frames.
    The surface is ``height`` along the unit vector u from the origin.
    """
    for m in range(len(rows)):
        i = rows[m]
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        x, y, z = turn(qx, qy, qz, qw, at[i, 0], at[i, 1], at[i, 2])
        x, y, z = x + position[i, 0], y + position[i, 1], z + position[i, 2]
        qx, qy, qz, qw = product(qx, qy, qz, qw, turned[i, 0], turned[i, 1], turned[i, 2], turned[i, 3])
        place[m, 0], place[m, 1], place[m, 2] = x, y, z
        turns[m, 0], turns[m, 1], turns[m, 2], turns[m, 3] = qx, qy, qz, qw
        normal[m, 0], normal[m, 1], normal[m, 2] = turn(-qx, -qy, -qz, qw, ux, uy, uz)
        depth[m] = height - (x * ux + y * uy + z * uz)


@kernel("volume", "center", "depth", "whole")
def look_up(found, place, turns, ux, uy, uz, height, volume, center, depth, whole):
    """Write what was ``found`` (n, 5) of shapes with the centres in the world, and how deep these are."""
    for m in range(len(found)):
        volume[m], whole[m] = found[m, VOLUME], found[m, WHOLE]
        x, y, z = turn(
            turns[m, 0], turns[m, 1], turns[m, 2], turns[m, 3],
            found[m, CENTER], found[m, CENTER + 1], found[m, CENTER + 2],
        )  # fmt: skip
        x, y, z = x + place[m, 0], y + place[m, 1], z + place[m, 2]
        center[m, 0], center[m, 1], center[m, 2] = x, y, z
        depth[m] = height - (x * ux + y * uy + z * uz)


@kernel("force", "torque", "displaced", "all_of_it")
def add_buoyancy(
    body, volume, center, whole, lift, ux, uy, uz, position, rotation, center_of_mass,
    force, torque, displaced, all_of_it,
):  # fmt: skip
    """Add ``lift`` (N/m3) times volume along u at the centre of each, and sum up what bodies displace of their volume.

    ``body`` (n,) are rows; displaced and all_of_it have a place for each row.
    """
    for m in range(len(body)):
        i = body[m]
        displaced[i] += volume[m]
        all_of_it[i] += whole[m]
        x, y, z = centre(i, position, rotation, center_of_mass)
        pull = lift * volume[m]
        fx, fy, fz = pull * ux, pull * uy, pull * uz
        tx, ty, tz = cross(center[m, 0] - x, center[m, 1] - y, center[m, 2] - z, fx, fy, fz)
        for k, (push, twist) in enumerate(((fx, tx), (fy, ty), (fz, tz))):
            force[i, k] += push
            torque[i, k] += twist


@inlined
def cube_root(x):
    """Return the cube root of x > 0, by + - * / and sqrt alone."""
    root = sqrt(x)
    for _ in range(8):  # the error of its logarithm falls to a quarter in each
        root = sqrt(sqrt(x * root))
    for _ in range(3):
        root -= (root - x / (root * root)) / 3.0
    return root


@kernel("drag", "drag_flow", "angular_drag")
def add_wet_drag(
    rows, displaced, all_of_it, density, drag_coefficient, damping, cx, cy, cz,
    mass, inertia, inverse_mass, linear, angular, drag, drag_flow, angular_drag,
):  # fmt: skip
    """Add the drag of a medium with current c: ``damping`` times the share below, and 1/2 rho Cd V^(2/3) |u|.

    The torque of the latter is 1/2 rho Cd V^(5/3) |w|, over the mean moment of inertia.
    """
    for i in rows:
        if displaced[i] <= 0.0 or inverse_mass[i] == 0.0:
            continue
        rate = damping * displaced[i] / all_of_it[i]
        across = cube_root(displaced[i])
        factor = 0.5 * density * drag_coefficient * across * across
        ux, uy, uz = linear[i, 0] - cx, linear[i, 1] - cy, linear[i, 2] - cz
        coefficient = mass[i] * rate + factor * sqrt(ux * ux + uy * uy + uz * uz)
        drag[i] += coefficient
        for k, c in enumerate((cx, cy, cz)):
            drag_flow[i, k] += coefficient * c
        moment = (inertia[i, 0] + inertia[i, 1] + inertia[i, 2]) / 3.0
        angular_drag[i] += rate
        if moment > 0.0:
            wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
            spin = sqrt(wx * wx + wy * wy + wz * wz)
            angular_drag[i] += factor * across * across * across * spin / moment
