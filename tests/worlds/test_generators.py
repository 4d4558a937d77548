"""Generators lay copies where they say, none in another, the same ones in every run."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Transform
from carom.ecs.relations.contact import Contact
from carom.ecs.snapshot import state_hash
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.worlds import LoadedWorld, WorldError, load_text
from carom.worlds.generators import GENERATORS

BRICK = "collider: {box: {size: [0.4, 0.2, 0.1]}}, body: {mass: 1}"
LAID = {
    "grid": "grid: {count: [2, 3, 2], spacing: 0.5}",
    "line": "line: {count: 4, step: [0.5, 0, 0]}",
    "ring": "ring: {count: 8, radius: 2}",
    "stack": "stack: {count: 5, gap: 1 mm}",
    "wall": "wall: {count: [4, 3], gap: 1 mm}",
    "pyramid": "pyramid: {base: [4, 3], gap: 1 mm}",
    "heap": "heap: {count: 20, area: [2, 2], gap: 5 mm}",
    "random": "random: {count: 60, box: [4, 3, 3], gap: 1 mm, turned: true}",
}


def load(words: str, text: str = "", **options: int) -> LoadedWorld:
    """Return a world of the copies of one brick."""
    return load_text(f"carom: 1\n{text}entities:\n  - {{name: b, {BRICK}, {words}}}\n", "w.yaml", **options)


def positions(simulation: Simulation) -> np.ndarray:
    """Return the positions of all (n, 3), m."""
    return simulation.world[Transform].position[simulation.world.row_numbers(Transform)]


def places(words: str, text: str = "") -> np.ndarray:
    """Return the positions of the copies of a brick (n, 3), m."""
    return positions(load(words, text).simulation)


def test_every_generator_is_tried_here() -> None:
    """A new one finds its place in the tests below."""
    assert set(LAID) == set(GENERATORS)


@pytest.mark.parametrize("words", LAID.values(), ids=LAID)
def test_no_copy_is_in_another_and_a_seed_means_the_same_world(words: str) -> None:
    """Detection finds nothing that touches; the same file is the same state, bit by bit."""
    simulation = load(words).simulation
    assert state_hash(load(words).simulation.world) == state_hash(simulation.world)
    assert len(set(simulation.world.names())) == simulation.world.count(Transform)
    simulation.step()
    assert overlap(simulation) == 0.0


def test_what_is_in_another_would_be_found() -> None:
    """Bricks laid by a step shorter than they are overlap by what is missing."""
    simulation = load("line: {count: 3, step: [0.3, 0, 0]}", "gravity: [0, 0, 0]\n").simulation
    simulation.step()
    assert overlap(simulation) > 0.05


def overlap(simulation: Simulation) -> float:
    """Return by how much the deepest pair overlaps, m."""
    contacts = simulation.world[Contact]
    return float(max(0.0, np.max(contacts.depth[:], initial=0.0)))


def test_copies_are_where_their_numbers_say() -> None:
    """In a row, one upon another, in courses and layers over the joints of those below."""
    names = {key: load(words).simulation.world.names() for key, words in LAID.items()}
    assert names["line"] == ["b[0]", "b[1]", "b[2]", "b[3]"]
    assert names["grid"][:3] == ["b[0,0,0]", "b[0,0,1]", "b[0,1,0]"]
    assert [name for name in names["wall"] if name.startswith("b[1,")] == ["b[1,0]", "b[1,1]", "b[1,2]"]
    assert [name for name in names["pyramid"] if not name.startswith("b[0,")] == [
        "b[1,0,0]", "b[1,0,1]", "b[1,0,2]", "b[1,1,0]", "b[1,1,1]", "b[1,1,2]", "b[2,0,0]", "b[2,0,1]"
    ]  # fmt: skip
    np.testing.assert_allclose(places(LAID["line"])[3], [1.5, 0, 0], atol=1e-15)
    np.testing.assert_allclose(places(LAID["stack"])[4], [0, 4 * 0.201, 0], atol=1e-15)
    np.testing.assert_allclose(places(LAID["wall"])[4], [0.2005, 0.201, 0], atol=1e-15)
    np.testing.assert_allclose(places(LAID["pyramid"])[12], [0.2005, 0.201, 0.0505], atol=1e-15)
    np.testing.assert_allclose(places("pyramid: {base: [3, 1]}")[5], [0.4, 0.4, 0], atol=1e-15)
    assert len(places("pyramid: {base: [1, 1]}")) == 1


def test_size_is_that_of_the_copy_as_it_lies() -> None:
    """A brick that stands is as high as it is long, and one of a world with z up is stacked along z."""
    standing = places("transform: {rotation: {axis: [0, 0, 1], angle: 90 deg}}, stack: {count: 2}")
    np.testing.assert_allclose(standing[1], [0, 0.4, 0], atol=1e-15)
    np.testing.assert_allclose(places("stack: {count: 2}", "up: z\n")[1], [0, 0, 0.1], atol=1e-15)


def test_a_ring_goes_round_anticlockwise_and_turns_its_copies() -> None:
    """Each has its own x outward; seen from above, whichever axis is up."""
    simulation = load("ring: {count: 4, radius: 2}").simulation
    turned = quaternion.rotate(simulation.world[Transform].rotation[simulation.world.row_numbers(Transform)], (1, 0, 0))
    np.testing.assert_allclose(positions(simulation), [[2, 0, 0], [0, 0, -2], [-2, 0, 0], [0, 0, 2]], atol=1e-15)
    np.testing.assert_allclose(2.0 * turned, positions(simulation), atol=1e-15)
    flat = places("ring: {count: 4, radius: 2, start: 90 deg, turned: false}", "up: z\n")
    np.testing.assert_allclose(flat, [[0, 2, 0], [-2, 0, 0], [0, -2, 0], [2, 0, 0]], atol=1e-15)


def test_copies_scattered_lie_in_their_region_and_differ_by_seed() -> None:
    """Whole, in box and ball; another seed is another world."""
    reach = np.linalg.norm([0.2, 0.1, 0.05])
    assert (np.abs(places("random: {count: 50, box: [3, 4, 5]}")) <= np.array([1.5, 2, 2.5]) - reach).all()
    assert (np.linalg.norm(places("random: {count: 50, sphere: 2}"), axis=1) <= 2 - reach).all()
    one, other = (load(LAID["random"], seed=seed).simulation.world[Transform].position[0] for seed in (1, 2))
    assert (one != other).any()


def test_how_many_found_no_room_is_told() -> None:
    """A box that holds few is filled, and the rest are counted."""
    loaded = load("random: {count: 100, box: [1, 1, 1]}")
    made = loaded.simulation.world.count(Transform)
    assert 2 < made < 30
    assert loaded.warnings == [
        f"w.yaml:3:74: entities.0.random: {100 - made} of 100 copies found no room; take fewer, or a larger region"
    ]


def test_a_heap_over_a_vast_area_is_one_layer() -> None:
    """However many copies would fit in it beside each other, and even where their number is beyond all bounds."""
    for area in ("[1e30, 1e300]", "[2 m, 1e19 m]"):
        simulation = load(f"heap: {{count: 3, area: {area}}}").simulation
        assert positions(simulation)[:, 1] == pytest.approx(np.full(3, positions(simulation)[0, 1]))


def test_a_group_is_copied_with_all_its_members() -> None:
    """A ring of carts has each turned as one."""
    text = "carom: 1\nentities:\n  - name: seat\n    ring: {count: 2, radius: 3}\n    entities: [{name: leg, collider: {sphere: {radius: 0.1}}, transform: {position: [1, 0, 0]}}]\n"
    simulation = load_text(text).simulation
    assert simulation.world.names() == ["seat[0].leg", "seat[1].leg"]
    np.testing.assert_allclose(positions(simulation), [[4, 0, 0], [-4, 0, 0]], atol=1e-15)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("line: {count: 2, step: [1, 0, 0]}, stack: {count: 2}", "w.yaml:3:109: entities.0.stack: is stated beside line; state one of them"),
        ("random: {count: 2}", "w.yaml:3:74: entities.0.random: must state one region; received neither; accepted: box or sphere"),
        ("random: {count: 2, box: [1, 1, 1e200]}", "w.yaml:3:105: entities.0.random.box.2: must be at most 1e+100 m; received 1e+200"),
        ("random: {count: 2, box: [1, 1, 0.4]}", "w.yaml:3:93: entities.0.random.box: is too small for a copy, which lies within 0.229 m"),
        ("heap: {count: 2, area: [0.4, 2]}", "w.yaml:3:91: entities.0.heap.area: leaves no room for a copy, which needs 0.458 m each way"),
        ("stack: {count: 2000000}", "w.yaml:3:74: entities.0.stack: asks for 2000000 copies, at most 1000000 are made"),
        ("grid: {count: [1000, 1000, 1000], spacing: 1}", "w.yaml:3:74: entities.0.grid: asks for 1000000000 copies, at most 1000000 are made"),
        ("ring: {count: 2, radius: 0}", "w.yaml:3:91: entities.0.ring.radius: must be above 0 m; received 0"),
    ],
)  # fmt: skip
def test_what_cannot_be_laid_is_told(words: str, message: str) -> None:
    """Where it stands, before anything is made."""
    with pytest.raises(WorldError) as caught:
        load(words)
    assert str(caught.value) == message


LAMP = """
    entities:
      - {name: foot, collider: {box: {size: [0.4, 0.2, 0.4]}}, body: {}, transform: {position: [0, 0.1, 0]}}
      - {name: bulb, prefab: ball, transform: {position: [0, 0.5, 0]}}
"""


def test_groups_are_laid_by_how_large_they_are_together() -> None:
    """A lamp is 0.4 m by 0.6 m; turned by a quarter about z it is 0.6 m wide. Of a ball its reach counts, sqrt(0.44) m."""
    head = "carom: 1\nprefabs: {ball: {collider: {sphere: {radius: 0.1}}, body: {}}}\nentities:\n  - name: lamp\n    "
    stack = load_text(f"{head}stack: {{count: 3, gap: 1 cm}}{LAMP}").simulation
    assert stack["lamp[2].foot"].transform.position == pytest.approx([0, 2 * 0.61 + 0.1, 0])
    turned = "transform: {rotation: {axis: [0, 0, 1], angle: 90 deg}}\n    wall: {count: [2, 2]}"
    wall = load_text(f"{head}{turned}{LAMP}").simulation
    assert wall["lamp[0,1].bulb"].transform.position == pytest.approx([0.6 - 0.5, 0, 0])
    assert wall["lamp[1,0].bulb"].transform.position == pytest.approx([0.3 - 0.5, 0.4, 0])
    flung = load_text(f"{head}random: {{count: 20, box: [5, 5, 5]}}{LAMP}").simulation
    feet = np.array([flung[f"lamp[{n}].foot"].transform.position for n in range(20)]) - [0, 0.1, 0]
    assert np.abs(feet).max() <= 2.5 - 0.44**0.5 < np.abs(feet).max() + 0.3


def test_a_group_is_measured_with_all_that_is_in_it() -> None:
    """Copies of a member, links of a chain, who is carried, and groups of groups; draws of the world are left alone."""
    text = """carom: 1
seed: 3
entities:
  - name: pile
    stack: {count: 2}
    entities:
      - name: pair
        stack: {count: 2}
        entities:
          - {name: brick, collider: {box: {size: [1, 0.5, 1]}}, body: {}, line: {count: 2, step: [0, 0.5, 0]}}
          - {name: flag, parent: {entity: "brick[1]", position: [0, 1, 0]}, collider: {sphere: {radius: 0.25}}}
  - {name: leaf, collider: {sphere: {radius: 0.1}}, body: {}, random: {count: 3, box: [9, 9, 9]}}
"""
    simulation = load_text(text).simulation
    # One pair is from -0.25 m to 1.75 m, two of them 4 m high.
    assert simulation["pile[1].pair[1].brick[0]"].transform.position == pytest.approx([0, 6.0, 0])
    bare = load_text("carom: 1\nseed: 3\nentities:\n" + text[text.index("  - {name: leaf") :]).simulation
    assert [simulation[f"leaf[{n}]"].transform.position.tolist() for n in range(3)] == [
        bare[f"leaf[{n}]"].transform.position.tolist() for n in range(3)
    ]


def test_what_is_wrong_in_a_group_that_is_measured_is_told_once() -> None:
    """Where it is written, and nothing of whom it would have been copied to."""
    text = "carom: 1\nentities:\n  - name: a\n    stack: {count: 9}\n    entities: [{name: b, collider: {sphere: {radius: -1}}}]\nevents: [{at: 1 s, despawn: ['a[3].b']}]\n"
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert (
        str(caught.value) == "w.yaml:5:46: entities.0.entities.0.collider.sphere.radius: must be above 0 m; received -1"
    )


def test_a_group_is_measured_whatever_else_is_wrong() -> None:
    """A fault elsewhere is the only one told."""
    text = "carom: 1\nseed: -1\nentities:\n  - {name: a, stack: {count: 9}, entities: [{name: b, collider: {sphere: {radius: 1}}}]}\n"
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert str(caught.value) == "w.yaml:2:1: seed: must be a whole number; received -1; accepted: 0 or more"


def test_what_has_no_size_is_not_stacked() -> None:
    """A plane has no end, and an empty group no collider."""
    mend = "give it a collider of finite size, or write line or grid, which say how far apart copies are"
    for words in ("collider: {plane: {}}", "name: g, entities: []", "name: g, entities: [{collider: {plane: {}}}]"):
        with pytest.raises(WorldError, match=rf"\.stack: needs the size of what is copied; {mend}$"):
            load_text(f"carom: 1\nentities: [{{{words}, stack: {{count: 2}}}}]\n")
