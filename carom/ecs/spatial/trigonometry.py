"""Sine, cosine and exponential from + - * / alone, so that their last bit is the same on every machine.

libm and NumPy choose other code by CPU. These are plain functions; kernels compile them as they stand.
"""

import math
from typing import TypeVar

import numpy as np
import numpy.typing as npt

Real = TypeVar("Real", float, npt.NDArray[np.float64])

QUARTER_TURN = 1.5707963267341256  # pi/2 to 33 bits, so that small multiples of it are exact
QUARTER_TURN_REST = 6.077100506506192e-11
EIGHTH_SQUARED = 0.25 * QUARTER_TURN * QUARTER_TURN  # up to where `even_series` is right
SINE_11, SINE_13, SINE_15 = -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000
COSINE_10, COSINE_12 = -1.0 / 3628800, 1.0 / 479001600
COSINE_14, COSINE_16 = -1.0 / 87178291200, 1.0 / 20922789888000
LN2 = 0.6931471803691238  # likewise ln 2
LN2_REST = 1.9082149292705877e-10
LARGEST_EXPONENT = 700.0  # e^700 is near the largest float64


def even_series(z: Real) -> tuple[Real, Real]:
    """Return (sin x / x - 1) / z and cos x of z = x^2, x (rad) in [-pi/4, pi/4]: a turn needs no root of its square.

    By Taylor's series to the term below 1e-17, of one angle, of an array of them, or of a lane. Terms are added as
    Estrin has it (Computing Surveys 1960; Muller, Elementary Functions, 3rd ed., 4.4): few wait for each other.
    """
    zz = z * z
    s = (
        (-1.0 / 6 + z * (1.0 / 120))
        + zz * (-1.0 / 5040 + z * (1.0 / 362880))
        + zz * zz * (SINE_11 + z * SINE_13 + zz * SINE_15)
    )
    c = (
        (1.0 / 24 + z * (-1.0 / 720))
        + zz * (1.0 / 40320 + z * COSINE_10)
        + zz * zz * (COSINE_12 + z * COSINE_14 + zz * COSINE_16)
    )
    return s, 1.0 - (0.5 * z - zz * c)


def series(x: Real) -> tuple[Real, Real]:
    """Return sin and cos of ``x`` (rad) in [-pi/4, pi/4] by `even_series`."""
    z = x * x
    s, c = even_series(z)
    return x + x * z * s, c


def sine_cosine(angle: float) -> tuple[float, float]:
    """Return sin and cos of ``angle`` (rad) for |angle| < 1e6 within 2 units in the last place, next to zeros of 1e-3.

    Cody and Waite's reduction to [-pi/4, pi/4] (Software Manual for the Elementary Functions, 1980, chapter 8).
    """
    turns = math.floor(angle / QUARTER_TURN + 0.5)
    x = (angle - turns * QUARTER_TURN) - turns * QUARTER_TURN_REST
    s, c = series(x)
    quadrant = turns - 4.0 * math.floor(turns / 4.0)
    if quadrant == 0.0:
        return s, c
    if quadrant == 1.0:
        return c, -s
    if quadrant == 2.0:
        return -s, -c
    return -c, s


def exponential(x: float) -> float:
    """Return e^x within 2 units in the last place; 0 below -700, and x is held to 700 above."""
    if x < -LARGEST_EXPONENT:
        return 0.0
    x = min(x, LARGEST_EXPONENT)
    halvings = math.floor(x / LN2 + 0.5)
    r = (x - halvings * LN2) - halvings * LN2_REST
    total = 1.0
    for k in range(17, 0, -1):
        total = 1.0 + r / k * total
    base, power = (2.0, halvings) if halvings >= 0 else (0.5, -halvings)
    for _ in range(int(power)):
        total *= base
    return total
