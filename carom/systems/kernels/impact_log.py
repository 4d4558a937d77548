"""Impact log: what a flight noted of the impacts on its way, into their table."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.impacts import FRICTION, IMPULSE, NORMAL, POINT, SPEED, TIME, WORK
from carom.systems.kernels.kernel import kernel


@kernel("a", "b", "time", "speed", "impulse", "work", "point", "normal", "friction_impulse")
def write_impacts(
    first, pair, log, contact_a, contact_b, a, b, time, speed, impulse, work, point, normal, friction_impulse
):
    """Write impacts, each of a contact (its ``pair``), into the rows of their table from ``first`` on."""
    for k in range(len(pair)):
        to = first + k
        a[to], b[to] = contact_a[pair[k]], contact_b[pair[k]]
        time[to], speed[to], impulse[to], work[to] = log[k, TIME], log[k, SPEED], log[k, IMPULSE], log[k, WORK]
        for axis in range(3):
            point[to, axis], normal[to, axis] = log[k, POINT + axis], log[k, NORMAL + axis]
            friction_impulse[to, axis] = log[k, FRICTION + axis]
