"""Who may hide contacts at seams is asked once, and anew where something was done from outside."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider
from carom.systems.detection.seams import Seams
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation

BALL, BOX = {"sphere": {"radius": 0.5}}, {"box": {"size": (1.0, 1.0, 1.0)}}


def told(simulation: Simulation) -> tuple[list[int], list[int], list[int], bool]:
    """Return the rows of those that roll, glide and lie, and whether some may hide contacts, as of the last step."""
    seams = simulation.world[Seams]
    rolls, glides, lies = (np.flatnonzero(column).tolist() for column in (seams.rolls, seams.glides, seams.lies))
    return rolls, glides, lies, seams.hide


def test_rows_that_nobody_is_in_make_nobody_a_compound_body() -> None:
    """A ball in the first of them rolls as any other, and a world of balls on boxes has nothing to hide."""
    simulation = Simulation()
    simulation.add(collider=BALL, body={}, transform={"position": (0.0, 1.0, 0.0)})
    for x in (0.0, 1.0):
        simulation.add(collider=BOX, transform={"position": (x, 0.0, 0.0)})
    simulation.step()
    assert told(simulation) == ([0], [], [1, 2], False)


def test_who_comes_and_who_changes_is_seen() -> None:
    """A box that glides, one beside what lies, a part of a body, a ball instead of a box."""
    simulation = Simulation()
    simulation.add(collider=BOX)
    body = simulation.add(collider=BOX, body={}, transform={"position": (0.0, 1.0, 0.0)})
    simulation.step()
    assert told(simulation) == ([], [1], [0], False)
    simulation.add(collider=BOX, transform={"position": (1.0, 0.0, 0.0)})
    simulation.step(2)
    assert told(simulation) == ([], [1], [0, 2], True)
    world = simulation.world
    with world.edit(Collider) as collider:
        collider.shape[world.row(body)] = Sphere.number
    simulation.step()
    assert told(simulation) == ([1], [], [0, 2], False)
    simulation.add(collider=BOX, parent={"entity": body, "position": (0.0, 1.0, 0.0)})
    simulation.step()
    assert told(simulation) == ([], [1, 3], [0, 2, 3], True)
