"""Packing: what the resting stage knows of bodies, in rows that lanes are gathered from."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.freedom import held_inverse
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lane_widths import BLOCK, BLOCKS
from carom.systems.kernels.spatial import product

# The blocks of a body's row. Velocity, and the way since contacts were measured: linear (3), a gap, angular (3), a gap;
# before it sets out, where its centre is (3).
# Inverse inertia in the world frame: upper half (6), the largest moment. Inverse mass along the axes (3), acceleration
# by forces (3), inverse mass without locks. Until it sets out, the way gives place to the pose: centre (3), a gap,
# rotation (4).
VELOCITY, WAY, INVERSE, MASS_AND_FELT = range(BLOCKS)
CENTER = POSE = WAY
BODY_WIDTH, ANGULAR = BLOCKS * BLOCK, 4
AT_WAY, AT_INVERSE, AT_MASS = WAY * BLOCK, INVERSE * BLOCK, MASS_AND_FELT * BLOCK


@kernel("bodies")
def pack_bodies(
    rows, center, linear, angular, felt, inverse_mass, inverse_inertia, principal, freedom, rotation, bodies
):
    """Write where bodies are, their velocities, inverse masses and inertias; the world is at its origin."""
    for k in range(BODY_WIDTH):
        bodies[-1, k] = 0.0
    bodies[-1, AT_WAY + BLOCK - 1] = 1.0
    for i in rows:
        ix, iy, iz = inverse_inertia[i, 0], inverse_inertia[i, 1], inverse_inertia[i, 2]
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        if ix != iy or iy != iz:  # else they do not count
            ax, ay, az, aw = principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3]
            qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
        inverse = held_inverse(qx, qy, qz, qw, ix, iy, iz, freedom[i, 3], freedom[i, 4], freedom[i, 5])
        for k, value in enumerate(inverse):
            bodies[i, AT_INVERSE + k] = value
        bodies[i, AT_INVERSE + 6] = max(ix, iy, iz)
        bodies[i, AT_MASS + 6] = inverse_mass[i]
        for k in range(3):
            bodies[i, VELOCITY + k], bodies[i, VELOCITY + ANGULAR + k] = linear[i, k], angular[i, k]
            bodies[i, AT_WAY + k] = center[i, k]
            bodies[i, AT_MASS + k], bodies[i, AT_MASS + 3 + k] = inverse_mass[i] * freedom[i, k], felt[i, k]
        for k in range(4):
            bodies[i, AT_WAY + ANGULAR + k] = rotation[i, k]


@kernel("bodies")
def pack_moving(rows, center, rotation, linear, angular, felt, bodies):
    """Write the velocities of bodies and what they feel, which are where they were packed; False where one is not."""
    for i in rows:
        same = True
        for k in range(3):
            same &= bodies[i, AT_WAY + k] == center[i, k]
            bodies[i, VELOCITY + k], bodies[i, VELOCITY + ANGULAR + k] = linear[i, k], angular[i, k]
            bodies[i, AT_MASS + 3 + k] = felt[i, k]
        for k in range(4):
            same &= bodies[i, AT_WAY + ANGULAR + k] == rotation[i, k]
        if not same:
            return False
    return True


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
    for k in range(BLOCK):
        bodies[-1, AT_WAY + k] = 0.0
    for i in rows:
        for k in range(3):
            bodies[i, AT_WAY + k], bodies[i, AT_WAY + ANGULAR + k] = center[i, k] - start_center[i, k], turned[i, k]
