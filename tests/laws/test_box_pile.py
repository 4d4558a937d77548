"""A thousand boxes dropped into a bin come to rest."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion
from carom.ecs.relations.contact import Contact
from carom.tools.bench.contact_scenes import box_pile
from carom.tools.bench.engines import Carom
from carom.tools.bench.overlap import lost


def test_a_pile_of_a_thousand_boxes_comes_to_rest() -> None:
    """After 15 s none is as fast as 1 mm/s, no overlap is deeper than 2 cm, and none is lost."""
    scene = box_pile(1000)
    engine = Carom(scene)
    for _ in range(900):
        engine.step()
    world = engine.simulation.world
    contact = world[Contact]
    assert np.linalg.norm(world[Motion].linear[engine.rows], axis=1).max() < 1e-3
    assert contact.depth[: contact.count].max() <= 0.02
    assert lost(scene, engine.poses()[0]) == 0
