"""Finish: how a surface looks where a model file says so, beyond one colour."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.systems.constants import MOST_TRIANGLES
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.model_files import Axis, Unit, read_parts, refuse_numbers, vertices_and_faces

GAMMA = 2.0  # as pictures are shaded, near sRGB's


@dataclass(frozen=True, eq=False)
class Finish:
    """An image (h, w, 4) put on by ``coordinates`` (v, 2), 0..1 from its corner on the left at the bottom.

    ``metallic`` and ``roughness`` are glTF's, 0..1; ``two_sided`` is seen from behind too.
    """

    image: npt.NDArray[np.uint8]
    coordinates: Floats
    metallic: float = 0.0
    roughness: float = 1.0
    two_sided: bool = False

    @property
    def translucent(self) -> bool:
        """Tell whether anything of it lets through what is behind."""
        return bool((self.image[..., 3] < 255).any())

    def content(self) -> bytes:
        """Return what tells it from others."""
        numbers = np.array((self.metallic, self.roughness, self.two_sided, *self.image.shape), np.float64)
        return numbers.tobytes() + self.image.tobytes() + np.ascontiguousarray(self.coordinates).tobytes()


class Part(NamedTuple):
    """Triangles of one finish, None for the colour of the entity alone."""

    vertices: Floats
    faces: Integers
    finish: Finish | None

    def content(self) -> bytes:
        """Return what tells it from others with the same triangles."""
        return len(self.faces).to_bytes(8, "little") + (b"" if self.finish is None else self.finish.content())


def load_seen(file: str | Path, *, scale: float = 1.0, unit: Unit = "m", up: Axis = "y") -> Geometry:
    """Read triangles that are only seen, as they are in the file: they may be open, and glTF brings their finish.

    Of a glTF material that is the base colour, texture times factor, how metallic and how rough it is, and whether it
    has two sides. Raises DeclarationError when the file is missing or unreadable, or holds no triangles or too many.
    """
    source = f"mesh file {file}"
    refuse_numbers(source, scale, unit, up)
    parts = []
    for mesh in read_parts(Path(file)):
        vertices, faces = vertices_and_faces(source, mesh, scale, unit, up)
        parts.append(Part(vertices, faces, finish_of(getattr(mesh, "visual", None), len(vertices))))
    before = np.cumsum([0, *(len(part.vertices) for part in parts)])
    vertices = np.concatenate([part.vertices for part in parts])
    faces = np.concatenate([part.faces + first for part, first in zip(parts, before, strict=False)])
    if not 0 < len(faces) <= MOST_TRIANGLES:
        raise DeclarationError(f"{source} holds {len(faces):,} triangles; accepted: 1 to {MOST_TRIANGLES:,}")
    return Geometry(vertices, faces, str(file), parts=tuple(parts))


def finish_of(visual: Any, count: int) -> Finish | None:
    """Return the finish of what trimesh has read of a glTF material, None where there is none."""
    from trimesh.visual.material import PBRMaterial

    material = getattr(visual, "material", None)
    if not isinstance(material, PBRMaterial):
        return None
    factor = (
        np.ones(4) if material.baseColorFactor is None else np.asarray(material.baseColorFactor, np.float64) / 255.0
    )
    coordinates = getattr(visual, "uv", None)
    texture = material.baseColorTexture if coordinates is not None else None
    pixels = np.full((1, 1, 4), 255, np.uint8) if texture is None else np.array(texture.convert("RGBA"))
    if material.alphaMode in (None, "OPAQUE"):
        pixels[..., 3], factor[3] = 255, 1.0
    shown = np.append(factor[:3] ** (1.0 / GAMMA), factor[3])  # factors are of light, images are as on a screen
    rough = (
        np.ones(2)
        if (map_ := material.metallicRoughnessTexture) is None
        else np.array(map_)[..., 1:3].mean((0, 1)) / 255.0
    )
    return Finish(
        np.rint(pixels * shown).astype(np.uint8),
        np.zeros((count, 2)) if coordinates is None else np.array(coordinates, np.float64),
        float(rough[1]) * _or_one(material.metallicFactor),
        float(rough[0]) * _or_one(material.roughnessFactor),
        bool(material.doubleSided),
    )


def _or_one(factor: float | None) -> float:
    return 1.0 if factor is None else float(factor)
