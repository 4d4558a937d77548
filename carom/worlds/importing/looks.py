"""Shapes and poses of a model in carom's axes as the words of colliders and visuals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.spatial import quaternion
from carom.worlds.importing.meshes import AS_HULL, AS_MESH, AS_SEEN, Meshes
from carom.worlds.importing.model import Piece, Pose
from carom.worlds.importing.report import Report


class Looks:
    """Words of shapes; ``touching`` says how meshes touch: as hulls, as parts that ``cut`` finds, or not at all."""

    def __init__(
        self, meshes: Meshes, touching: str, report: Report, cut: Callable[[Path], list[Path]] | None = None
    ) -> None:
        self.meshes, self.touching, self.report, self.cut = meshes, touching, report, cut

    def pieces(self, stated: list[Piece]) -> list[Piece]:
        """Return the shapes of a link, meshes that touch and are seen as two, and as parts where they are to be."""
        found: list[Piece] = []
        for piece in stated:
            if piece.file is None or piece.kind != "mesh" or not piece.touches:
                found.append(piece)
                continue
            if piece.seen:
                found.append(replace(piece, touches=False))
            if self.touching == "parts" and self.cut is not None and not self.meshes.fault(piece, AS_MESH):
                parts = self.cut(piece.file)
                self.report.approximate(piece.element, "a mesh to touch as convex parts", piece.file.name)
                found += [replace(piece, file=part, seen=False, hull=True) for part in parts]
            elif self.touching != "none":
                found.append(replace(piece, seen=False))
        return found

    def words(self, pieces: list[Piece], moves: bool) -> dict[str, Any]:
        """Return collider, material and visual of a link with at most one shape to touch and one to be seen."""
        words: dict[str, Any] = {}
        for piece in pieces:
            if not piece.has_size():
                self.report.drop(piece.element, "a shape without size", piece.element.attributes.get("name", ""))
                continue
            if piece.kind in ("plane", "height_field") and moves:
                self.report.drop(
                    piece.element, f"a {piece.kind} of what moves", piece.element.attributes.get("name", "")
                )
                continue
            place = pose_words(piece.pose) if piece.kind != "plane" else {}
            if piece.touches and (shape := self.touched(piece, moves)):
                words["collider"] = shape | place | ({} if piece.layer == "default" else {"layer": piece.layer})
                words |= {"material": piece.material} if piece.material else {}
                words["visual"] = (
                    {"color": piece.color} if piece.seen and piece.color else None if piece.seen else False
                )
                self.report.keep("collider")
            elif piece.seen and (shape := self.shown(piece)):
                words["visual"] = shape | place | ({"color": piece.color} if piece.color else {})
                self.report.keep("visual")
        return words

    def touched(self, piece: Piece, moves: bool) -> dict[str, Any] | None:
        """Return the shape of a collider: of meshes itself where it stands still and is closed, else its hull."""
        if piece.kind == "height_field":
            return self.land(piece)
        if piece.kind != "mesh":
            return {piece.kind: piece.words}
        whose = piece.file.name if piece.file else ""
        if not moves and not piece.hull and not self.meshes.fault(piece, AS_MESH):
            return {AS_MESH: self.meshes.words(piece)}
        if fault := self.meshes.fault(piece, AS_HULL):
            self.report.drop(piece.element, f"a mesh to touch, which has no hull: {fault.partition(': ')[2]}", whose)
            return None
        if not piece.hull:
            self.report.approximate(piece.element, "a mesh to touch as its hull", whose)
        return {AS_HULL: self.meshes.words(piece)}

    def land(self, piece: Piece) -> dict[str, Any] | None:
        """Return a height field, of which an image says how high it is: it lies one way only."""
        image = self.meshes.image(piece)
        if image is None:
            self.report.drop(piece.element, "a height field whose axes are not those of its format")
            return None
        return {piece.kind: {"image": image} | piece.words}

    def shown(self, piece: Piece) -> dict[str, Any] | None:
        """Return the shape of a visual."""
        if piece.kind == "height_field":
            return self.land(piece)
        if piece.kind != "mesh":
            return {piece.kind: piece.words}
        if self.meshes.fault(piece, AS_SEEN):
            whose = piece.file.name if piece.file else ""
            self.report.drop(piece.element, "a mesh to see, which holds no triangles", whose)
            return None
        return {"mesh": self.meshes.words(piece)}


def inside(outer: Pose, inner: Pose) -> Pose:
    """Return a pose of the world in the frame of another."""
    back = quaternion.conjugate(outer.rotation)
    return Pose(quaternion.rotate(back, inner.position - outer.position), quaternion.multiply(back, inner.rotation))


def pose_words(pose: Pose) -> dict[str, Any]:
    """Return the words of a pose, without those that say nothing."""
    words: dict[str, Any] = {}
    if np.abs(pose.position).max() > 1e-12:
        words["position"] = pose.position
    if np.abs(pose.rotation[:3]).max() > 1e-12:
        words["rotation"] = pose.rotation
    return words
