"""Labels: the names of bodies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.components.name import Name
from carom.tools.marks import Labels, Mark, tinted
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.visible import visible_rows

COLOR = (1.0, 1.0, 1.0)


class NameLabels(Overlay):
    """Names at the origins of what is seen, the nearest first: where two would overlap, the farther has none."""

    key: ClassVar[str] = "labels"

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the names of everything that has one and is visible."""
        world = seen.world
        rows = visible_rows(world, Name)
        positions = seen.transform.position[rows]
        away = ((positions - seen.view.camera.position) ** 2).sum(axis=1)
        order = np.argsort(away, kind="stable")
        names = world.names_of(world.entities(rows[order])).tolist()
        return [Labels(positions[order], names, tinted(COLOR, len(rows)), rows[order])]
