"""Land from noise: the same to the bit wherever it is made, within its bounds, smooth, and of its place alone."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs import DeclarationError
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.noise import SLOPES, STEEPEST, fractal_noise, gradient_noise

GENERATOR = np.random.default_rng(11)
X, Z = GENERATOR.uniform(-40.0, 40.0, (2, 5000))
WORDS: dict[str, Any] = {"count": (33, 17), "wavelength": 8.0}


def plain_hash(x: int, z: int, key: int) -> int:
    """SplitMix64 of two places in Python's own whole numbers."""
    for place in (x, z):
        key = ((key ^ (place % 2**64)) + 0x9E3779B97F4A7C15) % 2**64
        key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        key = (key ^ (key >> 27)) * 0x94D049BB133111EB % 2**64
        key ^= key >> 31
    return key


def plain_noise(x: float, z: float, key: int) -> float:
    """Gradient noise of one place in Python's own numbers."""
    i, j = math.floor(x), math.floor(z)
    u, v = x - i, z - j

    def corner(right: int, front: int) -> float:
        slope = SLOPES[plain_hash(i + right, j + front, key) >> 61].tolist()
        return float(slope[0] * (u - right) + slope[1] * (v - front))

    def blend(start: float, end: float, share: float) -> float:
        return start + share * share * share * (share * (share * 6.0 - 15.0) + 10.0) * (end - start)

    return blend(blend(corner(0, 0), corner(0, 1), v), blend(corner(1, 0), corner(1, 1), v), u)


def test_every_bit_is_that_of_plain_arithmetic() -> None:
    """What NumPy makes of arrays is what + - * / make of one number after another: the same on every machine."""
    made = gradient_noise(X[:500], Z[:500], 12345)
    assert made.tolist() == [plain_noise(x, z, 12345) for x, z in zip(X[:500].tolist(), Z[:500].tolist(), strict=True)]


def test_a_place_has_one_height() -> None:
    """Whatever is asked for beside it, in whatever order, however near; another seed is other land."""
    whole, order = fractal_noise(X, Z, 8.0, 4, 0.5, 3), GENERATOR.permutation(len(X))
    assert fractal_noise(X[order], Z[order], 8.0, 4, 0.5, 3).tolist() == whole[order].tolist()
    assert [float(fractal_noise(X[k : k + 1], Z[k : k + 1], 8.0, 4, 0.5, 3)[0]) for k in range(50)] == whole[
        :50
    ].tolist()
    other = fractal_noise(X, Z, 8.0, 4, 0.5, 4)
    assert abs(np.corrcoef(whole, other)[0, 1]) < 0.1
    small, large = (
        HeightField.stated(noise=WORDS | {"count": count}, spacing=step).geometry.vertices
        for count, step in (((33, 17), 0.5), ((129, 129), 0.25))
    )
    inside = {(x, z): y for x, y, z in large.tolist()}
    assert all(inside[x, z] == y for x, y, z in small.tolist())


@pytest.mark.parametrize("octaves", [1, 5])
def test_heights_keep_to_their_bounds_and_use_them(octaves: int) -> None:
    """Never below 0 or above 1, a half in the mean, and of one octave most of what is between."""
    share = np.concatenate([fractal_noise(X, Z, 5.0, octaves, 0.6, seed) for seed in range(20)])
    assert share.min() >= 0.0 and share.max() <= 1.0
    assert share.mean() == pytest.approx(0.5, abs=0.01)
    assert share.max() - share.min() > (0.8 if octaves == 1 else 0.6)
    assert gradient_noise(np.arange(-9.0, 9.0), np.arange(18.0), 5).tolist() == [0.0] * 18
    middle = np.array([[0.5, 0.5]])
    corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]], np.float64)
    away = (middle - corners) / STEEPEST  # the slopes that all rise towards the middle of a cell
    assert (away * (middle - corners)).sum(axis=1).max() == pytest.approx(STEEPEST)


def test_land_is_smooth_also_where_cells_meet() -> None:
    """Height, slope and curvature go on across the lines of whole places."""
    lines, along, h = np.arange(-20.0, 20.0), GENERATOR.uniform(-9.0, 9.0, 40), 1e-3
    for swapped in (False, True):
        places = [(lines + k * h, along) for k in (-2, -1, 0, 1, 2)]
        back, before, here, after, beyond = (
            gradient_noise(*(place[::-1] if swapped else place), 9) for place in places
        )
        np.testing.assert_allclose(before, after, rtol=0, atol=4.0 * h)
        np.testing.assert_allclose((here - before) / h, (after - here) / h, rtol=0, atol=30.0 * h)
        np.testing.assert_allclose(
            (here - 2 * before + back) / h**2, (beyond - 2 * after + here) / h**2, rtol=0, atol=300.0 * h
        )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            {"octaves": 6},
            "noise: octave 6 has a wavelength of 0.25 m, which places 0.5 m apart cannot show; take fewer octaves, a longer wavelength, or a spacing of at most 0.125 m",
        ),
        (
            {"count": (33, 1), "octaves": 0, "roughness": 2.0},
            "noise: needs at least 2 x 2 places, 1 to 16 octaves, a roughness above 0 and at most 1 and a finite wavelength above 0 m, received 33 x 1, 0, 2 and 8 m",
        ),
        (
            {"count": (10**9, 10**9)},
            "noise: 1000000000 x 1000000000 heights make 1,999,999,996,000,000,002 triangles, more than the 1,000,000 a mesh may have; take fewer, or split the land",
        ),
    ],
)
def test_noise_that_makes_no_land(words: dict[str, Any], message: str) -> None:
    """What places cannot show, and what is too large, is told before anything is made."""
    with pytest.raises(DeclarationError) as caught:
        HeightField.stated(noise=WORDS | words, spacing=0.5)
    assert str(caught.value) == message
