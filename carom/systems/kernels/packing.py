"""Packing: what the resting stage knows of bodies, in rows that lanes are gathered from."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lane_widths import BLOCK, BLOCKS
from carom.systems.kernels.spatial import product

# The blocks of a body's row. Velocity, and the way since contacts were measured: linear (3), a gap, angular (3), a gap.
# Inverse inertia in the world frame: upper half (6), the largest of it. Inverse mass along the axes
# (3), and the acceleration by forces (3).
VELOCITY, WAY, INVERSE, MASS_AND_FELT = range(BLOCKS)
BODY_WIDTH, ANGULAR = BLOCKS * BLOCK, 4
AT_WAY, AT_INVERSE, AT_MASS = WAY * BLOCK, INVERSE * BLOCK, MASS_AND_FELT * BLOCK


@kernel("bodies")
def pack_bodies(rows, linear, angular, felt, inverse_mass, inverse_inertia, principal, rotation, bodies):
    """Write velocities, inverse masses and inertias of bodies where they are."""
    for k in range(BODY_WIDTH):
        bodies[-1, k] = 0.0
    for i in rows:
        ix, iy, iz = inverse_inertia[i, 0], inverse_inertia[i, 1], inverse_inertia[i, 2]
        if ix == iy and iy == iz:
            bodies[i, AT_INVERSE], bodies[i, AT_INVERSE + 3], bodies[i, AT_INVERSE + 5] = ix, ix, ix
            bodies[i, AT_INVERSE + 1], bodies[i, AT_INVERSE + 2], bodies[i, AT_INVERSE + 4] = 0.0, 0.0, 0.0
        else:
            x, y, z, w = product(
                rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
                principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3],
            )  # fmt: skip
            ax, ay, az = 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)
            bx, by, bz = 2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)
            cx, cy, cz = 2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)
            bodies[i, AT_INVERSE] = ix * ax * ax + iy * bx * bx + iz * cx * cx
            bodies[i, AT_INVERSE + 1] = ix * ax * ay + iy * bx * by + iz * cx * cy
            bodies[i, AT_INVERSE + 2] = ix * ax * az + iy * bx * bz + iz * cx * cz
            bodies[i, AT_INVERSE + 3] = ix * ay * ay + iy * by * by + iz * cy * cy
            bodies[i, AT_INVERSE + 4] = ix * ay * az + iy * by * bz + iz * cy * cz
            bodies[i, AT_INVERSE + 5] = ix * az * az + iy * bz * bz + iz * cz * cz
        bodies[i, AT_INVERSE + 6] = max(ix, iy, iz)
        for k in range(3):
            bodies[i, VELOCITY + k], bodies[i, VELOCITY + ANGULAR + k] = linear[i, k], angular[i, k]
            bodies[i, AT_MASS + k], bodies[i, AT_MASS + 3 + k] = inverse_mass[i], felt[i, k]


@kernel("bodies")
def pack_velocities(rows, linear, angular, bodies):
    """Write the velocities of bodies."""
    for i in rows:
        for k in range(3):
            bodies[i, VELOCITY + k], bodies[i, VELOCITY + ANGULAR + k] = linear[i, k], angular[i, k]


@kernel("linear", "angular")
def unpack_velocities(rows, bodies, linear, angular):
    """Read the velocities of bodies back."""
    for i in rows:
        for k in range(3):
            linear[i, k], angular[i, k] = bodies[i, VELOCITY + k], bodies[i, VELOCITY + ANGULAR + k]


@kernel("bodies")
def pack_ways(rows, start_center, center, turned, bodies):
    """Write how far bodies have moved and turned since their contacts were measured."""
    for i in rows:
        for k in range(3):
            bodies[i, AT_WAY + k], bodies[i, AT_WAY + ANGULAR + k] = center[i, k] - start_center[i, k], turned[i, k]
