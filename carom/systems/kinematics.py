"""Kinematics: bodies on joints, from the positions of the joints to poses and back, without any forces."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import LIMITED, Joint
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.euler import to_euler
from carom.systems.constants import REACH_CLOSE
from carom.systems.joint_tree import WORLD, JointTree
from carom.systems.kernels.kinematics import fill_jacobian, place_links, reach_target
from carom.systems.simulation import Simulation

NUDGE = 0.4  # rad or m by which a second try starts elsewhere: straight arms do not bend towards what is in line
ORIGIN = (0.0, 0.0, 0.0)
Links = tuple[Floats, Floats, Floats, Floats]


class Reach(NamedTuple):
    """Positions (m,) of the ways, and how far from the target they leave the end, in m and rad."""

    positions: Floats
    off: float


class Kinematics:
    """The bodies that joints hold to a base, as a tree: ``Kinematics(simulation, "base")``; without one, to the world.

    Each way of a joint that is not locked has a number: ``joints`` (m,) are their handles, ``slots`` (m,) which of the
    six it is, ``lower`` and ``upper`` (m,) the limits in m or rad. Joints that close loops are left out, and so are
    those along a line. It is made for joints as they are then; the base may move. Raises DeclarationError for joints of
    twist and swing.
    """

    def __init__(self, simulation: Simulation, base: str | int | None = None) -> None:
        self._world = world = simulation.world
        self.base = None if base is None else int(world.find(base) if isinstance(base, str) else base)
        self._tree = tree = JointTree(world, WORLD if self.base is None else world.row(self.base))
        joint, self._rows = world[Joint], tree.joints[tree.edge]
        self.joints: Integers = world.entities(self._rows)
        self.slots: Integers = tree.slot
        limited = joint.mode[self._rows, self.slots] == LIMITED
        self.lower: Floats = np.where(limited, joint.lower[self._rows, self.slots], -math.inf)
        self.upper: Floats = np.where(limited, joint.upper[self._rows, self.slots], math.inf)

    def positions(self) -> Floats:
        """Return where each way is (m,), m or rad, of bodies where they stand now; whole turns are those of `Joint`."""
        joint, rows = self._world[Joint], self._tree.joints
        row_a, row_b = self._tree.ends()
        place_a, turn_a = self._frames(row_a, joint.anchor_a[rows], joint.frame_a[rows])
        place_b, turn_b = self._frames(row_b, joint.anchor_b[rows], joint.frame_b[rows])
        back = quaternion.conjugate(turn_a)
        about = to_euler(quaternion.multiply(back, turn_b), "XYZ")
        about += 2.0 * math.pi * np.round((joint.position[rows, 3:] - about) / (2.0 * math.pi))
        found = np.concatenate([quaternion.rotate(back, place_b - place_a), about], axis=1)
        return np.asarray(found[self._tree.edge, self.slots])

    def place(self, positions: npt.ArrayLike) -> None:
        """Put every body where its joint is at the position asked for, m or rad (m,); the base stays."""
        angles = self._all(positions)
        place, turn, _, _ = self._placed(angles)
        rows = self._tree.links[1:]
        with self._world.edit(Transform) as transform:
            transform.position[rows], transform.rotation[rows] = place[1:], turn[1:]
        with self._world.edit(Joint) as joint:
            joint.position[self._rows, self.slots] = angles

    def drive(self, positions: npt.ArrayLike) -> None:
        """Let the springs of all motors pull to positions (m,)."""
        angles = self._all(positions)
        with self._world.edit(Joint) as joint:
            joint.target[self._rows, self.slots] = angles

    def pose(
        self, end: str | int, positions: npt.ArrayLike | None = None, point: npt.ArrayLike = ORIGIN
    ) -> tuple[Floats, Floats]:
        """Return where a point of a body would be (3,), m, and how the body would be turned (4,), by positions (m,)."""
        link = self._link(end)
        place, turn, _, _ = self._placed(self._all(positions))
        return place[link] + quaternion.rotate(turn[link], point), turn[link]

    def jacobian(self, end: str | int, positions: npt.ArrayLike | None = None, point: npt.ArrayLike = ORIGIN) -> Floats:
        """Return the velocity (rows 0 to 2) and angular velocity (3 to 5) of a body, at a point of it, by each way.

        (6, m), world frame, per m/s or rad/s of the way; 0 for ways that do not move it.
        """
        link = self._link(end)
        place, turn, axis, pivot = self._placed(self._all(positions))
        found = np.zeros((6, len(self.slots)))
        at = place[link] + quaternion.rotate(turn[link], point)
        fill_jacobian(self._tree.moving(link), self.slots >= 3, axis, pivot, *at.tolist(), found)
        return found

    def reach(
        self,
        end: str | int,
        target: npt.ArrayLike,
        rotation: npt.ArrayLike | None = None,
        point: npt.ArrayLike = ORIGIN,
        start: npt.ArrayLike | None = None,
    ) -> Reach:
        """Return positions of the ways that bring a point of a body to a target (3,), m, and turn it to a rotation.

        Limits are kept. Out of reach it comes as near as can be. ``start`` is where to look from, by default the
        positions of now: for a target that moves, what was found before.
        """
        link, begin = self._link(end), np.clip(self._all(start), self.lower, self.upper)
        found = self._reach(link, target, rotation, point, begin)
        if found.off > REACH_CLOSE:
            aside = NUDGE * np.where(np.arange(len(begin)) % 2, -1.0, 1.0) * self._tree.moving(link)
            other = self._reach(link, target, rotation, point, np.clip(begin + aside, self.lower, self.upper))
            if other.off < found.off - REACH_CLOSE:
                return other
        return found

    def _reach(
        self, link: int, target: npt.ArrayLike, rotation: npt.ArrayLike | None, point: npt.ArrayLike, start: Floats
    ) -> Reach:
        angles, wanted = +start, quaternion.IDENTITY if rotation is None else quaternion.normalise(rotation)
        off = reach_target(
            self._tree.arrays, self._room(), self._tree.moving(link), self.slots >= 3, self.lower, self.upper, link,
            *(np.array(values, np.float64) for values in (point, target, wanted)),
            3 if rotation is None else 6, REACH_CLOSE, angles, np.zeros((6, len(angles))),
        )  # fmt: skip
        return Reach(angles, float(off))

    def _placed(self, angles: Floats) -> Links:
        links = self._room()
        place_links(self._tree.arrays, angles, links)
        return links

    def _room(self) -> Links:
        transform, base = self._world[Transform], self._tree.links[0]
        if base == WORLD:
            return self._tree.room(np.zeros(3), np.array(quaternion.IDENTITY))
        return self._tree.room(transform.position[base], transform.rotation[base])

    def _frames(self, rows: Integers, anchors: Floats, frames: Floats) -> tuple[Floats, Floats]:
        """Return where frames (n, 3), (n, 4) of bodies of these rows, -1 for the world, are in the world."""
        transform, there = self._world[Transform], (rows >= 0)[:, None]
        place = transform.position[rows] + quaternion.rotate(transform.rotation[rows], anchors)
        turn = quaternion.multiply(transform.rotation[rows], frames)
        return np.where(there, place, anchors), np.where(there, turn, frames)

    def _all(self, positions: npt.ArrayLike | None) -> Floats:
        """Return positions of all ways, those of now where none are given."""
        if positions is None:
            return self.positions()
        given = np.array(positions, np.float64)
        if given.shape != self.slots.shape:
            names = ", ".join(dict.fromkeys(self._world.name(entity) for entity in self.joints))
            raise DeclarationError(
                f"kinematics take {len(self.slots)} positions, one for each way of {names}; received {given.size}"
            )
        return given

    def _link(self, end: str | int) -> int:
        """Return the number of a link."""
        world, links = self._world, self._tree.links
        row = world.row(world.find(end) if isinstance(end, str) else int(end))
        if row not in links:
            base = "the world" if self.base is None else f"'{world.name(self.base)}'"
            raise DeclarationError(f"no joints hold '{world.name(world.entity(row))}' to {base}")
        return links.index(row)
