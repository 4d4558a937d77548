"""Joint tree: the bodies that joints hold to a base, one after another."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.joint import LINE, LOCKED, SWING_TWIST, Joint
from carom.ecs.errors import DeclarationError
from carom.systems.ends import ends_there

WORLD = -1


class JointTree:
    """Links in order of how many joints are between them and the base, which is link 0.

    ``links`` are their rows, -1 for the world. Joint e, of the row ``joints[e]``, goes from link ``parent[e]`` to link
    e + 1, ``forwards`` where that is its b. Ways that are not locked are numbered: m is ``slot[m]`` of joint
    ``edge[m]``. A joint that closes a loop is left out, and so are those along a line. Raises DeclarationError for
    those of twist and swing.
    """

    def __init__(self, world: World, base: int) -> None:
        joint, found = world[Joint], list(outwards(world, base))
        self.links = [base, *(link for *_, link in found)]
        self.joints: Integers = np.array([row for row, *_ in found], np.int64)
        self.parent: Integers = np.array([parent for _, parent, *_ in found], np.int64)
        self.forwards: Booleans = np.array([forwards for *_, forwards, _ in found], np.bool_)
        rows = self.joints
        for unsaid in rows[(joint.about[rows] == SWING_TWIST) & (joint.mode[rows, 4] != LOCKED)]:
            raise DeclarationError(
                f"joint '{world.name(world.entity(unsaid))}' measures twist and swing, which do not say how it is "
                "turned; kinematics take joints about axes"
            )
        free = joint.mode[rows] != LOCKED
        self.edge, self.slot = np.nonzero(free)
        way = np.where(free, np.cumsum(free).reshape(free.shape) - 1, -1)
        into, out, to_b = [], [], self.forwards[:, None]
        for of_a, of_b in ((joint.anchor_a[rows], joint.anchor_b[rows]), (joint.frame_a[rows], joint.frame_b[rows])):
            into.append(np.where(to_b, of_a, of_b))
            out.append(np.where(to_b, of_b, of_a))
        self.arrays = (self.parent, self.forwards, *into, *out, way, joint.lower[rows])

    def ends(self) -> tuple[Integers, Integers]:
        """Return the rows of a and b of each joint, -1 for the world."""
        links = np.array(self.links, np.int64)
        inner, outer = links[self.parent], links[1:]
        return np.where(self.forwards, inner, outer), np.where(self.forwards, outer, inner)

    def moving(self, link: int) -> Booleans:
        """Tell which ways (m,) move a link: those of the joints between it and the base."""
        path = []
        while link > 0:
            path.append(link - 1)
            link = int(self.parent[link - 1])
        return np.isin(self.edge, path)

    def room(self, position: Floats, rotation: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Return room for the poses of links, the base at its own, and for axes and pivots of ways."""
        count, ways = len(self.links), len(self.slot)
        places, turns = np.empty((count, 3)), np.empty((count, 4))
        places[0], turns[0] = position, rotation
        return places, turns, np.zeros((ways, 3)), np.zeros((ways, 3))


def outwards(world: World, base: int) -> Iterator[tuple[int, int, bool, int]]:
    """Yield the row of each joint, the number of the link it goes from, whether that is its a, and the row beyond."""
    along, found = world[Joint].along, ends_there(world, Joint)
    leads: dict[int, list[tuple[int, bool, int]]] = defaultdict(list)
    for row, a, b in zip(*(rows[along[found[0]] != LINE].tolist() for rows in found), strict=True):
        leads[a].append((row, True, b))
        leads[b].append((row, False, a))
    links = [base]
    for number, link in enumerate(links):
        for row, forwards, beyond in leads[link]:
            if beyond != WORLD and beyond not in links:
                links.append(beyond)
                yield row, number, forwards, beyond
