"""Gusts: the waves of which the noise of a wind is made, drawn from the world's seed."""

from __future__ import annotations

from functools import lru_cache
from math import pi

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.angles import sines_cosines

WAVES = 32  # by axis; so many make noise whose fourth moment is that of Gauss's within 2 %
SLOWEST, FASTEST = 0.1, 10.0  # rad in one time scale; slower ones are the wind, faster ones hold a sixteenth
LEAST, MOST = 0.06345103486110715, 0.936548965138893  # 2/pi arctan of these: the shares of the energy that are slower


@lru_cache(64)
def waves(seed: int, number: int) -> tuple[Floats, Floats]:
    """Return rates (3, WAVES), rad in one time scale T, and phases (3, WAVES), rad, of the wind of that number.

    The spectrum is Dryden's along the wind, 2 / (pi (1 + x^2)), from SLOWEST to FASTEST; its autocorrelation would be
    exp(-t / T) without these ends. Each wave has an equal part of the energy and a rate drawn from that part (Borgman,
    Ocean wave simulation for engineering design, 1969), and waves of phases by chance make noise that is nearly that of
    Gauss (Shinozuka and Deodatis, Applied Mechanics Reviews 44, 1991).
    """
    drawn = np.random.Generator(np.random.PCG64([seed, number])).random((2, 3, WAVES))
    share = LEAST + (MOST - LEAST) * (np.arange(WAVES) + drawn[0]) / WAVES
    sine, cosine = sines_cosines(0.5 * pi * share)
    return sine / cosine, 2.0 * pi * drawn[1]
