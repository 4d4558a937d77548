"""Shapes: the declaration every shape makes in a file of its own, and their registry."""

from __future__ import annotations

import dataclasses
import math
import sys
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Self
from zlib import crc32

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.components.collider import SHAPE_PARAMETERS
from carom.ecs.errors import DeclarationError
from carom.systems.kernels.submersion import FOUND
from carom.systems.parameters import make_plain, number_fault, parameter, words_of
from carom.systems.registry import Keyed, enter

__all__ = ["BY_NUMBER", "NO_AXES", "SHAPES", "Bounds", "MassProperties", "Shape", "Surface", "parameter"]


class Bounds(NamedTuple):
    """A shape lies within a box of half extents ``half`` about ``center`` (m, shape frame), widened by ``radius``."""

    center: tuple[float, float, float]
    half: tuple[float, float, float]
    radius: float

    @property
    def width(self) -> float:
        """Their smallest edge, m."""
        return 2.0 * (min(self.half) + self.radius)


class Surface(NamedTuple):
    """Triangles to draw: vertices (v, 3) in m in the shape frame, faces (f, 3), ``smooth`` where normals blend.

    They are ``off`` (m) the shape at most.
    """

    vertices: Floats
    faces: Integers
    smooth: bool
    off: float = 0.0


class MassProperties(NamedTuple):
    """Of a solid: volume in m3, centre in m, principal moments over mass in m2, their axes as quaternion xyzw."""

    volume: float
    center: tuple[float, float, float]
    inertia: tuple[float, float, float]
    axes: tuple[float, float, float, float]


SHAPES: dict[str, type[Shape]] = {}
BY_NUMBER: dict[int, type[Shape]] = {}
FIRST_OWN_NUMBER = 1000  # carom numbers its shapes from 0; those of others come from here on
NO_AXES = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Shape(Keyed, ABC, registry=SHAPES, kinds="shapes"):
    """A geometry, centred, with its axis along local y; parameters are fields declared by `parameter`.

    ``key`` is its word in files. States hold its ``number``; a shape outside carom has one made from its key.
    """

    number: ClassVar[int] = -1
    solid: ClassVar[bool] = True  # False: has no volume, so a dynamic body needs a stated mass and does not rotate
    static: ClassVar[bool] = False  # True: only an entity without a body may have it
    along_z: ClassVar[bool] = False  # True: FCL lays this shape along z, carom along y

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "key" in vars(cls):
            if "number" not in vars(cls):  # by its key alone, so that states mean the same wherever it is installed
                cls.number = FIRST_OWN_NUMBER + crc32(cls.key.encode())
            enter(BY_NUMBER, cls.number, cls, clash="shapes have the number", mend="let one of them state none")

    def __post_init__(self) -> None:
        """Refuse parameters outside their bounds; raise DeclarationError naming all of them."""
        faults = self.faults()
        if faults:
            raise DeclarationError("; ".join(f"{self.key}.{name}: {fault}" for name, fault in faults))
        make_plain(self, (field.name for field in self.parameters()))
        if self.parameters() and self.solid and not self.static:
            self._refuse_volume()

    def _refuse_volume(self) -> None:
        """Refuse a solid so thin or so large that its volume is no number; raise DeclarationError."""
        try:
            volume = self.mass_properties().volume
        except OverflowError:
            volume = math.inf
        except ZeroDivisionError:  # moments are shares of it
            volume = 0.0
        if not sys.float_info.min <= volume < math.inf:
            wanted = f"from {sys.float_info.min:.2g} m3 on" if volume < 1.0 else "finite"
            raise DeclarationError(f"{self.key}: its volume must be {wanted}, received {volume:g} m3")

    @classmethod
    def stated(cls, *_: Any, **words: Any) -> Self:
        """Return the shape that the words of a world file, in SI, state."""
        return cls(**words)

    @classmethod
    def seen(cls, *_: Any, **words: Any) -> Self:
        """Return the shape that the words of a visual state, which is only drawn."""
        return cls.stated(**words)

    @classmethod
    def parameters(cls) -> list[dataclasses.Field[Any]]:
        """Return the fields that are numbers, not a geometry."""
        return [field for field in dataclasses.fields(cls) if "unit" in field.metadata]

    def faults(self) -> list[tuple[str, str]]:
        """Return (parameter, what is wrong) for every parameter that is no number or out of bounds."""
        checked = [(field.name, number_fault(field.metadata, getattr(self, field.name))) for field in self.parameters()]
        return [(name, fault) for name, fault in checked if fault]

    def packed(self) -> tuple[float, ...]:
        """Return the parameters as the numbers of the size column, padded with zeros."""
        flat = [float(v) for f in dataclasses.fields(self) for v in np.atleast_1d(getattr(self, f.name))]
        return (*flat, *[0.0] * (SHAPE_PARAMETERS - len(flat)))

    @classmethod
    def from_size(cls, size: Floats, geometry: Any = None) -> Shape:
        """Return the shape whose size column and geometry are these; the inverse of `packed`."""
        values: dict[str, Any] = {}
        at = 0
        for field in dataclasses.fields(cls):
            width = field.metadata.get("width", 1)
            values[field.name] = float(size[at]) if width == 1 else tuple(float(v) for v in size[at : at + width])
            at += width
        return cls(**values)

    def words(self) -> dict[str, Any]:
        """Return the words, in SI, that state this shape to the bit; the inverse of `stated`."""
        return words_of(self)

    @abstractmethod
    def mass_properties(self) -> MassProperties:
        """Return volume, centre and moments in closed form, or summed over triangles."""

    @abstractmethod
    def bounds(self) -> Bounds:
        """Return the bounds in the shape frame."""

    @abstractmethod
    def support(self, directions: Floats) -> Floats:
        """Return the points (n, 3), m, of the shape farthest along ``directions`` (n, 3) of any length but 0."""

    @abstractmethod
    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return the FCL geometry, grown by ``margin`` (m) where growing it is exact."""

    @abstractmethod
    def surface(self) -> Surface:
        """Return the triangles to draw."""

    def coarser_surfaces(self) -> tuple[Surface, ...]:
        """Return fewer triangles, coarser and coarser, for where the shape is small in a picture."""
        return ()

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return what of shapes of one geometry lies where ``normal . x < depth`` (m, shape frame), a row (n, 5) each.

        A row is the volume there in m3, the centre of it in m, and the volume of all of the shape; ``size`` (n, 4) is
        that of the column, ``normal`` (n, 3) of length 1. Points displace nothing. Raises DeclarationError for what has
        no volume known.
        """
        if cls.solid:
            raise DeclarationError(f"{cls.key}: has no volume known that a medium could bear")
        return np.zeros((len(depth), FOUND))

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return points (n, 3) and a radius such that a half space touches the shape first in one of those balls.

        ``towards`` (shape frame) is where the half space lies; only round edges need to know.
        """
        return np.zeros((0, 3)), 0.0
