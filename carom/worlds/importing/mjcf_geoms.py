"""Geoms of MJCF: shapes, how they touch, and what they weigh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.joints.frames import shortest_turn
from carom.systems.shapes import SHAPES
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.model_files import read_scene
from carom.systems.shapes.shape import MassProperties
from carom.systems.shapes.solid import solid_properties
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.masses import placed
from carom.worlds.importing.mjcf_file import Compiler
from carom.worlds.importing.mjcf_land import land_words
from carom.worlds.importing.mjcf_touching import Touching
from carom.worlds.importing.model import HERE, Inertia, Piece, Pose
from carom.worlds.importing.report import Report

KINDS = ("plane", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "hfield", "sdf")
LONG = ("capsule", "cylinder", "box", "ellipsoid")  # those that fromto places
LAND = "height_field"
SHOWN_GROUPS = 3  # geoms of higher groups are not drawn unless asked for
Y, Z = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
WATER = 1000.0  # kg/m3, MuJoCo's default density


class Geoms:
    """Reads geoms and the assets that they name."""

    def __init__(self, compiler: Compiler, files: ModelFiles, reading: Reading, report: Report) -> None:
        self.compiler, self.files, self.reading, self.report = compiler, files, reading, report
        self.colors: dict[str, Any] = {}
        self.meshes: dict[str, tuple[Element, Any]] = {}
        self.fields: dict[str, Element] = {}
        self.touching = Touching(reading, report)

    def asset(self, element: Element) -> None:
        """Note a mesh or material."""
        words = element.attributes
        if element.tag == "material":
            self.colors[words.get("name", "")] = self.reading.numbers(element, "rgba", 4, (1.0, 1.0, 1.0, 1.0))
            if "texture" in words:
                self.report.drop(element, "textures", words.get("name", ""))
        elif element.tag == "mesh":
            name = words.get("name", words.get("file", "").rpartition("/")[2].rpartition(".")[0])
            if "file" not in words:
                self.report.drop(element, "meshes of numbers", name)
                return
            for key in ("refpos", "refquat"):
                if key in words:
                    self.report.drop(element, f"{key} of meshes", name)
            path = self.files.find(element, words["file"], name, folder=self.compiler.meshes)
            self.meshes[name] = (element, path)
        elif element.tag == "hfield":
            self.fields[words.get("name", Path(words.get("file", "")).stem)] = element
        elif element.tag != "texture":
            self.report.drop(element, f"assets <{element.tag}>", words.get("name", ""))

    def piece(self, element: Element, body: str) -> Piece | None:
        """Return the shape of a geom with its default class filled in, or None where it does not come over."""
        read, words = self.reading, element.attributes
        whose = words.get("name", body)
        kind = read.choice(element, "type", KINDS, "mesh" if "mesh" in words and "type" not in words else "sphere")
        if kind == "sdf":
            self.report.drop(element, f"geoms of type {kind}", whose)
            return None
        pose = self.compiler.pose(element)
        piece = Piece(element, kind, {}, pose)
        if kind == "mesh":
            if not self.mesh(piece):
                return None
        elif kind == "hfield":
            if not self.land(piece, whose):
                return None
        else:
            pose, piece.words = self.size(element, kind, pose)
            piece.pose = pose
        self.touching.read(piece, whose)
        group = read.whole(element, "group", 0)
        piece.seen = group < SHOWN_GROUPS
        if "rgba" in words or words.get("material") in self.colors:
            color = read.numbers(element, "rgba", 4, self.colors.get(words.get("material", ""), (0.5, 0.5, 0.5, 1.0)))
            piece.color = tuple(min(max(part, 0.0), 1.0) for part in color)
            piece.seen = piece.seen and color[3] > 0.0
        return piece

    def mesh(self, piece: Piece) -> bool:
        """Let a piece be a mesh, which MuJoCo collides as its hull; tell whether there is one."""
        name = piece.element.attributes.get("mesh", "")
        if name not in self.meshes:
            self.reading.fault(piece.element, "unknown mesh", received=repr(name), accepted=", ".join(self.meshes))
            return False
        asset, piece.file = self.meshes[name]
        x, y, z = self.reading.numbers(asset, "scale", 3, (1.0, 1.0, 1.0))
        piece.scale, piece.hull = (x, y, z), True
        return piece.file is not None

    def land(self, piece: Piece, whose: str) -> bool:
        """Let a piece be a height field of an image; tell whether there is one."""
        name = piece.element.attributes.get("hfield", "")
        if name not in self.fields:
            accepted = ", ".join(self.fields)
            self.reading.fault(piece.element, "unknown hfield", received=repr(name), accepted=accepted)
            return False
        field = self.fields[name]
        if "file" not in field.attributes:
            self.report.drop(field, "height fields of numbers", name)
            return False
        piece.file = self.files.find(field, field.attributes["file"], name, folder=self.compiler.meshes)
        words = None if piece.file is None else land_words(field, piece.file, self.reading)
        if words is None:
            return False
        piece.kind, piece.words = LAND, words
        self.report.approximate(field, "the base of a height field, now solid without end", whose)
        return True

    def size(self, element: Element, kind: str, pose: Pose) -> tuple[Pose, dict[str, Any]]:
        """Return the pose and the words of a shape by its half sizes, or by where it leads from and to."""
        sizes = [*self.reading.numbers(element, "size", 3, (), fewer=True), 0.0, 0.0, 0.0][:3]
        if "fromto" in element.attributes and kind in LONG:
            ends = np.array(self.reading.numbers(element, "fromto", 6))
            along, half = ends[:3] - ends[3:], float(np.sqrt(((ends[3:] - ends[:3]) ** 2).sum())) / 2.0
            rotation = shortest_turn(Z, along) if half > 0.0 else HERE.rotation
            pose = Pose((ends[:3] + ends[3:]) / 2.0, rotation)
            sizes = [sizes[0], half, 0.0] if kind in ("capsule", "cylinder") else [sizes[0], sizes[0], half]
        if kind == "box":
            return pose, {"size": 2.0 * np.array(sizes)}
        if kind == "ellipsoid":
            return pose, {"radii": np.array(sizes)}
        if kind == "plane":
            return pose, {}
        return pose, {"radius": sizes[0]} | ({} if kind == "sphere" else {"length": 2.0 * sizes[1]})

    def inertia(self, piece: Piece) -> Inertia | None:
        """Return what a piece weighs in the frame of its body, by its own mass or density."""
        element = piece.element
        if not piece.has_size():
            return None
        try:
            solid = self.solid(piece)
        except DeclarationError:
            return None
        density = self.reading.number(element, "density", WATER, least=0.0)
        mass = self.reading.number(element, "mass", density * solid.volume, least=0.0)
        if mass == 0.0:
            return None
        axes = quaternion.matrix(solid.axes)
        own = Inertia(mass, np.array(solid.center), mass * (axes @ np.diag(solid.inertia) @ axes.T))
        if piece.kind in ("capsule", "cylinder"):
            own = placed(own, Pose(np.zeros(3), shortest_turn(Y, Z)))
        return placed(own, piece.pose)

    def solid(self, piece: Piece) -> MassProperties:
        """Return volume, centre and moments of a piece in its own frame, cylinders and capsules along y."""
        if piece.kind in ("plane", LAND):
            return MassProperties(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        if piece.file is None:
            return SHAPES[piece.kind].stated(**piece.words).mass_properties()
        return solid_properties(hull_of(np.array(read_scene(piece.file).vertices) * piece.scale))
