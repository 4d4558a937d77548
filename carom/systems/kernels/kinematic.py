"""Kinematic bodies: where they are at the end of a substep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import spun, turn


@inlined
def keep_course(i, h, center_of_mass, start_position, start_rotation, linear, angular, center, rotation):
    """Place a kinematic body where its velocity takes it in a substep of h seconds from its start.

    In one piece: impacts on the way cut its flight into pieces, whose sum would be another in its last bits.
    """
    qx, qy, qz, qw = start_rotation[i, 0], start_rotation[i, 1], start_rotation[i, 2], start_rotation[i, 3]
    x, y, z = turn(qx, qy, qz, qw, center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2])
    center[i, 0] = start_position[i, 0] + x + linear[i, 0] * h
    center[i, 1] = start_position[i, 1] + y + linear[i, 1] * h
    center[i, 2] = start_position[i, 2] + z + linear[i, 2] * h
    rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3] = spun(
        qx, qy, qz, qw, angular[i, 0], angular[i, 1], angular[i, 2], h
    )
