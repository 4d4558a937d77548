"""Spending the trust in contacts of a pair, as a look on its way does."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.column import Booleans, Floats
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.trust import ask_straying, spend_trust

UPRIGHT = np.tile((0.0, 0.0, 0.0, 1.0), (2, 1))
PLACES = np.array([[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]])


@kernel("left", "times", "asked", makes_arrays=True)
def spend_and_ask(
    elapsed, span, ahead, bodies, numbers, center, turns, linear, angular, before, angular_before, struck, left, times,
    asked,
):  # fmt: skip
    """Spend the trust in contacts, then ask who strays."""
    spend_trust(
        elapsed, span, bodies, numbers, center, turns, linear, angular, before, angular_before, struck, left, times
    )
    ask_straying(ahead, span, bodies, numbers, turns, linear, angular, before, asked, np.zeros(len(asked), np.bool_))


def spend(
    elapsed: float, numbers: Floats, left: Floats, linear: Floats, angular: Floats, before: Floats,
    angular_before: Floats | None = None, *, bodies: tuple[int, int] = (0, -1), turns: Floats = UPRIGHT,
    ahead: float = 0.01, span: float = 0.01, asked: Booleans | None = None, struck: Booleans | None = None,
    times: Floats | None = None,
) -> None:  # fmt: skip
    """Write what is ``left`` (m), when it is to be looked at (s), and who is ``asked``, of one pair after a flight."""
    spend_and_ask(
        elapsed, span, ahead, np.array([bodies]), numbers, PLACES, turns, linear, angular, before,
        angular if angular_before is None else angular_before, np.zeros(2, np.bool_) if struck is None else struck,
        left, np.zeros(1) if times is None else times, np.zeros(1, np.bool_) if asked is None else asked,
    )  # fmt: skip
