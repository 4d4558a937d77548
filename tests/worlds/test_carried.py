"""Files say who carries whom, and tag what they make; Python says it in the same words."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import DeclarationError, Motion, Parent, Transform, state_hash, tag
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text

FILE = """carom: 1
gravity: [0, 0, 0]
entities:
  - {name: lamp, parent: {entity: mast, position: [0, 1, 0]}, tags: [light, red_team]}
  - {name: mast, parent: {entity: ship, position: [1, 0, 0], rotation: {axis: [0, 0, 1], angle: 90 deg}}}
  - name: ship
    transform: {position: [0, 5, 0]}
    motion: {linear: [1, 0, 0], angular: [0, 2, 0]}
    body: {}
    collider: {box: {size: [1, 1, 1]}}
  - {name: buoy, grid: {count: [2, 1, 2], spacing: 3}, tags: [light], collider: {sphere: {radius: 0.1}}}
"""


def test_who_is_carried_follows_also_before_the_first_step() -> None:
    """The lamp is at the ship's pose, then the mast's in it, then its own: whoever stands first in the file."""
    simulation = load_text(FILE).simulation
    half = np.sqrt(0.5)
    assert simulation["lamp"].transform.position.tolist() == pytest.approx([0.0, 5.0, 0.0], abs=1e-15)
    for _ in range(2):
        ship, lamp = simulation["ship"].transform, simulation["lamp"].transform
        mast = ship.position + quaternion.rotate(ship.rotation, (1.0, 0.0, 0.0))
        turned = quaternion.multiply(ship.rotation, (0.0, 0.0, half, half))
        expected = mast + quaternion.rotate(turned, (0.0, 1.0, 0.0))
        assert np.abs(lamp.position - expected).max() < 1e-14
        assert np.abs(lamp.rotation - turned).max() < 1e-15
        simulation.step(60)
    assert ship.position.tolist() == pytest.approx([2.0, 5.0, 0.0], abs=1e-12)


def test_tags_select() -> None:
    """A tag is a component without columns."""
    world = load_text(FILE).simulation.world
    assert world.query(tag("light")).entities.tolist() == [world.find("lamp"), *world.find_all("buoy")]
    assert world.query(tag("light"), without=tag("red_team")).entities.tolist() == world.find_all("buoy").tolist()
    assert world.query(Transform, any_of=(tag("red_team"), Motion)).entities.tolist() == [0, 2]


def test_python_says_it_in_the_same_words() -> None:
    """The same state, to the last bit, from `Simulation.add` and `add_many`."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    quarter = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.deg2rad(90.0))
    lamp = simulation.add(name="lamp", tags=["light", "red_team"])
    mast = simulation.add(name="mast")
    simulation.add(
        name="ship",
        transform={"position": (0.0, 5.0, 0.0)},
        motion={"linear": (1.0, 0.0, 0.0), "angular": (0.0, 2.0, 0.0)},
        body={},
        collider={"box": {"size": (1.0, 1.0, 1.0)}},
    )
    places = [(0.0, 0.0, 0.0), (0.0, 0.0, 3.0), (3.0, 0.0, 0.0), (3.0, 0.0, 3.0)]
    names = [f"buoy[{i},0,{k}]" for i in range(2) for k in range(2)]
    simulation.add_many(places, names=names, tags=["light"], collider={"sphere": {"radius": 0.1}})
    world = simulation.world
    world.attach(mast, Parent(entity=world.find("ship"), position=(1.0, 0.0, 0.0), rotation=quarter))
    world.attach(lamp, Parent(entity=mast, position=(0.0, 1.0, 0.0)))
    simulation.step()
    other = load_text(FILE).simulation
    other.step()
    assert state_hash(simulation.world) == state_hash(other.world)


def test_a_part_added_to_what_is_there_is_placed_at_once() -> None:
    """`add` with a parent needs no step to be in its place."""
    simulation = Simulation()
    ship = simulation.add(name="ship", transform={"position": (0.0, 5.0, 0.0)})
    simulation.add(name="mast", parent={"entity": ship, "position": (1.0, 0.0, 0.0)})
    assert simulation["mast"].transform.position.tolist() == [1.0, 5.0, 0.0]
    with pytest.raises(DeclarationError, match=r"^parent: a body moves by forces, .*; remove body or parent$"):
        simulation.add(parent={"entity": ship}, body={"mass": 1.0})


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (
            "parent: {entity: shop}",
            "3:24: entities.0.parent.entity: unknown entity; received 'shop'; accepted: a, ship",
        ),
        (
            "parent: {}",
            "2:1: entities: entity 'a' has a parent component but no parent; set parent.entity, or detach it",
        ),
        (
            "parent: {entity: a}",
            "2:1: entities: entities carry each other in a circle: 'a'; detach one from its parent",
        ),
        (
            "tags: [Red]",
            "3:15: entities.0.tags: 'Red' is no tag; write lower-case words joined by _, like 'red_team'",
        ),
        (
            "tags: [motion]",
            "3:15: entities.0.tags: 'motion' is the key of the component Motion; choose another",
        ),
    ],
    ids=["unknown", "nobody", "circle", "no tag", "taken"],
)
def test_faults(text: str, fault: str) -> None:
    """Each says where, what and how to mend."""
    with pytest.raises(WorldError) as caught:
        load_text(f"carom: 1\nentities:\n  - {{name: a, {text}}}\n  - {{name: ship}}\n")
    assert str(caught.value).startswith(f"world.yaml:{fault}")
