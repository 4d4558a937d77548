"""Axes, handedness and units: from those of a file to carom's, right-handed with y up, in metres.

Axes are swapped and turned round, so that nothing is rounded but by the unit. A vector v becomes u C v, a pose p, R
becomes u C p, C R C^-1, a tensor C I C^-1; an axis of rotation is turned round where C is a reflection.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.joints.frames import shortest_turn
from carom.worlds.importing.model import SLIDE, Connection, Freedom, Inertia, Link, Model, Piece, Pose

UPRIGHT = {  # the rotation that takes an axis to y
    "x": ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "y": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "z": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
}
MIRROR = (1.0, 1.0, -1.0)  # x and up stay, as between carom and programs whose z is forward
Y = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Convention:
    """The axis that points up in a file, its handedness, and the length of its unit in m."""

    up: str = "y"
    hand: str = "right"
    unit: float = 1.0

    @property
    def matrix(self) -> Floats:
        """Return C (3, 3), a rotation or, of a left-handed file, a reflection."""
        upright = np.array(UPRIGHT[self.up])
        return np.diag(MIRROR) @ upright if self.hand == "left" else upright

    @property
    def turn(self) -> float:
        """Return 1, or -1 where C is a reflection."""
        return -1.0 if self.hand == "left" else 1.0

    def direction(self, v: Any) -> Floats:
        """Return a direction."""
        return np.asarray(self.matrix @ v) + 0.0  # no -0

    def axis(self, v: Any) -> Floats:
        """Return an axis of rotation: the same angle about it is the same turn."""
        return self.turn * self.direction(v) + 0.0

    def point(self, p: Any) -> Floats:
        """Return a position, m."""
        return self.unit * self.direction(p)

    def rotation(self, q: Any) -> Floats:
        """Return a rotation."""
        return np.array([*self.axis(np.asarray(q)[:3]), np.asarray(q)[3]])

    def pose(self, pose: Pose) -> Pose:
        """Return a pose."""
        return Pose(self.point(pose.position), self.rotation(pose.rotation))

    def tensor(self, tensor: Any) -> Floats:
        """Return a tensor, such as of inertia, kg m2."""
        return np.asarray(self.unit**2 * (self.matrix @ tensor @ self.matrix.T)) + 0.0

    def model(self, model: Model) -> None:
        """Turn all of a model, in place."""
        for link in model.links:
            self._link(link)
        for connection in model.connections:
            self._connection(connection)
        if model.gravity is not None:
            model.gravity = self.point(model.gravity)
        for camera in model.cameras.values():
            camera |= {key: self.point(camera[key]) for key in ("position", "target")}
            camera |= {"up": self.direction(camera["up"])}

    def _link(self, link: Link) -> None:
        link.pose = self.pose(link.pose)
        if link.inertia is not None:
            mass, center, tensor = link.inertia
            link.inertia = Inertia(mass, self.point(center), self.tensor(tensor))
        for piece in link.pieces:
            self._piece(piece)

    def _piece(self, piece: Piece) -> None:
        """Turn a shape: boxes and the like by their sizes, those along z by what takes y to where z goes."""
        piece.pose = self.pose(piece.pose)
        lengths = {key: self.unit * np.asarray(value) for key, value in piece.words.items() if key != "normal"}
        if piece.kind in ("box", "ellipsoid"):
            lengths = {key: np.abs(self.matrix) @ value for key, value in lengths.items()}
        if piece.kind in ("cylinder", "capsule"):
            along = shortest_turn(Y, np.abs(self.matrix) @ (0.0, 0.0, 1.0))
            turned = quaternion.multiply(piece.pose.rotation, along)
            piece.pose = Pose(piece.pose.position, turned)
        piece.words |= lengths
        if piece.kind == "plane":
            piece.words["normal"] = self.direction((0.0, 0.0, 1.0))

    def _connection(self, connection: Connection) -> None:
        if connection.at is not None:
            connection.at = self.point(connection.at)
        for freedom in connection.freedoms:
            self._freedom(freedom)

    def _freedom(self, freedom: Freedom) -> None:
        """Turn an axis; a slide measures lengths, and torques hold a length squared."""
        slides = freedom.kind == SLIDE
        freedom.at = self.point(freedom.at)
        freedom.axis = self.direction(freedom.axis) if slides else self.axis(freedom.axis)
        if slides:
            freedom.limits = None if freedom.limits is None else tuple(self.unit * x for x in freedom.limits)  # type: ignore[assignment]
            freedom.target *= self.unit
            force = self.unit
        else:
            force = self.unit**2
            freedom.damping *= force
            freedom.stiffness *= force
        freedom.friction *= force
        freedom.most = None if freedom.most is None else freedom.most * force
