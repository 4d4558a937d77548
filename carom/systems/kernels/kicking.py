"""Kicks: from accelerations to the arcs that bodies fly, by the integrator."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.crew import eights_of, shared
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.lane_columns import are_all, in_a_row, load_flat, set_all, store_flat
from carom.systems.kernels.lanes import WIDTH
from carom.systems.kernels.spatial import exponential

EULER, SEMI_IMPLICIT, VERLET = 0, 1, 2


@shared(
    "linear", "angular", "acceleration", "angular_acceleration", "decay", "angular_decay", "flow",
    "last_acceleration", "last_angular_acceleration",
)  # fmt: skip
def kick_bodies(
    crew, rows, h, integrator, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
    linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
    last_acceleration, last_angular_acceleration,
):  # fmt: skip
    """Set each body's arc by the integrator; bodies in contact are stepped semi-implicitly whatever it is.

    Drag relaxes the velocity towards the flow by a factor exp(-rate h): all of it before the drift (semi-implicit),
    after it (Euler), or half before and half after (Verlet, Strang's splitting, which keeps second order).
    """
    begin, end = eights_of(crew, len(rows))
    rows = rows[begin:end]
    for n in range(0, len(rows), WIDTH):
        if in_a_row(rows, n):
            i, steps = rows[n], number_of(touching, rows[n])
            undragged = are_all(0.0, drag, 1, i) and are_all(0.0, angular_drag, 1, i)
            if undragged and (integrator == SEMI_IMPLICIT or steps == WIDTH):
                kick_by_steps(
                    i, h, felt, linear, angular, acceleration, angular_acceleration, decay, angular_decay,
                    last_acceleration, last_angular_acceleration,
                )  # fmt: skip
                continue
            if undragged and steps == 0:
                for at in range(3 * i, 3 * (i + WIDTH), WIDTH):
                    f, b = load_flat(felt, at), load_flat(angular_acceleration, at)
                    store_flat(acceleration, at, f)
                    store_flat(last_acceleration, at, f)
                    store_flat(last_angular_acceleration, at, b)
                set_all(1.0, decay, 1, i)
                set_all(1.0, angular_decay, 1, i)
                continue
        for i in rows[n : n + WIDTH]:
            kick_body(
                i, h, integrator, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
                linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
                last_acceleration, last_angular_acceleration,
            )  # fmt: skip


@woven
def number_of(touching, first):
    """Return how many of eight bodies in a row are in contact."""
    count = 0
    for i in range(first, first + WIDTH):
        count += touching[i]
    return count


@woven
def kick_by_steps(
    i, h, felt, linear, angular, acceleration, angular_acceleration, decay, angular_decay,
    last_acceleration, last_angular_acceleration,
):  # fmt: skip
    """Kick body i and the seven in the rows behind it, all semi-implicit and without drag."""
    for at in range(3 * i, 3 * (i + WIDTH), WIDTH):
        store_flat(linear, at, load_flat(linear, at) + h * load_flat(felt, at))
        store_flat(angular, at, load_flat(angular, at) + h * load_flat(angular_acceleration, at))
    for column in (acceleration, angular_acceleration, last_acceleration, last_angular_acceleration):
        set_all(0.0, column, 3, i)
    for column in (decay, angular_decay):
        set_all(1.0, column, 1, i)


@inlined
def kick_body(
    i, h, integrator, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
    linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
    last_acceleration, last_angular_acceleration,
):  # fmt: skip
    """Set the arc of one body."""
    scheme = SEMI_IMPLICIT if touching[i] else integrator
    before = 1.0
    decay[i], angular_decay[i] = 1.0, 1.0
    rate = drag[i] * inverse_mass[i]
    for k in range(3):
        last_acceleration[i, k] = 0.0 if scheme == SEMI_IMPLICIT else felt[i, k]
    if rate > 0.0:
        for k in range(3):
            flow[i, k] = drag_flow[i, k] / drag[i] * freedom[i, k]
        if scheme == VERLET:
            before = exponential(-0.5 * rate * h)
            decay[i] = before
            for k in range(3):  # the middle of the next substep is predicted with drag too
                last_acceleration[i, k] += (flow[i, k] - linear[i, k]) * (1.0 - before) / (0.5 * h)
        elif scheme == SEMI_IMPLICIT:
            before = exponential(-rate * h)
        else:
            decay[i] = exponential(-rate * h)
        for k in range(3):
            linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * before
    for k in range(3):
        last_angular_acceleration[i, k] = 0.0 if scheme == SEMI_IMPLICIT else angular_acceleration[i, k]
    if angular_drag[i] > 0.0 and inverse_mass[i] > 0.0:
        before = 1.0
        if scheme == VERLET:
            before = exponential(-0.5 * angular_drag[i] * h)
            angular_decay[i] = before
            for k in range(3):
                last_angular_acceleration[i, k] -= angular[i, k] * (1.0 - before) / (0.5 * h)
        elif scheme == SEMI_IMPLICIT:
            before = exponential(-angular_drag[i] * h)
        else:
            angular_decay[i] = exponential(-angular_drag[i] * h)
        for k in range(3):
            angular[i, k] *= before
    for k in range(3):
        if scheme == SEMI_IMPLICIT:
            linear[i, k] += h * felt[i, k]
            angular[i, k] += h * angular_acceleration[i, k]
            acceleration[i, k] = 0.0
            angular_acceleration[i, k] = 0.0
        else:
            acceleration[i, k] = felt[i, k]
