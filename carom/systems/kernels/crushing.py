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
    """Let those of ``rows`` that something driven overlaps by more than CRUSHED keep a part of all impulses on them.

    Tell whether there are any. Impulses would add up in each step, since neither side gives way.
    """
    driven = False
    for i in rows:
        driven |= is_driven(i, inverse_mass, linear, angular)
    crushed, some = np.zeros(0, np.bool_), False
    for c in range(count if driven else 0):
        if depth[c] > CRUSHED:
            for i, o in ((body_a[c], body_b[c]), (body_b[c], body_a[c])):
                if o >= 0 and inverse_mass[o] > 0.0 and is_driven(i, inverse_mass, linear, angular):
                    if not some:
                        crushed, some = np.zeros(len(inverse_mass), np.bool_), True
                    crushed[o] = True
    for c in range(count if some else 0):
        if (body_a[c] >= 0 and crushed[body_a[c]]) or (body_b[c] >= 0 and crushed[body_b[c]]):
            warm_normal[c] *= CRUSHED_PART
            for k in range(3):
                warm_friction[c, k] *= CRUSHED_PART
                warm_rolling[c, k] *= CRUSHED_PART
    return some


@woven
def is_driven(i, inverse_mass, linear, angular):
    """Tell whether body i, or nobody, moves although nothing can move it."""
    if i < 0 or inverse_mass[i] > 0.0:
        return False
    moves = False
    for k in range(3):
        moves |= linear[i, k] != 0.0 or angular[i, k] != 0.0
    return moves
