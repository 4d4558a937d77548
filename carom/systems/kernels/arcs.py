"""The arcs of bodies that rest on others."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel("touching", "linear", "angular", "acceleration", "angular_acceleration")
def bend_arcs(
    count, h, body_a, body_b, normal, kind, resting, freedom, touching, start_linear, start_angular,
    linear, angular, acceleration, angular_acceleration,
):  # fmt: skip
    """Let balls that only rest on others fly the substep at constant acceleration instead of at their last velocity.

    What friction and rolling resistance took is spread over the substep, which makes sliding and rolling exact between
    changes of state, and speeds right at impacts in between. Along the contact normals the velocity stays the last one.
    """
    for c in range(count):
        if resting[c] and kind[c] < 0:
            for body in (body_a[c], body_b[c]):
                if body >= 0:
                    touching[body] = False
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                for k in range(3):
                    acceleration[body, k] = (linear[body, k] - start_linear[body, k]) / h
                    angular_acceleration[body, k] = (angular[body, k] - start_angular[body, k]) / h
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                along = 0.0
                for k in range(3):
                    along += normal[c, k] * acceleration[body, k]
                for k in range(3):
                    acceleration[body, k] -= along * normal[c, k] * freedom[body, k]
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                touching[body] = False  # each body once
                for k in range(3):
                    linear[body, k] -= h * acceleration[body, k]
                    angular[body, k] -= h * angular_acceleration[body, k]
