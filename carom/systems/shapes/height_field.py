"""Height field: land that is solid all the way down."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.systems.constants import MOST_TRIANGLES
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.shape import NO_AXES, MassProperties, Surface


@dataclass(frozen=True)
class HeightField(Mesh):
    """Heights (m) along local y on a grid in x and z about the origin; static. `stated` makes its geometry."""

    key: ClassVar[str] = "height_field"
    number: ClassVar[int] = 10

    @classmethod
    def stated(  # type: ignore[override]
        cls,
        *,
        heights: npt.ArrayLike | None = None,
        image: str | Path | None = None,
        spacing: float | Sequence[float],
        low: float = 0.0,
        high: float = 1.0,
    ) -> Self:
        """Return the land of ``heights`` (m), rows, or of a grey ``image``, black at ``low``, white at ``high``.

        As on a map with -z up: the first row lies at the back, each from -x to +x, ``spacing`` (m) apart, one or along
        x and z. Raises DeclarationError.
        """
        if (heights is None) is (image is None):
            raise DeclarationError("height_field: must state one source, heights or image")
        steps: Floats = np.broadcast_to(np.asarray(spacing, np.float64), 2)
        if not (np.isfinite(steps).all() and (steps > 0.0).all()):
            raise DeclarationError(f"height_field.spacing: must be finite and above 0 m, received {spacing}")
        if image is None:
            return cls(land(_rows(heights), float(steps[0]), float(steps[1]), "heights"))
        return cls(
            land(low + (high - low) * read_grey(Path(image)), float(steps[0]), float(steps[1]), f"image file {image}")
        )

    def words(self) -> dict[str, Any]:
        """Return its rows of heights and their spacing."""
        x, heights, z = self.geometry.vertices.T
        columns = int(np.count_nonzero(z == z[0]))
        rows = len(z) // columns
        spacing = [_step(x[:columns]), _step(z[::columns])]
        return {"heights": heights.reshape(rows, columns).tolist(), "spacing": spacing}

    def mass_properties(self) -> MassProperties:
        """Return an infinite volume: land is static."""
        return MassProperties(math.inf, (0.0, 0.0, 0.0), (math.inf,) * 3, NO_AXES)

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Raise DeclarationError: land goes down for ever."""
        raise DeclarationError(f"{cls.key}: has no volume known that a medium could bear")

    def surface(self) -> Surface:
        """Return the triangles, open at the rim and below."""
        return super().surface()._replace(smooth=True)


def land(heights: Floats, along_x: float, along_z: float, source: str) -> Geometry:
    """Return two triangles for each cell of ``heights`` (rows, columns); raise DeclarationError for too few or many."""
    rows, columns = heights.shape
    if rows < 2 or columns < 2:
        raise DeclarationError(f"{source}: land needs at least 2 x 2 heights, received {rows} x {columns}")
    if not np.isfinite(heights).all():
        row, column = np.argwhere(~np.isfinite(heights))[0]
        bad = f"{heights[row, column]} in row {row}, column {column}"
        raise DeclarationError(f"{source}: heights must be finite, received {bad}")
    if (count := 2 * (rows - 1) * (columns - 1)) > MOST_TRIANGLES:
        raise DeclarationError(
            f"{source}: {rows} x {columns} heights make {count:,} triangles, more than the {MOST_TRIANGLES:,} "
            "a mesh may have; take fewer, or split the land"
        )
    z, x = np.meshgrid(
        (np.arange(rows) - (rows - 1) / 2.0) * along_z,
        (np.arange(columns) - (columns - 1) / 2.0) * along_x,
        indexing="ij",
    )
    vertices = np.stack([x, heights, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    right, front = corner + 1, corner + columns
    faces = np.concatenate([np.stack([corner, front, right], 1), np.stack([right, front, front + 1], 1)])
    return Geometry(np.ascontiguousarray(vertices), faces, source)


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


def _step(places: Floats) -> float:
    """Return the step (m) that makes these places along a grid about 0, to the bit where there is one."""
    middle = (len(places) - 1) / 2.0
    step = float(places[-1] / middle)
    near = (step, float(np.nextafter(step, 0.0)), float(np.nextafter(step, np.inf)))
    return next((one for one in near if np.array_equal((np.arange(len(places)) - middle) * one, places)), step)


def _rows(heights: Any) -> Floats:
    lengths = {len(row) for row in heights} if np.ndim(heights[0] if len(heights) else 0) == 1 else set()
    if len(lengths) != 1:
        received = f"rows of {', '.join(map(str, sorted(lengths)))}" if lengths else "none"
        raise DeclarationError(f"heights: must be rows of as many numbers each, received {received}")
    return np.asarray(heights, np.float64)
