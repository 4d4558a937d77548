"""Angles in lanes, from + - * / and roots alone."""

from __future__ import annotations

from math import pi

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY
from carom.systems.kernels.lanes import choose, larger, root, smaller, spread, whole

WHOLE_TURN = 2.0 * pi


@woven
def arc_tangent(y, x):
    """Return the angle (rad, within -pi..pi) from the direction +x to (x, y), 0 where both are 0.

    The tangent t in [0, 1] of the smaller over the larger is halved twice, tan(a/2) = t / (1 + sqrt(1 + t^2)), and
    Taylor's series is taken to its term below 1e-17.
    """
    wide, tall = larger(x, -x), larger(y, -y)
    t = smaller(wide, tall) / larger(larger(wide, tall), spread(TINY))
    t = t / (1.0 + root(1.0 + t * t))
    t = t / (1.0 + root(1.0 + t * t))
    z = t * t
    series = spread(1.0 / 21.0)
    for n in (19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0):
        series = 1.0 / n - z * series
    angle = 4.0 * (t * series)
    angle = choose(tall - wide, 0.5 * pi - angle, angle)
    angle = choose(-x, pi - angle, angle)
    return choose(-y, -angle, angle)


@woven
def nearest_turn(angle, before):
    """Return the angle, with as many whole turns as bring it nearest to what it was before."""
    return angle + WHOLE_TURN * whole((before - angle) / WHOLE_TURN + 0.5)
