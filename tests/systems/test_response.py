"""What a substep has counted of a pair's impacts goes on where detection runs again in its middle."""

from __future__ import annotations

from carom.ecs.entity import INDEX_BITS
from carom.ecs.relations.contact import Contact
from carom.systems.detection.contacts import detect_again
from carom.systems.response import drift
from carom.systems.simulation import Simulation


def test_counts_of_a_pair_survive_detection_and_end_with_the_substep() -> None:
    """They follow the pair to its new row, a new pair starts at none, and the next substep at none for all."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"plane": {}})
    for x in (0.0, 3.0):
        place = {"position": (x, 0.5, 0.0)}
        simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform=place, name=f"ball{x:.0f}")
    simulation.step()
    world = simulation.world
    with world.faces(None):
        contact = world[Contact]
        assert contact.count == 2
        contact.strikes[:2], contact.plastic[:2] = (5, 6), (3, 4)
        contact.b[0] += 1 << INDEX_BITS  # a pair that detection did not know
        detect_again(world, 1 / 240)
        assert contact.strikes[:2].tolist() == [0, 6]
        assert contact.plastic[:2].tolist() == [0, 4]
        drift(world, 1 / 240)
        assert contact.strikes[:2].tolist() == [0, 0]
        assert contact.plastic[:2].tolist() == [0, 0]
