"""The arcs of bodies that rest on others."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
import numpy as np

from carom.systems.kernels.kernel import kernel


@kernel("touching", "linear", "angular", "acceleration", "angular_acceleration", makes_arrays=True)
def bend_arcs(
    count, h, body_a, body_b, normal, kind, resting, freedom, touching, start_linear, start_angular,
    linear, angular, acceleration, angular_acceleration,
):  # fmt: skip
    """Let balls that only rest on others fly the substep at constant acceleration instead of at their last velocity.

    What friction and rolling resistance took is spread over the substep, which makes sliding and rolling exact between
    changes of state, and speeds right at impacts in between. Along the contact normals the velocity stays the last one.
    """
    bent = np.zeros(len(touching), np.bool_)
    for c in range(count):
        if resting[c]:
            for body in (body_a[c], body_b[c]):
                if body >= 0:
                    bent[body] = True
                    touching[body] &= kind[c] >= 0
    for i in range(len(bent)):
        bent[i] &= touching[i]
        if bent[i]:
            for k in range(3):
                acceleration[i, k] = (linear[i, k] - start_linear[i, k]) / h
                angular_acceleration[i, k] = (angular[i, k] - start_angular[i, k]) / h
    for c in range(count):
        if resting[c]:
            for body in (body_a[c], body_b[c]):
                if body >= 0 and bent[body]:
                    along = 0.0
                    for k in range(3):
                        along += normal[c, k] * acceleration[body, k]
                    for k in range(3):
                        acceleration[body, k] -= along * normal[c, k] * freedom[body, k]
    for i in range(len(bent)):
        if bent[i]:
            touching[i] = False
            for k in range(3):
                linear[i, k] -= h * acceleration[i, k]
                angular[i, k] -= h * angular_acceleration[i, k]
