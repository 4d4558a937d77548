"""What FCL is asked of pairs of solid shapes: whether they overlap, and along what.

Nothing else: its signed distance hangs and aborts the process in deep, concentric and touching poses, any distance to a
half space crashes it, and of a gap it says up to 0.4 mm and 1 % too much.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs.column import Booleans, Floats


def ask_fcl(staying: list[Any], moving: list[Any], turns: Floats, shifts: Floats) -> tuple[Booleans, Floats]:
    """Return which pairs FCL sees overlap, and its normals from the first to the second, zero where it has none.

    Pairs are objects that stay at the origin and such that are moved, by ``turns`` (n, 4), wxyz, and ``shifts``
    (n, 3), m.
    """
    from fcl import CollisionRequest, CollisionResult, collide

    request, found = CollisionRequest(num_max_contacts=1, enable_contact=True), CollisionResult()
    contacts = found.contacts  # emptied each time: a new result would take a tenth of the call
    overlaps, normals = np.zeros(len(staying), np.bool_), np.zeros((len(staying), 3))
    for k, (one, two, turn, shift) in enumerate(zip(staying, moving, turns, shifts, strict=True)):
        two.setQuatRotation(turn)
        two.setTranslation(shift)
        if collide(one, two, request, found):
            overlaps[k], normals[k] = True, contacts[0].normal
            contacts.clear()
    return overlaps, normals
