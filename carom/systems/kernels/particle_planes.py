"""Surfaces that particles bounce off: what two materials make of an impact, and planes in the world."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.contacts import SQRT, combined
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.particle_flight import FRICTION, NORMAL, OFFSET, RESTITUTION
from carom.systems.kernels.spatial import product, turn


@kernel("restitution", "friction")
def combine_materials(
    i, rows, material_restitution, material_friction, restitution_rule, friction_rule, restitution, friction
):
    """Write restitution and friction (n,) of the material of row ``i`` with those of ``rows``."""
    for c in range(len(rows)):
        j = rows[c]
        restitution[c] = combined(
            material_restitution[i], material_restitution[j], restitution_rule[i], restitution_rule[j], 0
        )
        friction[c] = combined(material_friction[i], material_friction[j], friction_rule[i], friction_rule[j], SQRT)


@kernel("planes")
def place_planes(rows, size, position, rotation, own_position, own_rotation, restitution, friction, planes):
    """Write the planes (n, 6) of colliders as they are in the world."""
    for c in range(len(rows)):
        j = rows[c]
        qx, qy, qz, qw = product(
            rotation[j, 0], rotation[j, 1], rotation[j, 2], rotation[j, 3],
            own_rotation[j, 0], own_rotation[j, 1], own_rotation[j, 2], own_rotation[j, 3],
        )  # fmt: skip
        nx, ny, nz = turn(qx, qy, qz, qw, size[j, 0], size[j, 1], size[j, 2])
        x, y, z = turn(
            rotation[j, 0], rotation[j, 1], rotation[j, 2], rotation[j, 3],
            own_position[j, 0], own_position[j, 1], own_position[j, 2],
        )  # fmt: skip
        planes[c, NORMAL], planes[c, NORMAL + 1], planes[c, NORMAL + 2] = nx, ny, nz
        planes[c, OFFSET] = (
            size[j, 3] + nx * (x + position[j, 0]) + ny * (y + position[j, 1]) + nz * (z + position[j, 2])
        )
        planes[c, RESTITUTION], planes[c, FRICTION] = restitution[c], friction[c]
