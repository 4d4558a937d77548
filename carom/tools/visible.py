"""Visible: who is there to be seen."""

from __future__ import annotations

import numpy as np

from carom.ecs import Component, Transform, Visual, World
from carom.ecs.column import Integers


def visible_rows(world: World, *kinds: type[Component]) -> Integers:
    """Return the rows of all who have a pose and a look that is not hidden, and these components too."""
    rows = world.row_numbers(Visual, Transform, *kinds)
    return np.asarray(rows[world[Visual].visible[rows]])
