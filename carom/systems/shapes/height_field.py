"""Height field: land that is solid all the way down."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.systems.shapes.land import land, noisy, read_grey, rows_of
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
        noise: Mapping[str, Any] | None = None,
        spacing: float | Sequence[float],
        low: float = 0.0,
        high: float = 1.0,
    ) -> Self:
        """Return the land of ``heights`` (m), rows, or of a grey ``image``, black at ``low``, white at ``high``.

        As on a map with -z up: the first row lies at the back, each from -x to +x, ``spacing`` (m) apart, one or along
        x and z. Or it is made of ``noise``, whose words are those of `noisy`, from ``low`` to ``high`` (m). Raises
        DeclarationError.
        """
        if sum(source is not None for source in (heights, image, noise)) != 1:
            raise DeclarationError("height_field: must state one source, heights, image or noise")
        steps: Floats = np.broadcast_to(np.asarray(spacing, np.float64), 2)
        if not (np.isfinite(steps).all() and (steps > 0.0).all()):
            raise DeclarationError(f"height_field.spacing: must be finite and above 0 m, received {spacing}")
        along_x, along_z = steps.tolist()
        if heights is not None:
            return cls(land(rows_of(heights), along_x, along_z, "heights"))
        if image is not None:
            return cls(land(low + (high - low) * read_grey(Path(image)), along_x, along_z, f"image file {image}"))
        return cls(land(low + (high - low) * noisy(along_x, along_z, **(noise or {})), along_x, along_z, "noise"))

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


def _step(places: Floats) -> float:
    """Return the step (m) that makes these places along a grid about 0, to the bit where there is one."""
    middle = (len(places) - 1) / 2.0
    step = float(places[-1] / middle)
    near = (step, float(np.nextafter(step, 0.0)), float(np.nextafter(step, np.inf)))
    return next((one for one in near if np.array_equal((np.arange(len(places)) - middle) * one, places)), step)
