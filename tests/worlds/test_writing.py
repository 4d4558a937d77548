"""Worlds in memory are written to files that load to the same state, to the bit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from carom.ecs import CaromError, first_difference, state_hash
from carom.systems.compound import StatedBodies
from carom.systems.settings import Random
from carom.systems.shapes import SHAPES
from carom.systems.shapes.geometry import Geometries
from carom.systems.simulation import Simulation
from carom.worlds import library, load_text, load_world, world_text, write_world

STATE = "\nstate:\n"


def loaded_as(simulation: Simulation, text: str) -> Simulation:
    """Return what a text loads to, which must be a simulation of the same state and settings."""
    found = load_text(text, "written.yaml")
    assert found.warnings == []
    assert first_difference(found.simulation.world, simulation.world) is None
    assert state_hash(found.simulation.world) == state_hash(simulation.world)
    assert found.simulation.settings == simulation.settings
    return found.simulation


@pytest.mark.parametrize("name", library.names())
def test_words_alone_say_every_library_world(name: str) -> None:
    """Written before the first step and loaded again, it is the same to the bit, and no snapshot helps."""
    world = load_world(name)
    text = world_text(world)
    assert STATE not in text
    again = load_text(text, "written.yaml")
    assert first_difference(again.simulation.world, world.simulation.world) is None
    assert (again.name, again.up, again.cameras, again.render, again.recording, again.run) == (
        world.name, world.up, world.cameras, world.render, world.recording, world.run,
    )  # fmt: skip
    assert [str(item.outcome().expected) for item in again.expectations] == [
        str(item.outcome().expected) for item in world.expectations
    ]


@pytest.mark.parametrize("name", ["billiards", "camera_follow", "newtons_cradle", "spring_mass", "trap", "whip"])
def test_a_world_in_mid_run_goes_on_as_if_nothing_had_been(name: str) -> None:
    """Warm starts, sleep, the generator and the time come back, and so does all that follows."""
    simulation = load_world(name).simulation
    simulation.step(25)
    again = loaded_as(simulation, world_text(simulation))
    assert again.frame == 25
    simulation.step(5)
    again.step(5)
    assert state_hash(again.world) == state_hash(simulation.world)


def test_the_text_is_what_a_person_would_write() -> None:
    """Only what differs from the defaults, in SI, one line for whom one suffices."""
    simulation = Simulation(dt=1 / 240, seed=4)
    simulation.material("ivory", friction=0.05, restitution=0.9, color=(1.0, 0.0, 0.2))
    simulation.layers({"balls": None, "ghosts": ["balls"]})
    ball = {"collider": {"sphere": {"radius": 0.1}, "layer": "balls"}, "body": {"mass": 0.2}, "material": "ivory"}
    simulation.add(name="left", motion={"linear": (1, -0.0, 0)}, transform={"position": (-1, 2, 0)}, **ball)
    simulation.add(name="right", transform={"position": (1 / 3, 2, 0)}, tags=["red"], **ball)
    simulation.add(name="floor", collider={"plane": {}}, visual=False)
    simulation.add(name="rod", joint={"distance": {"a": "left", "b": "right"}})
    simulation.force("wind", [simulation.world.find("left")], during=(0.5, "end"), velocity=(1, 0, 0))
    assert (
        world_text(simulation)
        == """carom: 1
seed: 4
step: {dt: 1/240}
materials: {ivory: {friction: 0.05, restitution: 0.9, color: "#ff0033"}}
layers: {balls: all, ghosts: [balls]}
entities:
  - name: left
    transform: {position: [-1, 2, 0]}
    motion: {linear: [1, -0.0, 0]}
    body: {mass: 0.2}
    collider: {sphere: {radius: 0.1}, layer: balls}
    material: ivory
  - name: right
    transform: {position: [0.3333333333333333, 2, 0]}
    body: {mass: 0.2}
    collider: {sphere: {radius: 0.1}, layer: balls}
    material: ivory
    tags: [red]
  - {name: floor, collider: {plane: {}}, visual: false}
  - {name: rod, joint: {distance: {a: left, b: right, length: 1.3333333333333333}}}
forces:
  - {wind: {velocity: [1, 0, 0]}, entities: [left], during: [0.5, end]}
"""
    )


def test_meshes_hulls_and_land_are_written_triangle_by_triangle() -> None:
    """In the order they are in, on which every bit of what follows depends."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    points = np.random.default_rng(7).normal(size=(20, 3))
    simulation = Simulation()
    simulation.add(collider={"mesh": {"vertices": corners, "faces": faces}})
    simulation.add(collider={"convex": {"points": points}}, body={}, transform={"position": (0, 3, 0)})
    simulation.add(collider={"convex": {"points": np.indices((2, 2, 2)).reshape(3, -1).T}}, body={})
    simulation.add(visual={"mesh": {"vertices": corners, "faces": faces[:2]}, "color": (1, 0, 0)})
    simulation.add(collider={"height_field": {"heights": np.arange(12).reshape(3, 4) / 7, "spacing": (0.3, 0.7)}})
    text = world_text(simulation)
    assert STATE not in text
    again = loaded_as(simulation, text)
    pairs = zip(simulation.world[Geometries].items, again.world[Geometries].items, strict=True)
    for one, other in pairs:
        np.testing.assert_array_equal(one.vertices, other.vertices)
        np.testing.assert_array_equal(one.faces, other.faces)


def test_the_generator_is_told_by_how_far_it_has_gone() -> None:
    """Draws are counted from the seed; half of a draw that is left over is state."""
    simulation = Simulation(seed=3)
    simulation.world[Random].generator.uniform(size=1_000_007)
    assert world_text(simulation) == "carom: 1\nseed: 3\ndrawn: 1000007\n"
    simulation.world[Random].generator.integers(10, dtype=np.int32)
    text = world_text(simulation)
    assert STATE in text
    again = loaded_as(simulation, text)
    drawn = [
        one.world[Random].generator.integers(1 << 30, size=5, dtype=np.int32).tolist() for one in (simulation, again)
    ]
    assert drawn[0] == drawn[1]


def test_model_files_are_named_and_laid_beside(tmp_path: Path) -> None:
    """So a large mesh stays short and keeps its looks; where the file is gone its triangles are written."""
    (tmp_path / "here" / "parts").mkdir(parents=True)
    model = tmp_path / "here" / "parts" / "box.obj"
    model.write_text(trimesh.creation.box().export(file_type="obj"))
    (tmp_path / "here" / "w.yaml").write_text(
        "carom: 1\nentities: [{name: box, collider: {mesh: {file: parts/box.obj, unit: cm}}}]\n"
    )
    loaded = load_world(tmp_path / "here" / "w.yaml")
    (tmp_path / "there").mkdir()
    write_world(loaded, tmp_path / "there" / "w.yaml")
    assert "collider: {mesh: {file: parts/box.obj, unit: cm}}" in (tmp_path / "there" / "w.yaml").read_text()
    assert (tmp_path / "there" / "parts" / "box.obj").read_bytes() == model.read_bytes()
    assert first_difference(load_world(tmp_path / "there" / "w.yaml").simulation.world, loaded.simulation.world) is None
    (tmp_path / "there" / "parts" / "box.obj").write_text("another")
    with pytest.raises(CaromError) as caught:
        write_world(loaded, tmp_path / "there" / "w.yaml")
    told = "is another file than the one that the world names so; write elsewhere"
    assert str(caught.value) == f"{tmp_path / 'there' / 'parts' / 'box.obj'} {told}"
    model.unlink()
    assert "vertices" in world_text(loaded)
    loaded_as(loaded.simulation, world_text(loaded))


def test_hulls_of_those_who_are_gone_keep_their_numbers() -> None:
    """States hold numbers of geometries, and who comes later may have one that was there before."""
    points = [np.random.default_rng(seed).normal(size=(8, 3)) for seed in range(3)]
    simulation = Simulation()
    hulls = [
        simulation.add(name=f"h{n}", collider={"convex": {"points": one}}, body={}) for n, one in enumerate(points)
    ]
    simulation.world.despawn(hulls[0])
    simulation.add(name="again", collider={"convex": {"points": points[1]}}, transform={"position": (9, 0, 0)})
    again = loaded_as(simulation, world_text(simulation))
    for one in (simulation, again):
        one.add(name="late", collider={"convex": {"points": points[0]}}, body={}, transform={"position": (5, 0, 0)})
        one.step(2)
    assert again["late"].collider.geometry == 0
    assert state_hash(again.world) == state_hash(simulation.world)


@pytest.mark.parametrize("key", sorted(set(SHAPES) - {"mesh", "convex", "height_field"}))
def test_every_shape_says_the_words_that_state_it(key: str) -> None:
    """The registry is all it takes: a new shape has its words by declaring parameters."""
    kind = SHAPES[key]
    stated = {field.name: (0.3, 0.4, 0.5) if "width" in field.metadata else 0.7 for field in kind.parameters()}
    shape = kind.stated(**stated)
    assert kind.stated(**shape.words()) == shape


def test_what_is_said_of_those_in_reused_rows_is_said_of_them_again() -> None:
    """A handle counts who had its row before; forces and what bodies weigh by go with the entities of now."""
    simulation = Simulation()
    ball: dict[str, Any] = {"collider": {"sphere": {"radius": 0.1}}, "body": {"mass": 0.5}}
    simulation.world.despawn(simulation.add(name="first", **ball))
    entity = simulation.add(name="second", transform={"position": (0, 1, 0)}, **ball)
    simulation.force("constant_push", [entity], force=(3, 0, 0))
    again = loaded_as(simulation, world_text(simulation))
    assert again.world.find("second") == entity
    assert again.world[StatedBodies].words == {entity: {"mass": 0.5}}
    simulation.step()
    again.step()
    assert again["second"].motion.linear[0] == simulation["second"].motion.linear[0] > 0.0


def test_events_to_come_are_written_and_those_that_were_are_not() -> None:
    """Who is gone is named no more; who is to come is stated in words, and comes."""
    simulation = load_text("""carom: 1
materials: {red: {color: red}}
entities:
  - {name: a, collider: {sphere: {radius: 0.1}}, body: {}, material: red}
  - {name: b, collider: {sphere: {radius: 0.1}}, body: {}, transform: {position: [1, 0, 0]}}
events:
  - {at: 0.05 s, despawn: [a]}
  - {at: 0.1 s, impulse: {entities: [a, b], linear: [1, 0, 0]}}
  - {at: 0.1 s, explode: {impulse: 3, position: [0, -1, 0]}}
  - {at: 0.15 s, spawn: {name: c, collider: {box: {size: [1, 1, 1]}}, body: {}, material: red}}
""").simulation
    simulation.step(4)
    text = world_text(simulation)
    assert (
        text.partition("events:\n")[2].partition("\n\nstate")[0]
        == """\
  - {at: 0.1, impulse: {entities: [b], linear: [1, 0, 0]}}
  - {at: 0.1, explode: {impulse: 3, position: [0, -1, 0]}}
  - {at: 0.15, spawn: {name: c, body: {}, collider: {box: {size: [1, 1, 1]}}, material: red}}"""
    )
    again = loaded_as(simulation, text)
    simulation.step(8)
    again.step(8)
    assert again.world.names() == ["c", "b"]
    assert state_hash(again.world) == state_hash(simulation.world)
