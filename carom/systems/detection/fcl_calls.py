"""What FCL is asked of pairs of solid shapes: whether they overlap, and along what.

Nothing else: its signed distance hangs and aborts the process in deep, concentric and touching poses, any distance to a
half space crashes it, and of a gap it says up to 0.4 mm and 1 % too much.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs.column import Booleans, Floats

NO_DIRECTION = (0.0, 0.0, 0.0)


def ask_fcl(staying: list[Any], moving: list[Any], turns: Floats, shifts: Floats) -> tuple[Booleans, Floats]:
    """Return which pairs FCL sees overlap, and its normals from the first to the second, zero where it has none.

    Pairs are objects that stay at the origin and such that are moved, by ``turns`` (n, 4), wxyz, and ``shifts``
    (n, 3), m.
    """
    from fcl import CollisionRequest, CollisionResult, collide

    request = CollisionRequest(num_max_contacts=1, enable_contact=True)
    overlaps = np.zeros(len(staying), np.bool_)
    normals: list[Any] = []
    for k, (one, two, turn, shift) in enumerate(zip(staying, moving, turns, shifts, strict=True)):
        two.setQuatRotation(turn)
        two.setTranslation(shift)
        found = CollisionResult()
        if collide(one, two, request, found):
            overlaps[k] = True
            normals.append(found.contacts[0].normal)
        else:
            normals.append(NO_DIRECTION)
    return overlaps, np.array(normals, np.float64)
