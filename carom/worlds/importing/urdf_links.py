"""Links of URDF: mass, shapes and colours."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs.spatial import quaternion
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.model import HERE, Inertia, Link, Piece, Pose
from carom.worlds.importing.report import Report

PARTS_OF_LINK = ("inertial", "visual", "collision", "origin")
LAYER = "robot"


class LinkReader:
    """Reads links; ``colors`` are those of the materials that the robot names."""

    def __init__(self, files: ModelFiles, reading: Reading, report: Report) -> None:
        self.files, self.reading, self.report = files, reading, report
        self.colors: dict[str, Any] = {}

    def name_color(self, material: Element) -> None:
        """Note the colour of a material that links name."""
        self.colors[material.attributes.get("name", "")] = self.color(material)

    def link(self, element: Element) -> Link:
        """Return a link without its place."""
        name = self.reading.text(element, "name")
        link = Link(element, name, HERE, self.inertia(element))
        for part in element.children:
            if part.tag in ("visual", "collision"):
                link.pieces += self.piece(part, name)
            elif part.tag not in PARTS_OF_LINK:
                self.report.drop(part, f"<{part.tag}> in links", name)
        return link

    def inertia(self, link: Element) -> Inertia | None:
        """Return mass and inertia in the axes of the link, None where it has none."""
        element = link.one("inertial")
        if element is None:
            return None
        mass, inertia = element.one("mass"), element.one("inertia")
        if mass is None or inertia is None:
            self.reading.fault(element, "is not whole", accepted="<mass> and <inertia>")
            return None
        value = self.reading.number(mass, "value", least=0.0)
        xx, xy, xz, yy, yz, zz = (
            self.reading.number(inertia, key, 0.0 if key[1] != key[2] else None)
            for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        if value == 0.0:
            return None
        pose = origin_of(self.reading, element)
        turn = quaternion.matrix(pose.rotation)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turned = tensor if np.array_equal(turn, np.eye(3)) else turn @ tensor @ turn.T
        return Inertia(value, pose.position, turned)

    def piece(self, element: Element, link: str) -> list[Piece]:
        """Return the shape of a visual or collision; none where it does not come over."""
        geometry = element.one("geometry")
        shape = geometry.children[0] if geometry is not None and geometry.children else None
        touches, read = element.tag == "collision", self.reading
        if shape is None:
            self.reading.fault(element, "has no geometry", accepted="<geometry> with a shape")
            return []
        piece = Piece(
            element, shape.tag, {}, origin_of(self.reading, element), touches, not touches, self.look(element)
        )
        piece.layer = LAYER
        read = self.reading
        if shape.tag == "box":
            piece.words = {"size": np.array(read.numbers(shape, "size", 3))}
        elif shape.tag in ("cylinder", "capsule"):
            piece.words = {key: read.number(shape, key, least=0.0) for key in ("radius", "length")}
        elif shape.tag == "sphere":
            piece.words = {"radius": read.number(shape, "radius", least=0.0)}
        elif shape.tag == "mesh":
            x, y, z = read.numbers(shape, "scale", 3, (1.0, 1.0, 1.0))
            piece.scale, piece.file = (x, y, z), self.files.find(shape, read.text(shape, "filename"), link)
            if piece.file is None:
                return []
        else:
            self.report.drop(shape, f"shape <{shape.tag}>", link)
            return []
        return [piece]

    def look(self, element: Element) -> tuple[float, ...] | None:
        """Return the colour of a visual."""
        material = element.one("material")
        if material is None:
            return None
        color = self.color(material)
        return self.colors.get(material.attributes.get("name", "")) if color is None else color

    def color(self, material: Element) -> tuple[float, ...] | None:
        """Return the colour that a material states itself."""
        name, color = material.attributes.get("name", ""), material.one("color")
        if material.one("texture") is not None:
            self.report.drop(material, "textures", name)
        if color is None:
            return None
        found = self.reading.numbers(color, "rgba", 4)
        return tuple(min(max(part, 0.0), 1.0) for part in found)


def origin_of(reading: Reading, element: Element) -> Pose:
    """Return the pose that an element states."""
    origin = element.one("origin")
    if origin is None:
        return HERE
    angles = reading.numbers(origin, "rpy", 3, (0.0, 0.0, 0.0))
    position = np.array(reading.numbers(origin, "xyz", 3, (0.0, 0.0, 0.0)))
    rotation = quaternion.from_euler(angles, "xyz") if any(angles) else HERE.rotation
    return Pose(position, rotation)
