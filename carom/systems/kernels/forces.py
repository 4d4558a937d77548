"""Kernels of the force laws."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel("force", "torque", "drag", "drag_flow", "angular_drag", "medium")
def clear_sums(rows, force, torque, drag, drag_flow, angular_drag, medium):
    """Set what forces add up to back to zero."""
    for i in rows:
        drag[i], angular_drag[i] = 0.0, 0.0
        for k in range(3):
            force[i, k], torque[i, k], drag_flow[i, k], medium[i, k] = 0.0, 0.0, 0.0, 0.0


@kernel("force", "torque")
def clear_external(rows, force, torque):
    """Set the forces from outside back to zero."""
    for i in rows:
        for k in range(3):
            force[i, k], torque[i, k] = 0.0, 0.0


@kernel()
def some_are_turned(rows, torque):
    """Tell whether a torque acts on some of these rows; NaN is one."""
    none = True
    for i in rows:
        none &= torque[i, 0] == 0.0 and torque[i, 1] == 0.0 and torque[i, 2] == 0.0
    return not none


@kernel("force")
def add_weight(rows, mass, scale, gx, gy, gz, force):
    """Add m g, times the body's own scale."""
    for i in rows:
        heavy = mass[i] * scale[i]
        force[i, 0] += heavy * gx
        force[i, 1] += heavy * gy
        force[i, 2] += heavy * gz


@kernel("drag", "drag_flow")
def add_linear_drag(rows, coefficient, medium, drag, drag_flow):
    """Add a drag of ``coefficient`` (kg/s) towards the velocity of the medium."""
    for i in rows:
        drag[i] += coefficient
        for k in range(3):
            drag_flow[i, k] += coefficient * medium[i, k]


@kernel("drag", "drag_flow")
def add_quadratic_drag(rows, factor, medium, linear, drag, drag_flow):
    """Add a drag of ``factor`` (kg/m) times the speed through the medium."""
    for i in rows:
        squared = 0.0
        for k in range(3):
            squared += (linear[i, k] - medium[i, k]) ** 2
        coefficient = factor * sqrt(squared)
        drag[i] += coefficient
        for k in range(3):
            drag_flow[i, k] += coefficient * medium[i, k]


@kernel("drag", "angular_drag")
def add_damping(rows, mass, inverse_mass, linear_damping, angular_damping, drag, angular_drag):
    """Add to the rates at which bodies that obey forces come to rest, whatever moves around them."""
    for i in rows:
        if inverse_mass[i] > 0.0:
            drag[i] += mass[i] * linear_damping[i]
            angular_drag[i] += angular_damping[i]


@kernel("force")
def add_push(rows, h, fx, fy, fz, x, y, z, stroke, inverse_mass, freedom, start_center, start_linear, force):
    """Add a push along its stroke, cut to the part of the substep before the body leaves it."""
    size = sqrt(fx * fx + fy * fy + fz * fz)
    if size == 0.0:
        return
    dx, dy, dz = fx / size, fy / size, fz / size
    for i in rows:
        at = dx * (start_center[i, 0] - x) + dy * (start_center[i, 1] - y) + dz * (start_center[i, 2] - z)
        left = stroke - at
        if left <= 0.0:
            continue
        part = 1.0
        speed = dx * start_linear[i, 0] + dy * start_linear[i, 1] + dz * start_linear[i, 2]
        others, along = 0.0, size
        for k, (d, f) in enumerate(((dx, fx), (dy, fy), (dz, fz))):
            others += d * force[i, k] * freedom[i, k]
            along -= d * f * (1.0 - freedom[i, k])
        pull = (along + others) * inverse_mass[i]
        inside = speed * speed + 2.0 * pull * left
        if inside > 0.0 and speed + sqrt(inside) > 0.0:
            part = min(1.0, 2.0 * left / (speed + sqrt(inside)) / h)
        force[i, 0] += part * fx
        force[i, 1] += part * fy
        force[i, 2] += part * fz
