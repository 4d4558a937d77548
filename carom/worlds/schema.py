"""The schema of a world file: its sections and their words, as a model and as JSON Schema."""

from __future__ import annotations

import math
from functools import cache
from typing import Annotated, Any, Literal

from pydantic import Field, TypeAdapter, WithJsonSchema, create_model

from carom.ecs import Collider, Motion, RigidBody, Transform, Visual
from carom.ecs.components.rigid_body import BodyType
from carom.systems.extensions import load_extensions
from carom.systems.forces.region import Region
from carom.systems.freedom import AXES
from carom.systems.mass import PASSED_ON
from carom.systems.particles.words import EmitterWords
from carom.systems.surfaces import COLLIDER_COLUMNS
from carom.worlds.camera import Camera
from carom.worlds.expect_words import Expect
from carom.worlds.generated.columns import column_fields, material_model, own_fields
from carom.worlds.generated.parameters import (
    action_fields,
    generator_fields,
    joint_fields,
    law_fields,
    parameter_model,
    shape_fields,
)
from carom.worlds.generated.settings import setting_fields
from carom.worlds.generators.words import Gap, Gaps
from carom.worlds.sections import (
    ChainWords,
    Every,
    KeyframesWords,
    KeyframeWords,
    LayersMet,
    OnEnter,
    OracleWords,
    Placement,
    RecordingWords,
    Render,
    Run,
    Time,
    Times,
    TimeWindow,
)
from carom.worlds.state import StateWords
from carom.worlds.values import EntityName, FileName, Flag, Name, Whole, Words, either, word_of

Variable = Annotated[
    Any,
    WithJsonSchema({"type": ["number", "string", "boolean", "array", "object"]}),
]
Member = Annotated[Any, WithJsonSchema({"type": "object", "x-entity": True})]
SPAWNED = ("prefab", "transform", "motion", "body", "collider", "material", "visual", "tags")  # who comes later
Drawn = Annotated[int, Whole(0, 1 << 62)]
DIALECT = "https://json-schema.org/draft/2020-12/schema"


def _model(title: str, doc: str, /, **fields: Any) -> type[Words]:
    return create_model(title, __base__=Words, __doc__=doc, **fields)


@cache
def document() -> type[Words]:
    """Return the model of a whole file, made from the registries as they are at the first call."""
    load_extensions()
    material = material_model()
    transform = _model(
        "Transform",
        "Where an entity is.",
        **column_fields(Transform, "position", "rotation"),
        jitter=(either(Gap, Gaps, list), Field(None, description="seeded random offset within +- this (m)")),
    )
    motion = _model("Motion", "How an entity moves.", **column_fields(Motion, "linear", "angular"))
    body_type = word_of(*(kind.name.lower() for kind in BodyType))
    body = _model(
        "Body",
        "Makes an entity move.",
        type=(body_type, Field("dynamic", description="dynamic obeys forces, kinematic keeps its velocity")),
        **column_fields(RigidBody, "mass", "inertia", "principal_axes", "center_of_mass", *PASSED_ON),
        locked=(list[word_of(*AXES)], Field([], description="axes of the world it never moves along or turns about")),  # type: ignore[misc]
    )
    names = list[str]
    collider = _model(
        "Collider",
        "The shape by which an entity touches others: exactly one shape.",
        **shape_fields(),
        **column_fields(Collider, *COLLIDER_COLUMNS),
        layer=(str, Field("default", description="layer it is on")),
        collides_with=(names, Field(None, description="layers it meets, instead of its layer's own")),
        on_enter=(OnEnter, Field(None, description="sensor: what it does to who enters")),
    )
    visual = _model(
        "Visual", "What is seen.", **shape_fields(), **column_fields(Visual, "position", "rotation", "color", "visible")
    )
    joint = _model("Joint", "What holds two others together: exactly one kind.", **joint_fields())
    words: dict[str, Any] = {
        "prefab": (str, Field(None, description="prefab whose words these extend")),
        "transform": (transform, Field(None, description="where it is")),
        "motion": (motion, Field(None, description="how it moves")),
        "body": (body, Field(None, description="makes it move; {} takes the mass from shape and density")),
        "keyframes": (
            either(list[KeyframeWords], KeyframesWords), Field(None, description="poses a kinematic body goes along")
        ),
        "collider": (collider, Field(None, description="the shape by which it touches others")),
        "material": (either(str, material), Field(None, description="name of a material, or its words")),
        "visual": (either(Flag, visual), Field(None, description="what is seen; false hides it")),
        "emitter": (parameter_model(EmitterWords), Field(None, description="makes it a source of particles")),
        "joint": (joint, Field(None, description="makes it a joint, which holds two others")),
        "tags": (names, Field([], description="what it is, for queries")),
    }  # fmt: skip
    chain = (ChainWords, Field(None, description="copies as links, which joint joins"))
    named = (EntityName, Field(None, description="unique name"))
    copying, parts = generator_fields(), _group_fields()
    words |= own_fields((*words, "name", "chain", *copying, *parts))
    prefab = _model("Prefab", "Words shared by entities.", **words, **parts)
    entity = _model(
        "Entity", "One entity, many copies of it, or a group.", name=named, **words, **copying, chain=chain, **parts
    )
    force = _model(
        "Force", "One force law and whom it acts on.", **law_fields(),
        entities=(names, Field(None, description="names, or patterns like shell_* and rain[*]; every body by default")),
        region=(parameter_model(Region), Field(None, description="where centres of mass are that it acts on")),
        layers=(names, Field(None, description="layers of the colliders of whom it acts on")),
        during=(TimeWindow, Field(None, description="when it acts: [0.5 s, 2 s], or [0.5 s, end] for good")),
    )  # fmt: skip
    brought: dict[str, Any] = {"name": named, **{key: words[key] for key in SPAWNED}, **copying}
    spawn = _model("Spawn", "Who comes into the world: one entity, or many copies of it.", **brought)
    event = _model(
        "Event", "What is done at a time: exactly one action.",
        at=(Time, Field(description="simulated time; done at the start of the step that contains it (s)")),
        every=(Every, Field(None, description="from each time to the next, where it is done several times (s)")),
        times=(Times, Field(None, description="how often it is done; who comes is called hail[0], hail[1], ...")),
        **action_fields(),
        spawn=(spawn, Field(None, description="Brings an entity, or several that are alike, into the world.")),
    )  # fmt: skip
    step = _model("Step", "How time advances.", **setting_fields(in_step=True))
    return _model(
        "World", "A carom world.",
        carom=(Literal[1], Field(description="version of this format")),
        name=(str, Field("", description="title")),
        description=(str, Field("", description="what it shows")),
        up=(word_of("y", "z"), Field("y", description="which axis is up, for gravity's default, cameras and display")),
        include=(list[FileName], Field([], description="files beside this one whose words go under its own")),
        **setting_fields(in_step=False),
        drawn=(Drawn, Field(0, description="random numbers drawn before, as a written world has it")),
        step=(step, Field(None, description="how time advances")),
        run=(Run, Field(None, description="how long a run takes")),
        variables=(dict[str, Variable], Field({}, description="values by name, for ${table.length / 2}")),
        materials=(dict[Name, material], Field({}, description="materials by name")),  # type: ignore[valid-type]
        layers=(dict[Name, LayersMet], Field({}, description="layers, each with those it collides with, or all")),
        prefabs=(dict[Name, prefab], Field({}, description="prefabs by name")),  # type: ignore[valid-type]
        entities=(list[entity], Field([], description="what exists")),  # type: ignore[valid-type]
        forces=(list[force], Field([], description="force laws")),  # type: ignore[valid-type]
        oracle=(
            dict[str, either(word_of("ballistic", "kepler"), OracleWords)],  # type: ignore[misc]
            Field({}, description="by names or patterns: where entities should be; kepler is round the well"),
        ),
        events=(list[event], Field([], description="what is done at stated times")),  # type: ignore[valid-type]
        cameras=(dict[Name, Camera], Field({}, description="cameras by name")),
        render=(Render, Field(None, description="pictures and films")),
        recording=(RecordingWords, Field(None, description="recordings")),
        expect=(list[Expect], Field([], description="what must hold in a run")),
        state=(StateWords, Field(None, description="what words cannot say of a world that was written in mid-run")),
    )  # fmt: skip


@cache
def group_type() -> TypeAdapter[Any]:
    """Return the type of what a group says itself, beside its entities."""
    model = _model(
        "Group", "Entities placed together.",
        name=(Name, Field(description="unique name, which goes before those of its entities")),
        transform=(Placement, Field(Placement.model_validate({}), description="where it is")),
        **generator_fields(),
        parameters=_group_fields()["parameters"],
    )  # fmt: skip
    return TypeAdapter(model)


def _group_fields() -> dict[str, Any]:
    return {
        "parameters": (dict[str, Variable], Field({}, description="values by name, for expressions in these words")),
        "entities": (list[Member], Field([], description="makes it a group: what is placed together")),
    }


def json_schema() -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of a world file; each number says its unit under ``x-unit``."""
    return {"$schema": DIALECT, **_stated(document().model_json_schema())}


def _stated(node: Any) -> Any:
    """Return a node without defaults that JSON cannot hold or that only mean absence."""
    if isinstance(node, list):
        return [_stated(item) for item in node]
    if not isinstance(node, dict):
        return node
    if "x-entity" in node:
        return {"$ref": "#/$defs/Entity"}
    return {key: _stated(value) for key, value in node.items() if not (key == "default" and _empty(value))}


def _empty(value: Any) -> bool:
    return value is None or (isinstance(value, float) and not math.isfinite(value))
