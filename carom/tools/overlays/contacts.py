"""Contacts: where colliders touch, with their normals, longer the harder they press."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.touching import touching_rows
from carom.tools.marks import Arrows, Mark, Points, tinted
from carom.tools.overlays.overlay import Overlay, Scaling, Seen

COLOR = (1.0, 0.42, 0.2)
ASLEEP = (0.55, 0.62, 0.8)


class ContactMarks(Overlay):
    """A dot for each point that touches, and an arrow along its normal, onto b, as long as its impulse is large.

    They are drawn over everything, since a contact lies between two bodies and one of them would hide it.
    """

    key: ClassVar[str] = "contacts"

    def __init__(self) -> None:
        self._scaling = Scaling(0.15)

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return dots and arrows; those of bodies that sleep are blue."""
        world = seen.world
        points, impulses, colors = [], [], []
        for kind, color in ((Contact, COLOR), (SleepingContact, ASLEEP)):
            which = touching_rows(world[kind])
            points.append(world[kind].point[which])
            impulses.append(world[kind].impulse[which, None] * world[kind].normal[which])
            colors.append(tinted(color, len(which)))
        starts, tints = np.concatenate(points), np.concatenate(colors)
        ends = starts + self._scaling.metres(np.concatenate(impulses), seen)
        key = self._scaling.key("impulse", "N s", COLOR, seen)
        return [Arrows(starts, ends, tints, 2.0), Points(starts, tints, 5.0), *key]
