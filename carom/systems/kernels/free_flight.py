"""Free flight: where nobody meets anybody in a step, each body takes its substeps while it is in the cache."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import APART_MARGIN
from carom.systems.kernels.advancing import advance_bodies as advance
from carom.systems.kernels.crew import eights_of
from carom.systems.kernels.flight import predict_middle
from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.kicking import kick_bodies
from carom.systems.kernels.reach import time_within_all
from carom.systems.kernels.settling import finish_drift

predict, kick, finish = predict_middle.within, kick_bodies.within, finish_drift.within
TOGETHER = 256  # bodies, whose columns lie in the cache of a processor


@woven
def is_free(rows, watched, span, drag, stream, center, detected_center, reach, linear, felt):
    """Tell whether no body can leave within ``span`` seconds what was foreseen for it, as nothing but forces moves it.

    It may where a medium carries it along.
    """
    for i in rows:
        if drag[i] != 0.0:
            return False
    span *= 1.0 + APART_MARGIN  # so that none does in a single substep either, however that is rounded
    return time_within_all(watched, span, stream, center, detected_center, reach, linear, felt) == span


@making
def fly_freely(
    crew, rows, number, substeps, h, scheme, bends, center_of_mass, inverse_mass, inertia, principal_axes, freedom,
    drag, drag_flow, angular_drag, position, rotation, linear, angular, last_acceleration, last_angular_acceleration,
    center, time, acceleration, angular_acceleration, felt, decay, angular_decay, flow, touching, held,
    start_position, start_rotation, start_linear, start_angular, start_center, turned, pull, arc,
):  # fmt: skip
    """Take the substeps from ``number`` on, of h seconds, of bodies that meet nobody; the first has its arcs begun."""
    begin, end = eights_of(crew, len(rows))
    alone = (crew[0], 0, 1)
    for first in range(begin, end, TOGETHER):
        some = rows[first : min(first + TOGETHER, end)]
        for k in range(number, substeps + 1):
            if k > number:
                predict(
                    alone, some, 0.0, center_of_mass, freedom, held, last_acceleration, last_angular_acceleration,
                    position, rotation, linear, angular, center, start_center, start_position, start_rotation,
                    start_linear, start_angular, angular_acceleration, time, turned, touching,
                )  # fmt: skip
            kick(
                alone, some, h, scheme, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
                linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
                last_acceleration, last_angular_acceleration,
            )  # fmt: skip
            advance(
                alone, some, h, bends, center, rotation, turned, linear, angular, time, acceleration,
                angular_acceleration, inverse_mass, inertia, principal_axes, freedom, pull, arc,
            )  # fmt: skip
            finish(
                alone, some, True, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation,
                decay, angular_decay, flow, rotation, center, linear, angular, position,
            )  # fmt: skip
