"""MJCF as a file: included files put in place, default classes filled in, settings of its compiler, frames.

Source: mujoco.readthedocs.io, XML Reference.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.joints.frames import shortest_turn
from carom.worlds.errors import WorldError, shown
from carom.worlds.importing.elements import Element, Reading, read_xml
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.model import HERE, Pose

MAIN = "main"
Z = (0.0, 0.0, 1.0)
INCLUDED = 100  # files at most


class Included:
    """Puts the elements of included files where they are named, each file once."""

    def __init__(self, files: ModelFiles, reading: Reading) -> None:
        self.files, self.reading = files, reading
        self.taken: set[str] = set()

    def fill(self, element: Element) -> Element:
        """Return an element with the elements of the files it includes in the place of their names."""
        children: list[Element] = []
        for child in element.children:
            if child.tag != "include":
                children.append(self.fill(child))
                continue
            word = self.reading.text(child, "file")
            path = self.files.find(child, word, "include")
            if path is None:
                continue
            if str(path) in self.taken or len(self.taken) >= INCLUDED:
                self.reading.fault(child, "includes a file a second time", received=shown(word))
                continue
            self.taken.add(str(path))
            try:
                children += self.fill(read_xml(path, str(path))).children
            except WorldError as fault:
                self.reading.faults += fault.faults
        return replace(element, children=children)


class Defaults:
    """What the classes of a file state for each tag."""

    def __init__(self, root: Element, reading: Reading) -> None:
        self.reading = reading
        self.classes: dict[str, dict[str, dict[str, str]]] = {MAIN: {}}
        for element in root.all("default"):
            self.add(element, element.attributes.get("class", MAIN), self.classes[MAIN])

    def add(self, element: Element, name: str, above: dict[str, dict[str, str]]) -> None:
        """Add a class and those inside it, each with what the one around it states."""
        stated = {tag: dict(words) for tag, words in above.items()}
        for child in element.children:
            if child.tag != "default":
                stated.setdefault(child.tag, {}).update(child.attributes)
        self.classes[name] = stated
        for child in element.all("default"):
            self.add(child, self.reading.text(child, "class"), stated)

    def filled(self, element: Element, around: str) -> Element:
        """Return an element with what its class, or that of the body ``around``, states for it."""
        name = element.attributes.get("class", around)
        if name not in self.classes:
            self.reading.fault(element, "unknown class", received=shown(name), accepted=", ".join(self.classes))
            name = MAIN
        return replace(element, attributes=self.classes[name].get(element.tag, {}) | element.attributes)


class Compiler:
    """How the numbers of a file are meant."""

    def __init__(self, root: Element, reading: Reading) -> None:
        self.reading = reading
        words: dict[str, str] = {}
        for element in root.all("compiler"):
            words |= element.attributes
            if element.attributes.get("coordinate", "local") != "local":
                received = shown(element.attributes["coordinate"])
                reading.fault(element, "coordinate is no more in MuJoCo", received=received, accepted="local")
            reading.choice(element, "angle", ("degree", "radian"), "degree")
            order = element.attributes.get("eulerseq", "xyz")
            if len(order) != 3 or not set(order.lower()) <= set("xyz") or not (order.islower() or order.isupper()):
                reading.fault(element, "eulerseq is no order of axes", received=shown(order), accepted="xyz or XYZ")
        self.degree = math.pi / 180.0 if words.get("angle", "degree") == "degree" else 1.0
        order = words.get("eulerseq", "xyz")
        self.order = order.swapcase()  # there lower case is for turning axes, here upper
        self.limits_by_range = words.get("autolimits", "true") == "true"
        self.from_geoms = words.get("inertiafromgeom", "auto")
        self.meshes = words.get("meshdir", words.get("assetdir", ""))

    def angle(self, value: float) -> float:
        """Return an angle in rad."""
        return value * self.degree

    def pose(self, element: Element) -> Pose:
        """Return the pose that an element states."""
        position = np.array(self.reading.numbers(element, "pos", 3, (0.0, 0.0, 0.0)))
        return Pose(position, self.rotation(element))

    def rotation(self, element: Element) -> Floats:
        """Return the rotation that an element states in one of five ways."""
        read, words = self.reading, element.attributes
        if "quat" in words:
            w, x, y, z = read.numbers(element, "quat", 4)
            return _unit(np.array([x, y, z, w]))
        if "axisangle" in words:
            *axis, angle = read.numbers(element, "axisangle", 4)
            return quaternion.from_axis_angle(axis, self.angle(angle)) if any(axis) else HERE.rotation
        if "euler" in words:
            turns = [self.angle(angle) for angle in read.numbers(element, "euler", 3)]
            return quaternion.from_euler(turns, self.order) if any(turns) else HERE.rotation
        if "zaxis" in words:
            ahead = read.numbers(element, "zaxis", 3)
            return shortest_turn(Z, ahead) if any(ahead) else HERE.rotation
        if "xyaxes" in words:
            numbers = np.array(read.numbers(element, "xyaxes", 6, (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)))
            x_axis = _unit(numbers[:3])
            y_axis = _unit(numbers[3:] - x_axis * (x_axis @ numbers[3:]))
            if not (x_axis.any() and y_axis.any()):
                read.fault(element, "xyaxes are along each other", received=shown(words["xyaxes"]))
                return HERE.rotation
            return quaternion.from_matrix(np.stack([x_axis, y_axis, np.cross(x_axis, y_axis)], axis=-1))
        return HERE.rotation


def _unit(v: Floats) -> Floats:
    """Return a vector of length 1; zeros, and quaternions of zeros as the identity, as MuJoCo has it."""
    length = float(np.sqrt(v @ v))
    if length == 0.0:
        return HERE.rotation if len(v) == 4 else v
    return v / length if abs(length - 1.0) > 1e-15 else v
