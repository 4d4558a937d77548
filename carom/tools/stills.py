"""Stills: what cameras see of one moment, as files: pictures, depths and ids."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from carom.systems.simulation import Simulation
from carom.tools.film import save_png
from carom.tools.filming import Shot
from carom.tools.painter import Painter

if TYPE_CHECKING:
    from carom.tools.renderer import Renderer

MILLIMETRE, FARTHEST = 1e-3, 65_535  # m, and of those what 16 bits hold


@dataclass(frozen=True)
class Stills:
    """Which files to write: a picture (.png), depths (.npy or .png) and ids (.npy); with several cameras one of each.

    Depths are float32 in m along the line of sight, infinite where nothing is; a .png has whole millimetres in 16 bits,
    0 where nothing is or farther than 65.535 m. Ids are the rows of entities, -1 where nothing is.
    """

    picture: Path | None = None
    depth: Path | None = None
    ids: Path | None = None

    def paths(self, cameras: list[str]) -> dict[str, list[Path]]:
        """Return the files by kind, in the order of the cameras, whose names are in theirs where there are several."""
        stated = {"picture": self.picture, "depth": self.depth, "ids": self.ids}
        return {
            kind: [path if len(cameras) == 1 else path.with_stem(f"{path.stem}-{name}") for name in cameras]
            for kind, path in stated.items()
            if path is not None
        }

    def save(self, renderer: Renderer, shots: Mapping[str, Shot], simulation: Simulation, painter: Painter) -> None:
        """Write the files of a simulation as it is now."""
        paths = self.paths(list(shots))
        cameras, batches = [shot.camera(simulation.world) for shot in shots.values()], painter.batches()
        if self.picture is not None:
            pictures = painter.pictures(renderer, cameras, batches=batches)
            for path, picture in zip(paths["picture"], pictures, strict=True):
                save_png(path, picture)
        for path, camera in zip(paths.get("depth", []), cameras, strict=False):
            save_depth(path, renderer.depth(batches, camera))
        for path, camera in zip(paths.get("ids", []), cameras, strict=False):
            np.save(path, renderer.ids(batches, camera))


def save_depth(path: Path, depth: npt.NDArray[np.float32]) -> None:
    """Write depths (height, width) in m as they are (.npy), or as millimetres in 16 bits (.png)."""
    if path.suffix.lower() == ".npy":
        np.save(path, depth)
        return
    from PIL import Image

    millimetres = np.round(depth / MILLIMETRE)
    Image.fromarray(np.where(millimetres <= FARTHEST, millimetres, 0.0).astype(np.uint16)).save(path)
