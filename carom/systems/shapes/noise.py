"""Noise: hills and valleys from a seed, at every place the same to the bit, on every machine."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats

Hashes = npt.NDArray[np.uint64]
MOST_OCTAVES = 16
STEEPEST = math.sqrt(0.5)  # beyond which no sum of slopes of length 1 goes, on either side of 0: K. Perlin, 2002
MASK, GOLDEN = 2**64 - 1, 0x9E3779B97F4A7C15
SLOPES = np.array([(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)], np.float64)
SLOPES /= np.sqrt((SLOPES * SLOPES).sum(axis=1, keepdims=True))


def fractal_noise(x: Floats, z: Floats, wavelength: float, octaves: int, roughness: float, seed: int) -> Floats:
    """Return how high the land is at places ``x``, ``z`` (m, one shape), in 0..1, about one half of it.

    It is the sum of ``octaves`` of gradient noise: the first has hills of one ``wavelength`` (m), each further one
    those of half the wavelength and ``roughness`` times the height. What is at a place depends on nothing else. With
    + - * / and whole numbers alone, since land is state. Source: K. Perlin, Improving noise, SIGGRAPH 2002;
    B. Mandelbrot, The fractal geometry of nature, 1982, chapter 28.
    """
    total, whole, weight = np.zeros(np.shape(x)), 0.0, 1.0
    for octave in range(octaves):
        key = _stirred(seed + GOLDEN * (octave + 1))
        shift = [share / 2.0**32 for share in divmod(key, 2**32)]  # that no two octaves are level at the same places
        total += weight * gradient_noise(x / wavelength + shift[0], z / wavelength + shift[1], key)
        whole, weight, wavelength = whole + weight, weight * roughness, wavelength / 2.0
    return np.clip(0.5 + 0.5 / STEEPEST * (total / whole), 0.0, 1.0)


def gradient_noise(x: Floats, z: Floats, key: int) -> Floats:
    """Return noise at places, within `STEEPEST` of 0: 0 where both are whole, with a slope drawn by ``key``."""
    low_x, low_z = np.floor(x), np.floor(z)
    across, along = x - low_x, z - low_z
    corners = []
    for right in (0, 1):
        for front in (0, 1):
            slope = SLOPES[_hashes(low_x + right, low_z + front, key) >> np.uint64(61)]
            corners.append(slope[..., 0] * (across - right) + slope[..., 1] * (along - front))
    left, right_side = (_blend(corners[k], corners[k + 1], along) for k in (0, 2))
    return _blend(left, right_side, across)


def _blend(start: Floats, end: Floats, share: Floats) -> Floats:
    """Return what is between two values, level in slope and curvature at both."""
    return start + share * share * share * (share * (share * 6.0 - 15.0) + 10.0) * (end - start)


def _hashes(x: Floats, z: Floats, key: int) -> Hashes:
    """Return whole numbers, as good as drawn, for whole places: SplitMix64, G. Steele and others, OOPSLA 2014."""
    mixed = np.full(np.shape(x), key, np.uint64)
    for place in (x, z):
        mixed = (mixed ^ place.astype(np.int64).view(np.uint64)) + np.uint64(GOLDEN)
        for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
            mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
        mixed ^= mixed >> np.uint64(31)
    return mixed


def _stirred(number: int) -> int:
    """Return the same of one whole number."""
    return int(_hashes(np.zeros(1), np.zeros(1), number & MASK)[0])
