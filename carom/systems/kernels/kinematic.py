"""Kinematic bodies: what their turning does to what rests on them, and where they are at the end of a substep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.packing import ANGULAR, INVERSE_MASS, VELOCITY
from carom.systems.kernels.spatial import spun, turn


@inlined
def follow_turning(c, a, b, time, bodies, normal, center, offset_a, offset_b):
    """Let contact c on a turning kinematic body feel its surface ``time`` seconds on; tell whether there is such.

    In the middle of the substep a body that keeps to the surface goes along the chord of its circle and so stays on it;
    by the velocity at the start it would leave along the tangent. A ball whose arc bends comes to the surface's
    velocity at the end of the substep, and needs that.
    """
    if turns(a, bodies):
        ahead(c, b, a, time, bodies, normal, center, offset_b, offset_a)
        return True
    if turns(b, bodies):
        ahead(c, a, b, time, bodies, normal, center, offset_a, offset_b)
        return True
    return False


@inlined
def turns(i, bodies):
    """Tell whether body i is kinematic and turns."""
    x, y, z = bodies[VELOCITY, i, ANGULAR], bodies[VELOCITY, i, ANGULAR + 1], bodies[VELOCITY, i, ANGULAR + 2]
    return bodies[VELOCITY, i, INVERSE_MASS] == 0.0 and (x != 0.0 or y != 0.0 or z != 0.0)


@inlined
def ahead(c, i, o, time, bodies, normal, center, offset, offset_other):
    """Move the offset of contact c from body o along the surface to where body i takes it in ``time`` seconds."""
    along = 0.0
    for k in range(3):
        to = center[i, k] + offset[c, k] - center[o, k] + time * (bodies[VELOCITY, i, k] - bodies[VELOCITY, o, k])
        along += normal[c, k] * (to - offset_other[c, k])
    for k in range(3):
        to = center[i, k] + offset[c, k] - center[o, k] + time * (bodies[VELOCITY, i, k] - bodies[VELOCITY, o, k])
        offset_other[c, k] = to - along * normal[c, k]


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
