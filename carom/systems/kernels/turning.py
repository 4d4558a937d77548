"""Turning: what torques and spins are to bodies, over rows."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.accounting import angular_momentum
from carom.systems.kernels.bodies import turned_by
from carom.systems.kernels.kernel import kernel


@kernel("turning")
def find_turning(rows, torque, inverse_inertia, principal_axes, freedom, rotation, turning):
    """Write the angular acceleration (n, 3) that a torque (n, 3) gives each body of ``rows`` (n,)."""
    for m in range(len(rows)):
        turning[m, 0], turning[m, 1], turning[m, 2] = turned_by(
            rows[m], torque[m, 0], torque[m, 1], torque[m, 2], inverse_inertia, principal_axes, freedom, rotation
        )


@kernel("momentum")
def find_angular_momentum(rows, angular, inertia, principal_axes, rotation, momentum):
    """Write the angular momentum (n, 3) of each body of ``rows`` (n,) that turns at ``angular`` (n, 3)."""
    for m in range(len(rows)):
        i = rows[m]
        momentum[m, 0], momentum[m, 1], momentum[m, 2] = angular_momentum(
            i, rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
            angular[m, 0], angular[m, 1], angular[m, 2], inertia, principal_axes,
        )  # fmt: skip
