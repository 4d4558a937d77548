"""What the response holds of contacts goes on where detection runs again in a substep, or the world grows."""

from __future__ import annotations

from carom.ecs import Motion, RigidBody, Transform, World, system
from carom.ecs.commands import Commands
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


@system(writes=(Commands,))
def crowd(world: World, dt: float) -> None:
    """Ask for many entities in the third step."""
    if world.frame == 3:
        world[Commands].spawn_many(500, Transform(), Motion(), RigidBody())


def test_what_rests_goes_on_resting_where_commands_make_the_world_larger() -> None:
    """Bodies that a system of the detection asks for have rows beyond those the contacts were grouped with.

    They were not there when reaches were foreseen, so that detection runs again in each substep of that step, which
    moves what settles by less than 0.1 mm.
    """
    found = []
    for grows in (False, True):
        simulation = Simulation(dt=1 / 60)
        simulation.add(collider={"plane": {}})
        for k in range(3):
            place = {"position": (0.1 * k, 0.5 + k, 0.0)}
            simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place, name=f"cube{k}")
        simulation.schedule = simulation.schedule.insert(crowd, after="find_contacts")
        capacity = simulation.world.capacity
        simulation.world.frame = 0 if grows else 100  # the third step comes to one of them only
        simulation.step(3)
        assert (simulation.world.capacity > capacity) is grows
        simulation.step(10)
        rows = [simulation.world.row(simulation.world.find(f"cube{k}")) for k in range(3)]
        found.append(simulation.world[Transform].position[rows].copy())
    assert abs(found[0] - found[1]).max() < 1e-4
