"""The JSON Schema says the same as the reader, and is made from the registries."""

from __future__ import annotations

import json
from typing import Any

import jsonschema
import pytest

from carom.ecs import Material, RigidBody
from carom.systems.forces import LAWS
from carom.systems.shapes import SHAPES
from carom.worlds import json_schema, library
from carom.worlds.reader import read


@pytest.fixture(scope="module")
def validator() -> Any:
    """Return a validator of world files."""
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@pytest.mark.parametrize("name", library.names())
def test_library_worlds_are_valid(validator: Any, name: str) -> None:
    """Every world of the library fits the schema that editors use."""
    path = library.find(name)
    validator.validate(read(path.read_text(encoding="utf-8"), path.name).data)


@pytest.mark.parametrize(
    "text",
    [
        "name: no header",
        "{carom: 2}",
        "{carom: 1, entitys: []}",
        "{carom: 1, entities: [{name: 3}]}",
        "{carom: 1, entities: [{body: {mass: -1}}]}",
        "{carom: 1, entities: [{body: {mass: heavy}}]}",
        "{carom: 1, entities: [{collider: {sphere: {radius: 0}}}]}",
        "{carom: 1, entities: [{collider: {sphere: {}}}]}",
        "{carom: 1, entities: [{collider: {shpere: {radius: 1}}}]}",
        "{carom: 1, entities: [{transform: {position: [1, 2]}}]}",
        "{carom: 1, entities: [{transform: {rotation: {axis: [0, 1, 0]}}}]}",
        "{carom: 1, entities: [{keyframes: [{position: [1, 2, 3]}]}]}",
        "{carom: 1, entities: [{keyframes: {frames: [{at: 0}, {at: 1}], repeat: twice}}]}",
        "{carom: 1, entities: [{joint: {hing: {b: door}}}]}",
        "{carom: 1, entities: [{joint: {hinge: {b: door, limits: [1]}}}]}",
        "{carom: 1, entities: [{joint: {rope: {b: door, length: -1}}}]}",
        "{carom: 1, entities: [{joint: {hinge: {b: door, motor: {sped: 1}}}}]}",
        "{carom: 1, entities: [{joint: {generic: {b: door, x: fre}}}]}",
        "{carom: 1, forces: [{wind: {velocity: [1, 0, 0]}, region: {sphere: {radius: 0}}}]}",
        "{carom: 1, forces: [{wind: {velocity: [1, 0, 0]}, during: [start, 1]}]}",
        "{carom: 1, events: [{release: [pin]}]}",
        "{carom: 1, events: [{at: 1, explode: {impulse: 0}}]}",
        "{carom: 1, events: [{at: 1, spawn: {joint: {}}}]}",
        "{carom: 1, step: {dt: 0}}",
        "{carom: 1, materials: {ivory: {friction: {value: 1, combine: often}}}}",
        "{carom: 1, expect: [{at: 1, ball.position: {is: 3}}]}",
    ],
)
def test_what_the_reader_refuses_the_schema_refuses(validator: Any, text: str) -> None:
    """An editor sees what the reader would refuse."""
    assert not validator.is_valid(read(text, "w.yaml").data)


def test_it_is_made_from_the_registries() -> None:
    """Shapes, laws and columns are all there, with unit and meaning."""
    definitions = json_schema()["$defs"]
    assert set(SHAPES) <= set(definitions["Collider"]["properties"])
    assert set(LAWS) <= set(definitions["Force"]["properties"])
    columns = {name for name in Material.columns if name != "number" and not name.endswith("_combine")}
    assert set(definitions["Material"]["properties"]) == columns
    mass = definitions["Body"]["properties"]["mass"]
    assert mass["description"] == f"{RigidBody.columns['mass'].doc} (kg)"
    assert mass["x-unit"] == "kg"


def test_it_is_json() -> None:
    """It holds no value that JSON has no word for."""
    assert (
        json.loads(json.dumps(json_schema(), allow_nan=False))["$schema"]
        == "https://json-schema.org/draft/2020-12/schema"
    )
