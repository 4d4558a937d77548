"""Bouncing: whether the two bodies of an impact part again, or stay together."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ENDED, PATIENCE, REST_SPEED_FACTOR, STANDING
from carom.systems.kernels.bodies import length_of, pressing_of
from carom.systems.kernels.kernel import inlined, woven


@inlined
def pressed_by_forces(a, b, nx, ny, nz, felt):
    """Return how hard forces press one of two bodies against the other along the normal n from a to b (m/s2).

    The greater of both, not their difference: the balls of a heap all feel the same gravity and yet lie on each other.
    """
    pressing = 0.0
    if a >= 0:
        pressing = max(pressing, nx * felt[a, 0] + ny * felt[a, 1] + nz * felt[a, 2])
    if b >= 0:
        pressing = max(pressing, -(nx * felt[b, 0] + ny * felt[b, 1] + nz * felt[b, 2]))
    return pressing


@inlined
def pushed(a, b, felt):
    """Return the greater of what forces do to two bodies (m/s2)."""
    return max(length_of(a, felt), length_of(b, felt))


@woven
def bounce_of(e, speed, i, o, nx, ny, nz, h, struck_before, felt, acceleration, turning):
    """Return the restitution e of an impact at ``speed`` (m/s) along the normal n from o to i, or 0 if none bounces.

    That is so where what presses the two together, forces and ``turning`` (m/s2, as `coming_up` returns it), would let
    them land again within the substep of ``h`` seconds, and
    where as many bounces as they have had in it leave nothing of a speed: what drives them into each other meanwhile
    are others who do the same, without end (McNamara and Young, Physics of Fluids A 4, 496, 1992).
    """
    pressing = max(pressed_by_forces(o, i, nx, ny, nz, felt), pressing_of(i, o, nx, ny, nz, acceleration))
    if struck_before >= PATIENCE:
        pressing = max(pressing, pushed(i, o, felt))
        if e**struck_before < ENDED:
            return 0.0
    return e if speed > REST_SPEED_FACTOR * (max(0.0, pressing) + turning) * h else 0.0


@woven
def patience_of(p, body_a, body_b, inverse_mass):
    """Return after how many plastic impacts in a substep pair p is left to the resting stage."""
    stands = False
    for body in (body_a[p], body_b[p]):
        stands |= body < 0 or inverse_mass[body] == 0.0
    return PATIENCE * STANDING if stands else PATIENCE
