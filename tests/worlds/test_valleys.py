"""The valleys of the library are the lowest places of its land, rolled over by its balls; land is written as noise."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs.column import Floats
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.noise import fractal_noise
from carom.worlds import load_text, load_world, world_text

STEP = 0.01  # of the places looked at, m


def height(x: Floats, z: Floats) -> Floats:
    """Return the height of land that is even on triangles between the places of the noise."""
    places = np.arange(33) * 0.5 - 8.0
    noise = fractal_noise(places[None, :] + 0.0 * places[:, None], places[:, None] + 0.0 * places, 6.0, 2, 0.35, 5)
    land = 4.0 * noise - 2.0
    column, row = ((along + 8.0) / 0.5 for along in (x, z))
    i, j = column.astype(int), row.astype(int)
    a, b = column - i, row - j
    back = land[j, i] + a * (land[j, i + 1] - land[j, i]) + b * (land[j + 1, i] - land[j, i])
    far = land[j + 1, i + 1]
    front = far + (1.0 - a) * (land[j + 1, i] - far) + (1.0 - b) * (land[j, i + 1] - far)
    return np.where(a + b <= 1.0, back, front)


@pytest.mark.parametrize("name", ["west", "south", "east"])
def test_balls_rest_where_their_centres_are_lowest(name: str) -> None:
    """Within half a metre of where the file says, no place of a ball that touches the land is lower than that."""
    said = [item for item in load_world("valleys").document["expect"] if item.get("at") == "8 s"]
    (expected,) = [item[f"{name}.position"]["is"] for item in said if f"{name}.position" in item]
    around = np.arange(-0.75, 0.75 + STEP / 2.0, STEP)
    x, z = np.meshgrid(expected[0] + around, expected[2] + around)
    land, reach = height(x, z), round(0.25 / STEP)
    inner = slice(reach, len(around) - reach)
    lies = np.full((inner.stop - inner.start,) * 2, -np.inf)
    for right in range(-reach, reach + 1):
        for front in range(-reach, reach + 1):
            left = 0.25**2 - STEP**2 * (right**2 + front**2)
            if left >= 0.0:
                there = land[inner.start + front : inner.stop + front, inner.start + right : inner.stop + right]
                lies = np.maximum(lies, there + math.sqrt(left))
    row, column = np.unravel_index(lies.argmin(), lies.shape)
    found = x[inner, inner][row, column], lies.min(), z[inner, inner][row, column]
    np.testing.assert_allclose(found, expected, rtol=0, atol=5e-3)


def test_land_of_noise_is_written_as_noise() -> None:
    """In its words, which make the same land."""
    land = "{height_field: {noise: {count: [9, 5], wavelength: 4, seed: 3}, spacing: 0.25, low: -1}}"
    loaded = load_text(f"carom: 1\nentities: [{{name: land, collider: {land}}}]\n")
    text = world_text(loaded)
    assert "{height_field: {low: -1, noise: {count: [9, 5], seed: 3, wavelength: 4}, spacing: 0.25}}" in text
    one, other = (world[Geometries].items[0] for world in (loaded.simulation.world, load_text(text).simulation.world))
    assert one.vertices.tobytes() == other.vertices.tobytes()
