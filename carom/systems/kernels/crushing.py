"""Crushing: bodies between what is driven and what stands do not keep the impulses by which they cannot be held."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import CRUSHED, CRUSHED_PART
from carom.systems.kernels.kernel import kernel, making, woven


@kernel("warm_normal", "warm_friction", "warm_rolling", "crushed", makes_arrays=True)
def let_go_of_crushed(
    rows, count, body_a, body_b, depth, inverse_mass, linear, angular, warm_normal, warm_friction, warm_rolling, crushed
):
    """Let who is ``crushed`` keep a part of all impulses on it; tell whether anybody is. All that moves is in ``rows``.

    That is who is held between what is driven and what stands, and overlaps somebody by more than CRUSHED. Impulses
    would add up in each step, since neither side gives way.
    """
    deep, driven = False, False
    crushed[:] = False
    for c in range(count):
        deep |= depth[c] > CRUSHED
    for i in rows if deep else rows[:0]:
        driven |= inverse_mass[i] == 0.0 and moves(i, linear, angular)
    if not driven:
        return False
    reached = reached_from_both(count, body_a, body_b, depth, inverse_mass, linear, angular, warm_normal)
    some = False
    for c in range(count):
        for i in (body_a[c], body_b[c]):
            if depth[c] > CRUSHED and i >= 0 and inverse_mass[i] > 0.0 and reached[i, 0] and reached[i, 1]:
                crushed[i] = some = True
    for c in range(count if some else 0):
        if is_among(body_a[c], crushed) or is_among(body_b[c], crushed):
            warm_normal[c] *= CRUSHED_PART
            for k in range(3):
                warm_friction[c, k] *= CRUSHED_PART
                warm_rolling[c, k] *= CRUSHED_PART
    return some


@making
def reached_from_both(count, body_a, body_b, depth, inverse_mass, linear, angular, warm_normal):
    """Return of each body, and at last of nobody, whether something driven is behind it, and something that stands."""
    nobody = len(inverse_mass)
    reached = np.zeros((nobody + 1, 2), np.bool_)
    reached[nobody, 1] = True
    for i in range(nobody):
        if inverse_mass[i] == 0.0:
            reached[i, 0 if moves(i, linear, angular) else 1] = True
    spreads = True
    while spreads:
        spreads = False
        for c in range(count):
            if warm_normal[c] <= 0.0 and depth[c] <= CRUSHED:
                continue
            for i, o in ((body_a[c], body_b[c]), (body_b[c], body_a[c])):
                if o >= 0 and inverse_mass[o] > 0.0:
                    for side in range(2):
                        if reached[i if i >= 0 else nobody, side] and not reached[o, side]:
                            reached[o, side] = spreads = True
    return reached


@woven
def moves(i, linear, angular):
    """Tell whether body i moves or turns."""
    found = False
    for k in range(3):
        found |= linear[i, k] != 0.0 or angular[i, k] != 0.0
    return found


@woven
def is_among(i, bodies):
    """Tell whether body i, or nobody, is one of those."""
    return i >= 0 and bodies[i]
