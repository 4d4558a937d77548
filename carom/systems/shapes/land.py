"""Land: triangles over a grid of heights, which are stated, those of an image, or made of noise."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.systems.constants import MOST_TRIANGLES
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.noise import MOST_OCTAVES, fractal_noise


def land(heights: Floats, along_x: float, along_z: float, source: str) -> Geometry:
    """Return two triangles for each cell of ``heights`` (rows, columns); raise DeclarationError for too few or many."""
    rows, columns = heights.shape
    if rows < 2 or columns < 2:
        raise DeclarationError(f"{source}: land needs at least 2 x 2 heights, received {rows} x {columns}")
    if not np.isfinite(heights).all():
        row, column = np.argwhere(~np.isfinite(heights))[0]
        bad = f"{heights[row, column]} in row {row}, column {column}"
        raise DeclarationError(f"{source}: heights must be finite, received {bad}")
    _refuse_size(rows, columns, source)
    x, z = _places(rows, columns, along_x, along_z)
    vertices = np.stack([x, heights, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    right, front = corner + 1, corner + columns
    faces = np.concatenate([np.stack([corner, front, right], 1), np.stack([right, front, front + 1], 1)])
    return Geometry(np.ascontiguousarray(vertices), faces, source)


def noisy(
    along_x: float,
    along_z: float,
    *,
    count: Sequence[int],
    wavelength: float,
    octaves: int = 4,
    roughness: float = 0.5,
    seed: int = 0,
) -> Floats:
    """Return shares (rows, columns), in 0..1, of land that is made by `fractal_noise` of these words.

    ``count`` are the places along x and z. Raises DeclarationError for what the land cannot show.
    """
    columns, rows = count
    if (
        min(count) < 2
        or not 1 <= octaves <= MOST_OCTAVES
        or not 0.0 < roughness <= 1.0
        or not 0.0 < wavelength < math.inf
    ):
        raise DeclarationError(
            f"noise: needs at least 2 x 2 places, 1 to {MOST_OCTAVES} octaves, a roughness above 0 and at most 1 and a "
            f"finite wavelength above 0 m, received {columns} x {rows}, {octaves}, {roughness:g} and {wavelength:g} m"
        )
    _refuse_size(rows, columns, "noise")
    finest, step = wavelength / 2.0 ** (octaves - 1), max(along_x, along_z)
    if finest < 2.0 * step:
        raise DeclarationError(
            f"noise: octave {octaves} has a wavelength of {finest:.3g} m, which places {step:.3g} m apart cannot show; "
            f"take fewer octaves, a longer wavelength, or a spacing of at most {finest / 2.0:.3g} m"
        )
    return fractal_noise(*_places(rows, columns, along_x, along_z), wavelength, octaves, roughness, seed)


def _places(rows: int, columns: int, along_x: float, along_z: float) -> tuple[Floats, Floats]:
    """Return x and z (rows, columns), m, of the places of land."""
    z, x = np.meshgrid(
        (np.arange(rows) - (rows - 1) / 2.0) * along_z,
        (np.arange(columns) - (columns - 1) / 2.0) * along_x,
        indexing="ij",
    )
    return x, z


def _refuse_size(rows: int, columns: int, source: str) -> None:
    """Raise DeclarationError for land of too many triangles."""
    if (count := 2 * (rows - 1) * (columns - 1)) > MOST_TRIANGLES:
        raise DeclarationError(
            f"{source}: {rows} x {columns} heights make {count:,} triangles, more than the {MOST_TRIANGLES:,} "
            "a mesh may have; take fewer, or split the land"
        )


def read_grey(path: Path) -> Floats:
    """Return an image as shares of white (rows, columns), 8 or 16 bits deep; raise DeclarationError."""
    from PIL import Image, UnidentifiedImageError

    if not path.is_file():
        raise DeclarationError(f"image file {path} does not exist")
    try:
        with Image.open(path) as image:
            deep = image.mode.startswith("I")
            values = np.asarray(image if deep else image.convert("L"), np.float64)
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError) as fault:
        raise DeclarationError(f"image file {path} cannot be read: {fault}") from None
    return values / (65535.0 if deep else 255.0)


def rows_of(heights: Any) -> Floats:
    """Return rows of heights (rows, columns) that are stated; raise DeclarationError."""
    lengths = {len(row) for row in heights} if np.ndim(heights[0] if len(heights) else 0) == 1 else set()
    if len(lengths) != 1:
        received = f"rows of {', '.join(map(str, sorted(lengths)))}" if lengths else "none"
        raise DeclarationError(f"heights: must be rows of as many numbers each, received {received}")
    return np.asarray(heights, np.float64)
