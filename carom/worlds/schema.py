"""The schema of a world file: its sections and their words."""

from __future__ import annotations

import math
from functools import cache
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, WrapValidator, create_model, model_validator

from carom.ecs import Collider, Motion, RigidBody, Transform, Visual
from carom.ecs.components.rigid_body import BodyType
from carom.worlds.color import ColorWord
from carom.worlds.errors import ValueFault, shown
from carom.worlds.generated import column_fields, law_fields, material_model, setting_fields, shape_fields
from carom.worlds.values import Flag, In, Name, Vector3, Whole, Words, either, word_of

VERSION = 1
Length = Annotated[float, In("m")]
Lengths = Annotated[Vector3, In("m")]
Count = Annotated[int, Whole(1)]
LayersMet = Annotated[list[str] | Literal["all"], WrapValidator(lambda value, handler: _layers_met(value))]


def _layers_met(value: Any) -> list[str] | None:
    if value == "all":
        return None
    if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
        raise ValueFault("is not a set of layers", received=shown(value), accepted="a list of names, or all")
    return value


class Grid(Words):
    """Copies of an entity on a grid, called like ``rain[3,0,1]``."""

    count: tuple[Count, Count, Count] = Field(description="copies along x, y and z")
    spacing: either(Length, Lengths, list) = Field(description="distance between neighbours (m), one or one per axis")  # type: ignore[valid-type]
    origin: Lengths = Field((0.0, 0.0, 0.0), description="where copy [0,0,0] is, added to transform.position (m)")


class OnEnter(Words):
    """What a sensor does to who enters."""

    layer: str = Field(description="layer given to who enters")


class Camera(Words):
    """A view of the world."""

    position: Lengths = Field(description="where it is (m)")
    target: Lengths = Field((0.0, 0.0, 0.0), description="what it looks at (m)")
    fov: Annotated[float, In("rad", above=0.0, most=math.pi)] = Field(math.radians(50.0), description="vertical field of view")
    up: Annotated[Vector3, In("1")] | None = Field(None, description="direction that is up in the picture, the world's up by default")


class Run(Words):
    """How long a run takes: a duration, a number of frames, or until everything rests."""

    duration: Annotated[float, In("s", above=0.0)] | None = Field(None, description="simulated time (s)")
    frames: Count | None = Field(None, description="steps")
    until: word_of("rest") = Field(None, description="until no body is faster than rest_speed")  # type: ignore[valid-type]
    rest_speed: Annotated[float, In("m/s", above=0.0)] = Field(0.001, description="speed that counts as rest (m/s)")
    at_most: Annotated[float, In("s", above=0.0)] = Field(60.0, description="longest time until rest (s)")

    @model_validator(mode="after")
    def check(self) -> Run:
        """Refuse a run with no end and one with two."""
        ends = [key for key in ("duration", "frames", "until") if getattr(self, key) is not None]
        if len(ends) != 1:
            raise ValueFault("must state one end", received=" and ".join(ends) or "none", accepted="duration, frames or until")
        return self


class Render(Words):
    """Pictures and films of the world."""

    width: Count = Field(640, description="pixels")
    height: Count = Field(480, description="pixels")
    fps: Annotated[float, In("Hz", above=0.0)] = Field(30.0, description="pictures per second of film")
    camera: str | None = Field(None, description="name of a camera, the first by default")
    background: ColorWord | None = Field(None, description="colour behind everything")


class Measure(Words):
    """What a value must be, and how near."""

    value: Any = Field(alias="is", description="the number or list of numbers it must be")
    within: Any = Field(description="largest difference, in the unit of the value or as a share like '1 %'")


class When(Words):
    """The moment of an event."""

    impact: tuple[str, str] | None = Field(None, description="two colliders that strike each other")
    enter: tuple[str, str] | None = Field(None, description="a sensor and who enters it")
    nth: Count = Field(1, description="which of these events, from 1")

    @model_validator(mode="after")
    def check(self) -> When:
        """Refuse both events and neither."""
        if (self.impact is None) is (self.enter is None):
            raise ValueFault("must state one event", received="both" if self.impact else "none", accepted="impact or enter")
        return self


class Expect(Words):
    """Something that must hold: one law, or values at a time or event, keyed like ``ball.position``."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Measure]
    energy: str | None = Field(None, description="'non-increasing' or 'constant within X'")
    momentum: str | None = Field(None, description="'constant within X'")
    angular_momentum: str | None = Field(None, description="'constant within X'")
    penetration: str | None = Field(None, description="'< 1 mm'")
    never: str | None = Field(None, description="condition, such as 'ball.position.y < 0'")
    always: str | None = Field(None, description="condition, such as 'speed(ball) < 3 m/s'")
    at: Annotated[float, In("s", least=0.0)] | None = Field(None, description="time of the values (s)")
    when: When | None = Field(None, description="event of the values")


def _model(title: str, doc: str, /, **fields: Any) -> type[Words]:
    return create_model(title, __base__=Words, __doc__=doc, **fields)


@cache
def document() -> type[Words]:
    """Return the model of a whole file, made from the registries as they are at the first call."""
    material = material_model()
    jitter = either(Length, Lengths, list)
    pose = column_fields(Transform, "position", "rotation")
    transform = _model("Transform", "Where an entity is.", **pose, jitter=(jitter, Field(None, description="seeded random offset within +- this (m)")))
    body_type = word_of(*(kind.name.lower() for kind in BodyType))
    body = _model(
        "Body",
        "Makes an entity move.",
        type=(body_type, Field("dynamic", description="dynamic obeys forces, kinematic keeps its velocity")),
        **column_fields(RigidBody, "mass", "inertia", "center_of_mass"),
    )
    names = list[str]
    collider = _model(
        "Collider",
        "The shape by which an entity touches others: exactly one shape.",
        **shape_fields(),
        **column_fields(Collider, "position", "rotation", "sensor"),
        layer=(str, Field("default", description="layer it is on")),
        collides_with=(names, Field(None, description="layers it meets, instead of its layer's own")),
        on_enter=(OnEnter, Field(None, description="sensor: what it does to who enters")),
    )
    visual = _model(
        "Visual", "What is seen.", **shape_fields(), **column_fields(Visual, "position", "rotation", "color", "visible")
    )
    words: dict[str, Any] = {
        "prefab": (str, Field(None, description="prefab whose words these extend")),
        "transform": (transform, Field(None, description="where it is")),
        "motion": (_model("Motion", "How it moves.", **column_fields(Motion, "linear", "angular")), Field(None, description="how it moves")),
        "body": (body, Field(None, description="makes it move; {} takes the mass from shape and density")),
        "collider": (collider, Field(None, description="the shape by which it touches others")),
        "material": (either(str, material), Field(None, description="name of a material, or its words")),
        "visual": (either(Flag, visual), Field(None, description="what is seen; false hides it")),
    }  # fmt: skip
    prefab = _model("Prefab", "Words shared by entities.", **words)
    grid = (Grid, Field(None, description="copies on a grid"))
    entity = _model("Entity", "One entity, or a grid of them.", name=(Name, Field(None, description="unique name")), **words, grid=grid)
    force = _model(
        "Force", "One force law and whom it acts on.", **law_fields(),
        entities=(names, Field(None, description="names, or patterns like shell_* and rain[*]; every body by default")),
    )  # fmt: skip
    step = _model("Step", "How time advances.", **setting_fields(in_step=True))
    return _model(
        "World", "A carom world.",
        carom=(Literal[1], Field(description="version of this format")),
        name=(str, Field("", description="title")),
        description=(str, Field("", description="what it shows")),
        up=(word_of("y", "z"), Field("y", description="which axis is up, for gravity's default, cameras and display")),
        **setting_fields(in_step=False),
        step=(step, Field(None, description="how time advances")),
        run=(Run, Field(None, description="how long a run takes")),
        materials=(dict[Name, material], Field({}, description="materials by name")),
        layers=(dict[Name, LayersMet], Field({}, description="layers, each with those it collides with, or all")),
        prefabs=(dict[Name, prefab], Field({}, description="prefabs by name")),
        entities=(list[entity], Field([], description="what exists")),  # type: ignore[valid-type]
        forces=(list[force], Field([], description="force laws")),  # type: ignore[valid-type]
        cameras=(dict[Name, Camera], Field({}, description="cameras by name")),
        render=(Render, Field(None, description="pictures and films")),
        expect=(list[Expect], Field([], description="what must hold in a run")),
    )  # fmt: skip
