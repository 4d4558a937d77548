"""Crushing: bodies between what is driven and what stands do not keep the impulses by which they cannot be held."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import CRUSHED, CRUSHED_PART
from carom.systems.kernels.kernel import kernel, woven


@kernel("warm_normal", "warm_friction", "warm_rolling", makes_arrays=True)
def let_go_of_crushed(
    rows, count, body_a, body_b, depth, inverse_mass, linear, angular, warm_normal, warm_friction, warm_rolling
):
    """Let those of ``rows`` that are crushed keep a part of all impulses on them; tell whether there are any.

    Something driven overlaps them by more than CRUSHED, or somebody crushed does. Impulses would add up in each step,
    since neither side gives way.
    """
    presses, some = np.zeros(len(inverse_mass), np.bool_), False
    for i in rows:
        presses[i] = inverse_mass[i] == 0.0 and moves(i, linear, angular)
        some |= presses[i]
    spreads, crushed = some, False
    while spreads:
        spreads = False
        for c in range(count):
            i, o = body_a[c], body_b[c]
            if depth[c] > CRUSHED and i >= 0 and o >= 0 and presses[i] != presses[o]:
                into = o if presses[i] else i
                if inverse_mass[into] > 0.0:
                    presses[into] = spreads = crushed = True
    for c in range(count if crushed else 0):
        if is_crushed(body_a[c], presses, inverse_mass) or is_crushed(body_b[c], presses, inverse_mass):
            warm_normal[c] *= CRUSHED_PART
            for k in range(3):
                warm_friction[c, k] *= CRUSHED_PART
                warm_rolling[c, k] *= CRUSHED_PART
    return crushed


@woven
def moves(i, linear, angular):
    """Tell whether body i moves or turns."""
    found = False
    for k in range(3):
        found |= linear[i, k] != 0.0 or angular[i, k] != 0.0
    return found


@woven
def is_crushed(i, presses, inverse_mass):
    """Tell whether body i, or nobody, is one of those that press others but do not move of themselves."""
    return i >= 0 and presses[i] and inverse_mass[i] > 0.0
