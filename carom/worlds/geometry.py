"""Meshes, hulls and height fields in world files: words for them, and reading them from files beside the world."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, model_validator

from carom.systems.shapes import SHAPES
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.model_files import UNITS
from carom.systems.shapes.noise import MOST_OCTAVES
from carom.systems.shapes.shape import Shape
from carom.worlds.errors import WordError
from carom.worlds.files import WorldFiles, joined
from carom.worlds.values import FileName, In, Length, Vector3, Whole, Words, either, word_of

Scale = Annotated[float, In("1", above=0.0)]
Spacing = Annotated[float, In("m", above=0.0)]
Spacings = Annotated[tuple[float, float], In("m", above=0.0)]
Points = list[Annotated[Vector3, In("m")]]
Places = Annotated[int, Whole(2)]
Corner = Annotated[int, Whole(0)]
Faces = list[tuple[Corner, Corner, Corner]]
FILE = "OBJ, STL, PLY or glTF, relative to the world file"
FILE_WORDS = ("file", "image")  # words that name files beside the world


class ModelWords(Words):
    """How to read a model file."""

    scale: Scale = Field(1.0, description="how many times as large as in the file")
    unit: word_of(*UNITS) = Field("m", description="unit of lengths in the file")  # type: ignore[valid-type]
    up: word_of("y", "z") = Field("y", description="axis of the file that points up")  # type: ignore[valid-type]


class MeshWords(ModelWords):
    """A closed mesh."""

    file: FileName | None = Field(None, description=FILE)
    vertices: Points | None = Field(None, description="vertices (m), of which faces are made")
    faces: Faces = Field([], description="triangles: three numbers of vertices each, from 0, outward")

    @model_validator(mode="after")
    def check(self) -> MeshWords:
        """Refuse both sources and neither."""
        _refuse_two_sources(self, "file", "vertices")
        return self


class ConvexWords(ModelWords):
    """The hull of points, stated or those of a model file."""

    points: Points | None = Field(None, description="points (m)")
    faces: Faces | None = Field(None, description="triangles of points that are all corners; found by default")
    file: FileName | None = Field(None, description=FILE)

    @model_validator(mode="after")
    def check(self) -> ConvexWords:
        """Refuse both sources and neither."""
        _refuse_two_sources(self, "points", "file")
        return self


class NoiseWords(Words):
    """Hills and valleys from a seed: at a place the same however large the land is and however near its places are."""

    count: tuple[Places, Places] = Field(description="places along x and z")
    wavelength: Spacing = Field(description="from hill to hill, of the first octave (m)")
    octaves: Annotated[int, Whole(1, MOST_OCTAVES)] = Field(4, description="how many, each of half the wavelength")
    roughness: Annotated[float, In("1", above=0.0, most=1.0)] = Field(
        0.5, description="height of an octave over that of the one before"
    )
    seed: Annotated[int, Whole(0, 2**53)] = Field(0, description="which land; that of the world has no part in it")


class HeightFieldWords(Words):
    """Land, by rows of heights, a grey image or noise, seen as on a map with -z up: the first row lies at the back."""

    heights: list[list[Length]] | None = Field(None, description="rows of heights (m), each from -x to +x")
    image: FileName | None = Field(None, description="grey image, PNG of 8 or 16 bits, relative to the world file")
    noise: NoiseWords | None = Field(None, description="hills and valleys from a seed")
    spacing: either(Spacing, Spacings, list) = Field(description="distance of neighbours (m), one or along x and z")  # type: ignore[valid-type]
    low: Length = Field(0.0, description="height of black, and below which noise never is (m)")
    high: Length = Field(1.0, description="height of white, and above which noise never is (m)")

    @model_validator(mode="after")
    def check(self) -> HeightFieldWords:
        """Refuse both sources and neither."""
        _refuse_two_sources(self, "heights", "image", "noise")
        return self


def _refuse_two_sources(words: Any, *names: str) -> None:
    stated = [name for name in names if getattr(words, name) is not None]
    if len(stated) != 1:
        received, accepted = " and ".join(stated) or "none", " or ".join([", ".join(names[:-1]), names[-1]])
        raise WordError("must state one source", received=received, accepted=accepted)


GEOMETRY_WORDS: dict[str, type[Words]] = {
    Mesh.key: MeshWords,
    Convex.key: ConvexWords,
    HeightField.key: HeightFieldWords,
}


class GeometryReader:
    """Reads geometries from files, each once."""

    def __init__(self, files: WorldFiles) -> None:
        self.files = files
        self.known: dict[tuple[Any, ...], Shape] = {}

    def shape(self, key: str, words: dict[str, Any], *, folder: str = "", seen: bool) -> Shape:
        """Return the shape of these words, of a visual where it is only ``seen``; raise DeclarationError.

        Files are named from ``folder``, that of the file in which the words stand.
        """
        words = words | {name: joined(folder, words[name]) for name in FILE_WORDS if name in words}
        files = {name: self.files.find(words[name]) for name in FILE_WORDS if name in words}
        make = SHAPES[key].seen if seen else SHAPES[key].stated
        if not files and "noise" not in words:
            return make(**words)
        known = (key, seen, *sorted((name, _fixed(value)) for name, value in words.items()))
        if known not in self.known:
            self.known[known] = make(**words | files)
        return self.known[known]


def _fixed(value: Any) -> Any:
    """Return the words of noise as pairs, which can be looked up by; `dict` makes words of them again."""
    return tuple(sorted(value.items())) if isinstance(value, dict) else value
