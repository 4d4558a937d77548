"""Islands: bodies that touch each other, directly or by way of others, and fall asleep and wake together."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import SLEEP_SPEED, SLEEP_TIME
from carom.systems.kernels.kernel import inlined, kernel, woven


@woven
def surface_speed(i, inverse_mass, inertia, linear, angular):
    """Return the greatest speed of a point of body i, taken for a ball of its mass and largest moment."""
    quick, spin = 0.0, 0.0
    for k in range(3):
        quick += linear[i, k] * linear[i, k]
        spin += angular[i, k] * angular[i, k]
    largest = max(inertia[i, 0], inertia[i, 1], inertia[i, 2])
    return sqrt(quick) + sqrt(2.5 * largest * inverse_mass[i] * spin)


@kernel("speed")
def find_surface_speeds(rows, inverse_mass, inertia, linear, angular, speed):
    """Write the greatest speed (m/s) of a point of each body, as `time_stillness` takes it."""
    for i in rows:
        speed[i] = surface_speed(i, inverse_mass, inertia, linear, angular)


@kernel("still")
def time_stillness(rows, dt, inverse_mass, inertia, sleeps, linear, angular, still):
    """Count for how long each body has been slower than SLEEP_SPEED; not those that may not fall asleep."""
    for i in rows:
        slow = surface_speed(i, inverse_mass, inertia, linear, angular) <= SLEEP_SPEED
        still[i] = still[i] + dt if slow and sleeps[i] and inverse_mass[i] > 0.0 else 0.0


@inlined
def lowest_of(i, island):
    """Return the lowest row of the island of body i."""
    while island[i] != i:
        island[i] = island[island[i]]
        i = island[i]
    return i


@inlined
def unite(i, o, island):
    """Make one island of those of bodies i and o."""
    i, o = lowest_of(i, island), lowest_of(o, island)
    island[max(i, o)] = min(i, o)


@inlined
def join(rows, body_a, body_b, inverse_mass, island):
    """Join the islands of every two linked bodies that can be pushed; at first each body is one of its own."""
    for i in rows:
        island[i] = i
    for c in range(len(body_a)):
        a, b = body_a[c], body_b[c]
        if a >= 0 and b >= 0 and inverse_mass[a] > 0.0 and inverse_mass[b] > 0.0:
            unite(a, b, island)


@kernel("island")
def find_islands(rows, body_a, body_b, inverse_mass, island):
    """Write for each body the lowest row of its island."""
    join(rows, body_a, body_b, inverse_mass, island)
    for i in rows:
        island[i] = lowest_of(i, island)


@kernel("falls", makes_arrays=True)
def find_sleepers(rows, body_a, body_b, near_a, near_b, inverse_mass, borne, linear, angular, felt, still, falls):
    """Tell who falls asleep: all bodies of an island that has been still for SLEEP_TIME and is held.

    Held is an island that is linked to what stands, or each body of which is ``borne`` or neither moves nor feels any
    force: what only drifts slowly goes on doing so. What is linked to a moving kinematic body stays awake. Islands that
    are ``near`` each other, who would wake each other in the next step, fall asleep together. Returns how many do.
    """
    island, beside = np.arange(len(falls)), np.arange(len(falls))
    join(rows, body_a, body_b, inverse_mass, island)
    stays, held, drifts = np.zeros(len(falls), np.bool_), np.zeros(len(falls), np.bool_), np.zeros(len(falls), np.bool_)
    for i in rows:
        low = lowest_of(i, island)
        stays[low] |= still[i] < SLEEP_TIME
        drifts[low] |= not borne[i] and feels(i, linear, angular, felt)
    for c in range(len(body_a)):
        for i, o in ((body_a[c], body_b[c]), (body_b[c], body_a[c])):
            if i >= 0 and inverse_mass[i] > 0.0 and (o < 0 or inverse_mass[o] == 0.0):
                low = lowest_of(i, island)
                held[low] = True
                stays[low] |= o >= 0 and moves(o, linear, angular)
    for c in range(len(near_a)):
        for i, o in ((near_a[c], near_b[c]), (near_b[c], near_a[c])):
            if i >= 0 and o >= 0 and inverse_mass[i] > 0.0:
                low = lowest_of(i, island)
                if inverse_mass[o] == 0.0:
                    stays[low] |= moves(o, linear, angular)
                else:
                    unite(low, lowest_of(o, island), beside)
    disturbed = np.zeros(len(falls), np.bool_)
    for i in rows:
        low = lowest_of(i, island)
        disturbed[lowest_of(low, beside)] |= inverse_mass[i] > 0.0 and (stays[low] or (drifts[low] and not held[low]))
    number = 0
    for i in rows:
        falls[i] = inverse_mass[i] > 0.0 and not disturbed[lowest_of(lowest_of(i, island), beside)]
        number += falls[i]
    return number


@woven
def moves(i, linear, angular):
    """Tell whether a body moves at all."""
    moved = False
    for k in range(3):
        moved |= linear[i, k] != 0.0 or angular[i, k] != 0.0
    return moved


@woven
def feels(i, linear, angular, felt):
    """Tell whether a body moves or is pushed by forces."""
    return moves(i, linear, angular) or felt[i, 0] != 0.0 or felt[i, 1] != 0.0 or felt[i, 2] != 0.0


@kernel("lively")
def find_lively(colliders, body_row, sensor, moved, asleep, inverse_mass, linear, angular, lively):
    """Tell whose contacts are looked for: colliders of bodies that are awake and move, sensors, and what was moved."""
    for c in colliders:
        i = body_row[c]
        by_itself = i >= 0 and not asleep[i] and (inverse_mass[i] > 0.0 or moves(i, linear, angular))
        lively[c] = by_itself or sensor[c] or moved[c]
