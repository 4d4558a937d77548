"""Assembly: one entity from the words of a world file, in SI numbers; files and Python both come through here."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import (
    Collider,
    Combine,
    Entity,
    ExternalForce,
    Force,
    Material,
    Motion,
    RigidBody,
    Transform,
    Visual,
    World,
    tag,
)
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Component, Resource
from carom.ecs.components.collider import ColliderPose
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.errors import DeclarationError
from carom.ecs.hierarchy import compose
from carom.ecs.spatial import quaternion
from carom.systems.compound import StatedBodies, joining, weigh
from carom.systems.freedom import refuse_locked_motion
from carom.systems.joints.stating import joint_of
from carom.systems.layers import EVERYTHING, Layers
from carom.systems.mass import Part, rigid_body
from carom.systems.own_components import own_component
from carom.systems.particles.words import emitter_of
from carom.systems.paths import path_of, stated
from carom.systems.settings import Settings, time_of
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Bounds

Words = Mapping[str, Any]
COMBINE_QUANTITIES = ("friction", "restitution")
COLLIDER_COLUMNS = ("position", "rotation", "sensor", "surface_velocity")
ENTITY_WORDS = (
    "name", "transform", "motion", "body", "keyframes", "collider", "material", "visual", "emitter", "joint", "tags"
)  # fmt: skip


class Materials(Resource):
    """Materials by name, each as the words of a material."""

    def __init__(self) -> None:
        self.named: dict[str, Words] = {}

    def name(self, number: int) -> str:
        """Return the name of the material of that number, as in `Material` and `Hit`; empty for -1."""
        return "" if number < 0 else list(self.named)[number]


def add_entity(world: World, *, name: str | None = None, **words: Any) -> Entity:
    """Add one entity described in the words of a world file, all numbers SI.

    ``body`` makes it move (an empty mapping takes its mass from the shape's volume and the material's density); without
    one it is static. ``keyframes``, each with ``at`` (s), ``position`` and ``rotation``, are what a kinematic one goes
    along. ``visual`` False hides it, ``tags`` are names, and ``parent`` names who carries it: a collider that is
    carried belongs to the nearest body above it, whose mass grows by it unless stated. ``emitter`` brings forth
    particles where the entity is. ``joint`` makes it one, which holds two others and is at no place of its own. Further
    words are the keys of a user's own components, each with its columns: ``health={"points": 3}``. Raises
    DeclarationError for anything a file would be refused for.
    """
    entity = world.spawn(*bundles_of(world, **words), name=name)
    _settle(world, np.array([entity]), words)
    return entity


def add_entities(world: World, positions: npt.ArrayLike, *, names: list[str] | None = None, **words: Any) -> Integers:
    """Add an entity at each position (n, 3), m, all alike otherwise; ``words`` are those of `add_entity`."""
    places = np.asarray(positions, np.float64).reshape(-1, 3)
    if words.get("joint") is not None:
        if len(places) != 1:
            raise DeclarationError("joint: all copies would hold the same; add them one by one")
        return np.array([add_entity(world, name=None if names is None else names[0], **words)])
    if words.get("keyframes") is not None:
        if len(places) != 1:
            raise DeclarationError("keyframes: all copies would go the same way; add them one by one")
        frames, _, _ = stated(words["keyframes"])
        if frames and "position" not in frames[0]:
            words["transform"] = {**words.get("transform", {}), "position": places[0]}
        return np.array([add_entity(world, name=None if names is None else names[0], **words)])
    entities = world.spawn_many(len(places), *bundles_of(world, **words), Transform(position=places), names=names)
    _settle(world, entities, words)
    return entities


def _settle(world: World, entities: Integers, words: Words) -> None:
    """Note what was stated of bodies; place who is carried, and let who carries them weigh as much more."""
    if words.get("body") is not None:
        world[StatedBodies].words.update(dict.fromkeys(entities.tolist(), words["body"]))
    if words.get("parent", {}).get("entity", -1) < 0:
        return
    rows = world.slots.rows(entities)
    compose(world, rows)
    try:
        weigh(world, joining(world, rows))
    except DeclarationError:
        world.despawn(entities)
        raise


def bundles_of(
    world: World,
    *,
    transform: Words | None = None,
    motion: Words | None = None,
    body: Words | None = None,
    keyframes: Words | Sequence[Words] | None = None,
    collider: Words | None = None,
    material: str | Words | None = None,
    visual: Words | bool | None = None,
    emitter: Words | Emitter | None = None,
    joint: Words | Joint | None = None,
    tags: Iterable[str] = (),
    **own: Words,
) -> list[Component]:
    """Return the components that the words of an entity stand for."""
    further = [tag(label)() for label in tags] + [own_component(key, words, ENTITY_WORDS) for key, words in own.items()]
    if joint is not None:
        beside: dict[str, Any] = {
            "transform": transform,
            "motion": motion,
            "body": body,
            "keyframes": keyframes,
            "collider": collider,
        }
        beside |= {"material": material, "visual": visual, "emitter": emitter, "parent": own.get("parent")}
        surplus = [key for key, words in beside.items() if words]
        if surplus:
            raise DeclarationError(f"joint: is at no place of its own; remove {', '.join(surplus)}")
        return [joint if isinstance(joint, Joint) else joint_of(world, joint), *further]
    surface = material_of(world, material)
    bundles: list[Component] = [surface]
    if keyframes is None:
        bundles.append(_transform(transform or {}))
    else:
        bundles += path_of(world, {"transform": transform, "motion": motion, "body": body, "keyframes": keyframes})
    shape = shape_of(collider) if collider is not None else None
    if collider is not None and shape is not None:
        if shape.static and body is not None:
            raise DeclarationError(f"collider.{shape.key}: only a static entity may have it; remove body")
        bundles += [_collider(world, collider, shape), ColliderPose()]
    if body is not None:
        dimensions = world[Settings].dimensions
        refuse_locked_motion(motion or {}, body.get("locked", ()), dimensions)
        bundles += [
            _body(body, shape, collider or {}, surface, dimensions),
            Motion(**(motion or {})),
            ExternalForce(),
            Force(),
            Flight(),
        ]
    elif motion is not None:
        raise DeclarationError("motion: a static entity does not move; give it a body")
    seen = _visual(world, visual, collider, shape, surface)
    if seen is not None:
        bundles.append(seen)
    if emitter is not None:
        bundles.append(emitter if isinstance(emitter, Emitter) else emitter_of(emitter, time_of(world)))
    if body is not None and "parent" in own:
        raise DeclarationError("parent: a body moves by forces, not with who carries it; remove body or parent")
    return bundles + further


def shape_of(words: Words, *, seen: bool = False) -> Shape:
    """Return the shape that the words of a collider state, or those of a visual, which is only ``seen``."""
    if isinstance(words.get("shape"), Shape):
        return words["shape"]  # type: ignore[no-any-return]
    keys = [key for key in words if key in SHAPES]
    if len(keys) != 1:
        found = f"received {', '.join(keys)}" if keys else "received none"
        raise DeclarationError(f"state exactly one shape of {', '.join(sorted(SHAPES))}; {found}")
    value = words[keys[0]]
    if isinstance(value, Shape):
        return value
    try:
        kind = SHAPES[keys[0]]
        shape = kind.seen(**value) if seen else kind.stated(**value)
    except TypeError as fault:
        raise DeclarationError(f"{keys[0]}: {str(fault).partition('() ')[2] or fault}") from None
    for note in getattr(getattr(shape, "geometry", None), "notes", ()):
        warnings.warn(note, stacklevel=2)
    return shape


def material_of(world: World, material: str | Words | None) -> Material:
    """Return the Material bundle of a name or of words; quantities may be ``{value, combine}``."""
    values: dict[str, Any] = {}
    if isinstance(material, str):
        named = world[Materials].named
        if material not in named:
            raise DeclarationError(f"unknown material {material!r}; the materials are {', '.join(named) or 'none'}")
        values["number"] = list(named).index(material)
        material = named[material]
    for key, value in (material or {}).items():
        if key in COMBINE_QUANTITIES and isinstance(value, Mapping):
            values[key] = value["value"]
            values[f"{key}_combine"] = Combine[value["combine"].upper()].value
        else:
            values[key] = opaque(value) if key == "color" else value
    return Material(**values)


def opaque(color: Any) -> tuple[float, ...]:
    """Return a colour with its alpha, 1 where none is stated."""
    return (*color, 1.0) if len(color) == 3 else tuple(color)


def _transform(words: Words) -> Transform:
    return Transform(**words)


def _collider(world: World, words: Words, shape: Shape) -> Collider:
    layers = world[Layers]
    layer = words.get("layer", "default")
    mask = layers.mask(words["collides_with"]) if "collides_with" in words else layers.masks.get(layer, EVERYTHING)
    values: dict[str, Any] = _shape_columns(world, shape)
    center, half, radius = _offset_bounds(shape.bounds(), words)
    values |= {key: words[key] for key in COLLIDER_COLUMNS if key in words}
    values |= {"layer": layers.bit(layer), "mask": mask}
    values |= {"bound_center": center, "bound_half": half, "bound_radius": radius}
    enters = (words.get("on_enter") or {}).get("layer")
    if enters is not None:
        values |= {"enter_layer": layers.bit(enters), "enter_mask": layers.masks.get(enters, EVERYTHING)}
    return Collider(**values)


def _offset_bounds(bounds: Bounds, words: Words) -> tuple[Floats, Floats, float]:
    rotation = words.get("rotation", quaternion.IDENTITY)
    center = np.asarray(words.get("position", (0.0, 0.0, 0.0))) + quaternion.rotate(rotation, bounds.center)
    if "rotation" not in words:
        return center, np.asarray(bounds.half), bounds.radius
    return center, (np.abs(quaternion.matrix(rotation)) * np.asarray(bounds.half)).sum(axis=1), bounds.radius


def _shape_columns(world: World, shape: Shape) -> dict[str, Any]:
    geometry = getattr(shape, "geometry", None)
    number = -1 if geometry is None else world[Geometries].number(geometry)
    return {"shape": shape.number, "size": shape.packed(), "geometry": number}


def _body(words: Words, shape: Shape | None, collider: Words, material: Material, dimensions: int) -> RigidBody:
    if shape is None:
        return rigid_body(words, [], dimensions)
    position = np.asarray(collider.get("position", (0.0, 0.0, 0.0)), np.float64)
    rotation = np.asarray(collider.get("rotation", quaternion.IDENTITY), np.float64)
    density = float(getattr(material, "density", Material.columns["density"].default))
    return rigid_body(words, [Part(shape.mass_properties(), density, position, rotation)], dimensions)


def _visual(
    world: World, words: Words | bool | None, collider: Words | None, shape: Shape | None, material: Material
) -> Visual | None:
    if words is False or (words is None and (collider is None or collider.get("sensor", False))):
        return None
    look: Words = words if isinstance(words, Mapping) else {}
    own = any(key in SHAPES for key in look) or "shape" in look
    drawn = shape_of(look, seen=True) if own else shape
    if drawn is None:
        raise DeclarationError(f"visual: an entity without a collider states one shape of {', '.join(sorted(SHAPES))}")
    place = look if own else collider or {}
    values = _shape_columns(world, drawn)
    values |= {key: place[key] for key in ("position", "rotation") if key in place}
    finished = any(part.finish for part in getattr(getattr(drawn, "geometry", None), "parts", ()))
    color = look.get("color", (1.0, 1.0, 1.0) if finished else getattr(material, "color", None))
    if color is not None:
        values["color"] = opaque(color)
    return Visual(**values, visible=look.get("visible", True))
