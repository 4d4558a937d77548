"""Bodies of MJCF: in each other, with their geoms, joints, masses and cameras."""

from __future__ import annotations

import math

import numpy as np

from carom.ecs.spatial import quaternion
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.masses import joined, placed
from carom.worlds.importing.mjcf_file import Compiler, Defaults
from carom.worlds.importing.mjcf_geoms import Geoms
from carom.worlds.importing.mjcf_joints import Joints
from carom.worlds.importing.model import HERE, Connection, Inertia, Link, Model, Pose

FORWARD, UPWARD = (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)  # of cameras


class Bodies:
    """The bodies of a file while they are read into a model, and what holds them to each other."""

    def __init__(
        self, made: Model, compiler: Compiler, defaults: Defaults, geoms: Geoms, joints: Joints, reading: Reading
    ) -> None:
        self.made, self.compiler, self.defaults, self.geoms, self.joints = made, compiler, defaults, geoms, joints
        self.reading, self.report = reading, made.report
        self.links: dict[str, Link] = {}

    def inside(self, element: Element, pose: Pose, link: Link | None, around: str) -> None:
        """Read what stands in a body, or in the world where there is none; ``pose`` is that of what surrounds it."""
        for child in element.children:
            if child.tag == "body":
                self.body(child, pose, link, around)
            elif child.tag == "frame":
                inner = child.attributes.get("childclass", around)
                self.inside(child, pose.then(self.compiler.pose(child)), link, inner)
            elif child.tag == "geom":
                self.geom(self.defaults.filled(child, around), pose, link)
            elif child.tag == "camera" and link is None:
                self.camera(self.defaults.filled(child, around), pose)
            elif child.tag not in ("joint", "freejoint", "inertial"):
                self.report.drop(child, f"<{child.tag}>", child.attributes.get("name", ""))

    def body(self, element: Element, pose: Pose, carrier: Link | None, around: str) -> None:
        """Read a body and those in it: carried where it has no joints, at rest where nothing around it moves."""
        around = element.attributes.get("childclass", around)
        name = element.attributes.get("name") or f"body-{len(self.links) + 1}"
        if name in self.links:
            received = f"{name}, also at line {self.links[name].element.line}"
            self.reading.fault(element, "two bodies of one name", received=received)
            return
        link = Link(element, name, pose.then(self.compiler.pose(element)))
        link.gravity_scale = 1.0 - self.reading.number(element, "gravcomp", 0.0)
        self.links[name] = link
        self.made.links.append(link)
        self.report.keep("link")
        stated = [self.defaults.filled(child, around) for child in element.all("joint")]
        free = [*element.all("freejoint"), *(joint for joint in stated if joint.attributes.get("type") == "free")]
        if not (stated or free):
            link.static = carrier is None or carrier.static
            link.carried = None if carrier is None else carrier.name
            if element.attributes.get("mocap") == "true":
                self.report.approximate(element, "a body that a program places (mocap), now at rest", name)
        elif free:
            self.report.keep("free joint")
        else:
            holder = None if carrier is None else carrier.name
            self.hold(self.joints.connection(stated, holder, link))
        self.inside(element, link.pose, link, around)
        self.weigh(element, link)

    def geom(self, element: Element, pose: Pose, link: Link | None) -> None:
        """Add a geom to its body; those of the world each stand by themselves."""
        piece = self.geoms.piece(element, "" if link is None else link.name)
        if piece is None or (link is None and not (piece.touches or piece.seen)):
            return
        if link is None:
            name = element.attributes.get("name") or f"{piece.kind}-{len(self.made.links) + 1}"
            alone = Link(element, name, pose.then(piece.pose), pieces=[piece], static=True, lone=True)
            piece.pose = HERE
            self.made.links.append(alone)
        else:
            link.pieces.append(piece)

    def weigh(self, element: Element, link: Link) -> None:
        """Give a body the mass that it states, or that of its geoms."""
        stated = element.one("inertial")
        by_geoms = self.compiler.from_geoms
        if stated is not None and by_geoms != "true":
            link.inertia = self.inertia(stated)
        elif by_geoms != "false":
            parts = [mass for piece in link.pieces if (mass := self.geoms.inertia(piece)) is not None]
            link.inertia = joined(parts) if parts else None

    def inertia(self, element: Element) -> Inertia | None:
        """Return a mass whose moments are those about the axes of its own frame."""
        read = self.reading
        mass = read.number(element, "mass", least=0.0)
        if mass == 0.0:
            return None
        if "fullinertia" in element.attributes:
            xx, yy, zz, xy, xz, yz = read.numbers(element, "fullinertia", 6)
            tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            tensor = np.diag(read.numbers(element, "diaginertia", 3))
        return placed(Inertia(mass, np.zeros(3), tensor), self.compiler.pose(element))

    def camera(self, element: Element, pose: Pose) -> None:
        """Add a camera that stands still."""
        mode = element.attributes.get("mode", "fixed")
        name = element.attributes.get("name") or f"camera_{len(self.made.cameras) + 1}"
        if mode != "fixed":
            self.report.drop(element, f"cameras that {mode}", name)
            return
        found = pose.then(self.compiler.pose(element))
        forward = quaternion.rotate(found.rotation, FORWARD)
        words = {"position": found.position, "target": found.position + forward}
        words |= {"up": quaternion.rotate(found.rotation, UPWARD)}
        fov = math.radians(self.reading.number(element, "fovy", 45.0))
        self.made.cameras[name] = {**words, "fov": fov}
        self.report.keep("camera")

    def hold(self, connection: Connection | None) -> None:
        """Add a connection of two that are not fixed to each other, nor both to the world."""
        if connection is None:
            return
        ends = [self.links[name] for name in (connection.a, connection.b) if name is not None]
        if len({self.bearer(link).name for link in ends}) < len(ends) or all(link.static for link in ends):
            self.report.drop(connection.element, "what holds a body to itself, or what stands", connection.name)
        else:
            self.made.connections.append(connection)

    def bearer(self, link: Link) -> Link:
        """Return the link that carries a link, which may be itself."""
        while link.carried is not None:
            link = self.links[link.carried]
        return link
