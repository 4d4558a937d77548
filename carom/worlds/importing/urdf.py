"""URDF: links and joints of a robot, as its format says (wiki.ros.org/urdf/XML)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.ecs.spatial import quaternion
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.model import SLIDE, TURN, Connection, Freedom, Link, Model, Pose
from carom.worlds.importing.report import Report
from carom.worlds.importing.urdf_links import LAYER, LinkReader, origin_of

UP = "z"
JOINTS = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
KNOWN = ("link", "joint", "material")
FORWARD = (1.0, 0.0, 0.0)


def read_urdf(root: Element, files: ModelFiles, reading: Reading, report: Report, base: str = "auto") -> Model:
    """Return the model of a ``<robot>``; its links do not touch each other, as simulators of URDF have it.

    ``base`` says whether the first link stands still: auto where it has no mass, or is called world.
    """
    return _Robot(root, files, reading, report).model(base)


class _Robot:
    """A robot while it is read."""

    def __init__(self, root: Element, files: ModelFiles, reading: Reading, report: Report) -> None:
        self.root, self.files, self.reading, self.report = root, files, reading, report
        self.links: dict[str, Link] = {}
        self.joints: list[Element] = []

    def model(self, base: str) -> Model:
        links = LinkReader(self.files, self.reading, self.report)
        title = self.root.attributes.get("name", "robot")
        for material in self.root.all("material"):
            links.name_color(material)
        for element in self.root.all("link"):
            link = links.link(element)
            if link.name in self.links:
                received = f"{link.name}, also at line {self.links[link.name].element.line}"
                self.reading.fault(element, "two links of one name", received=received)
            self.links[link.name] = link
        for element in self.root.children:
            if element.tag not in KNOWN:
                self.report.drop(element, f"<{element.tag}>", element.attributes.get("name", ""))
        self.joints = list(self.root.all("joint"))
        above = self.parents()
        self.reading.refuse_if_faulty()
        model = Model(title, self.report, layers={LAYER: ["default"]})
        for name in self.in_order(above):
            joint = above.get(name)
            if joint is None:
                self.links[name].static = self.stands(self.links[name], base)
            else:
                self.join(model, joint, self.links[name])
            model.links.append(self.links[name])
        self.reading.refuse_if_faulty()
        self.report.keep("link", len(model.links))
        return model

    def parents(self) -> dict[str, Element]:
        """Return for each link the joint of which it is the child."""
        above: dict[str, Element] = {}
        for joint in self.joints:
            for tag in ("parent", "child"):
                end = joint.one(tag)
                name = None if end is None else self.reading.text(end, "link")
                if name not in self.links:
                    accepted = ", ".join(list(self.links)[:12])
                    self.reading.fault(joint, f"{tag} is no link", received=repr(name), accepted=accepted)
                elif tag == "child" and name in above:
                    received = f"{name}, held at line {above[name].line} already"
                    self.reading.fault(joint, "child is held by two joints", received=received)
                elif tag == "child" and name is not None:
                    above[name] = joint
        return above

    def in_order(self, above: dict[str, Element]) -> list[str]:
        """Return the names of links, each after that which holds it; those in a circle are a fault."""
        order = [name for name in self.links if name not in above]
        below: dict[str, list[str]] = {}
        for name, joint in above.items():
            below.setdefault(_end(joint, "parent"), []).append(name)
        for name in order:  # grows as it goes
            order += below.get(name, [])
        for name in self.links.keys() - set(order):
            self.reading.fault(above[name], "hangs in a circle of joints", received=name)
        return order

    def stands(self, link: Link, base: str) -> bool:
        if base == "auto":
            return link.inertia is None or link.name == "world"
        return base == "fixed"

    def join(self, model: Model, element: Element, link: Link) -> None:
        """Place a link by its joint, all joints being at 0, and add what holds it."""
        name, kind = self.reading.text(element, "name"), self.reading.choice(element, "type", JOINTS)
        carrier = self.links[_end(element, "parent")]
        link.pose = carrier.pose.then(origin_of(self.reading, element))
        if kind == "fixed":
            link.carried, link.static = carrier.name, carrier.static
            self.report.keep("fixed joint")
            return
        self.leavings(element, name, kind)
        self.report.keep("joint")
        if kind == "floating":
            return
        axis = np.array(FORWARD if (found := element.one("axis")) is None else self.reading.numbers(found, "xyz", 3))
        if not axis.any():
            self.reading.fault(element, "axis has no direction", received="0 0 0")
            return
        axis = quaternion.rotate(link.pose.rotation, axis / np.sqrt((axis * axis).sum()))
        if kind == "planar":
            freedoms = _planar(link.pose, axis)
        else:
            slides = kind == "prismatic"
            freedoms = [Freedom(SLIDE if slides else TURN, link.pose.position, axis)]
        if kind in ("revolute", "prismatic"):
            freedoms[0].limits = self.limits(element)
        dynamics = element.one("dynamics")
        for freedom in freedoms if dynamics is not None and kind != "planar" else ():
            assert dynamics is not None
            freedom.damping = self.reading.number(dynamics, "damping", 0.0, least=0.0)
            freedom.friction = self.reading.number(dynamics, "friction", 0.0, least=0.0)
        model.connections.append(Connection(element, name, carrier.name, link.name, freedoms))

    def limits(self, element: Element) -> tuple[float, float] | None:
        limit = element.one("limit")
        if limit is None:
            self.reading.fault(element, "has no limit", accepted='<limit lower="" upper="" effort="" velocity=""/>')
            return None
        lower, upper = (self.reading.number(limit, key, 0.0) for key in ("lower", "upper"))
        if lower > upper:
            received = f"{lower:g} to {upper:g}"
            self.reading.fault(limit, "the lower limit must not be above the upper", received=received)
        return lower, upper

    def leavings(self, element: Element, name: str, kind: str) -> None:
        """Note what of a joint does not come over."""
        limit = element.one("limit")
        for key in ("effort", "velocity") if limit is not None else ():
            assert limit is not None
            if 0.0 < self.reading.number(limit, key, 0.0) < math.inf:
                self.report.drop(limit, f"limits of {key}, for who drives the joint", name)
        if kind == "planar" and (limit or element.one("dynamics")):
            self.report.drop(element, "limits and dynamics of planar joints", name)
        for tag in ("mimic", "calibration", "safety_controller"):
            if (found := element.one(tag)) is not None:
                what = "mimic, by which a joint follows another" if tag == "mimic" else f"<{tag}>"
                self.report.drop(found, what, name)


def _end(joint: Element, tag: str) -> str:
    end = joint.one(tag)
    return "" if end is None else end.attributes.get("link", "")


def _planar(pose: Pose, normal: Any) -> list[Freedom]:
    """Return the freedoms of a plane: along two axes across its normal, and about that."""
    away = np.array((0.0, 0.0, 1.0) if abs(normal[2]) < 0.9 else FORWARD)
    first = np.cross(away, normal)
    first /= np.sqrt((first * first).sum())
    slides = [Freedom(SLIDE, pose.position, axis) for axis in (first, np.cross(normal, first))]
    return [*slides, Freedom(TURN, pose.position, np.asarray(normal))]
