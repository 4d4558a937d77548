"""Entities are made many at a time, and are those that would have been made one by one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import yaml

from carom.ecs import RigidBody, state_hash
from carom.systems.compound import StatedBodies
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text

TURNED = [0.5, 0.5, 0.5, 0.5]


def entity(number: int) -> dict[str, Any]:
    """Return words of one of six forms, with numbers of its own."""
    size, forms = 0.1 + 0.01 * number, ("sphere", "box", "still", "hull", "seen", "light")
    words: dict[str, Any] = {"name": f"one_{number}", "transform": {"position": [float(number), 1.0, 0.0]}}
    match forms[number % 6]:
        case "sphere":
            words |= {"collider": {"sphere": {"radius": size}}, "body": {}, "motion": {"linear": [-0.0, size, 0.0]}}
            words["material"] = {"density": 1000.0 * size, "color": [size, 0.5, 0.5]}
        case "box":
            box = {"box": {"size": [size, 1.0, 0.3]}, "position": [0.0, size, 0.0], "rotation": TURNED}
            words |= {"collider": box, "body": {"mass": size, "locked": ["x"]}, "visual": {"sphere": {"radius": size}}}
        case "still":
            words |= {"collider": {"capsule": {"radius": size, "length": 1.0}, "sensor": number % 4 == 0}}
        case "hull":
            points = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, 1.0]]
            words |= {"collider": {"convex": {"points": points}}, "body": {"inertia": [size, size, 1.0]}}
        case "seen":
            words |= {"visual": {"box": {"size": [size, size, size]}, "color": [1.0, 0.0, size]}}
        case "light":
            words |= {
                "collider": {"point": {}},
                "body": {"mass": size, "gravity_scale": size, "sleeps": number % 4 == 3},
            }
    return words


def test_entities_that_differ_are_those_made_one_by_one() -> None:
    """To the last bit, in their order, whatever their forms and in whatever order these come."""
    order = np.random.default_rng(7).permutation(48).tolist()
    stated = [entity(number) for number in (*range(12), *(12 + number for number in order))]
    loaded = load_text(yaml.safe_dump({"carom": 1, "entities": stated}, sort_keys=False)).simulation
    alone = Simulation()
    for words in stated:
        alone.add(**words)
    assert loaded.world.names() == [words["name"] for words in stated]
    assert state_hash(loaded.world) == state_hash(alone.world)
    assert loaded.world[StatedBodies].words.keys() == alone.world[StatedBodies].words.keys()


def test_each_of_many_may_have_numbers_of_its_own() -> None:
    """Python says once what is alike and gives the rest as arrays; later the bodies are known each by its own words."""
    places, masses, sizes = np.zeros((5, 3)), np.linspace(1.0, 2.0, 5), np.linspace(0.1, 0.5, 15).reshape(5, 3)
    places[:, 0] = np.arange(5)
    words = {"collider": {"box": {"size": sizes}}, "body": {"mass": masses}, "material": {"friction": masses / 4.0}}
    many, alone = Simulation(), Simulation()
    made = many.add_many(places, motion={"linear": sizes}, **words)
    for place, mass, size in zip(places, masses, sizes, strict=True):
        box = {"box": {"size": size}}
        alone.add(
            transform={"position": place}, collider=box, body={"mass": mass}, material={"friction": mass / 4.0},
            motion={"linear": size},
        )  # fmt: skip
    assert state_hash(many.world) == state_hash(alone.world)
    assert [many.world[StatedBodies].words[entity]["mass"] for entity in made.tolist()] == masses.tolist()
    assert many.world[RigidBody].mass[many.world.slots.rows(made)].tolist() == masses.tolist()


def test_who_is_wrong_among_many_is_told_where_it_stands() -> None:
    """Three of a hundred of one form, and one more that is wrong beside a name: all of them, and nobody else."""
    radii = ["1e-200" if n in (0, 41, 99) else n + 1 for n in range(100)]
    ball = "  - {{name: b_{}, collider: {{sphere: {{radius: {}}}}}, body: {{}}}}"
    lines = [ball.format(n, radius) for n, radius in enumerate(radii)]
    lines[50] = "  - {name: b_50, collider: {point: {}}, body: {}}"
    with pytest.raises(WorldError) as caught:
        load_text("carom: 1\nentities:\n" + "\n".join(lines) + "\n")
    thin = "collider.sphere: its volume must be from 2.2e-308 m3 on, received 0 m3"
    mass = "body.mass: must be finite and above 0 kg, received 0; state mass, or a shape with volume"
    assert str(caught.value).split("\n") == [
        f"world.yaml:3:28: entities.0.{thin}",
        f"world.yaml:44:29: entities.41.{thin}",
        f"world.yaml:53:41: entities.50.{mass}",
        f"world.yaml:102:29: entities.99.{thin}",
    ]
