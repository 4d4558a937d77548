"""A model of links and joints, as its file says it: in its axes and units, before it becomes a carom world."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.worlds.importing.elements import Element
from carom.worlds.importing.report import Report

TURN, SLIDE = "turn", "slide"
SIZES = ("radius", "length", "size", "radii", "spacing")
SMALLEST, GREATEST = (
    1e-9,
    1e9,
)  # lengths of shapes, in the file's unit: beyond these volumes are nothing, or without end


class Pose(NamedTuple):
    """Where something is in the frame of something else: position and unit quaternion xyzw."""

    position: Floats
    rotation: Floats

    def then(self, inner: Pose) -> Pose:
        """Return a pose given in this one's frame in the frame that this one is given in."""
        turned = quaternion.rotate(self.rotation, inner.position)
        return Pose(self.position + turned, quaternion.normalise(quaternion.multiply(self.rotation, inner.rotation)))

    def point(self, place: Any) -> Floats:
        """Return a point of its frame in the outer one."""
        return np.asarray(self.position + quaternion.rotate(self.rotation, place))


HERE = Pose(np.zeros(3), np.array(quaternion.IDENTITY))


@dataclass
class Piece:
    """A shape of a link, to touch others or to be seen.

    ``words`` are those of a carom shape but for axes: cylinders and capsules lie along z, planes face z. A mesh has
    ``file`` and ``scale`` (3,), which is also its mirror image where negative; ``hull`` says that it touches as such.
    """

    element: Element
    kind: str
    words: dict[str, Any]
    pose: Pose = HERE
    touches: bool = True
    seen: bool = True
    color: tuple[float, ...] | None = None
    material: dict[str, Any] = field(default_factory=dict)
    layer: str = "default"
    file: Path | None = None
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    hull: bool = False

    def has_size(self) -> bool:
        """Tell whether all its lengths are such as shapes have."""
        lengths = np.concatenate([[1.0], *(np.ravel(self.words[key]) for key in SIZES if key in self.words)])
        return bool(((lengths >= SMALLEST) & (lengths <= GREATEST)).all())


class Inertia(NamedTuple):
    """A mass, where its centre is in the frame of its link, and its tensor (3, 3) about that in the link's axes."""

    mass: float
    center: Floats
    tensor: Floats


@dataclass
class Link:
    """What moves as one; ``pose`` is that in the world. One that is ``carried`` is fixed to another link, by name.

    A ``lone`` shape is no link that others could name.
    """

    element: Element
    name: str
    pose: Pose
    inertia: Inertia | None = None
    pieces: list[Piece] = field(default_factory=list)
    carried: str | None = None
    static: bool = False
    lone: bool = False
    gravity_scale: float = 1.0


@dataclass
class Freedom:
    """One way in which a joint lets b move: about or along an axis of the world; values are 0 at the poses stated."""

    kind: str
    at: Floats
    axis: Floats
    limits: tuple[float, float] | None = None
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    target: float = 0.0
    most: float | None = None


@dataclass
class Connection:
    """What holds link b to link a, None for the world; without freedoms it is fixed, and a ball turns every way."""

    element: Element
    name: str
    a: str | None
    b: str
    freedoms: list[Freedom] = field(default_factory=list)
    at: Floats | None = None
    ball: bool = False
    swing: float | None = None
    apart: bool = False  # holds nothing: the two merely do not touch each other


@dataclass
class Model:
    """Links and joints; the pieces' layers say with whom they collide."""

    title: str
    report: Report
    links: list[Link] = field(default_factory=list)
    connections: list[Connection] = field(default_factory=list)
    layers: dict[str, list[str]] = field(default_factory=dict)
    cameras: dict[str, dict[str, Any]] = field(default_factory=dict)
    gravity: Floats | None = None
    timestep: float | None = None
