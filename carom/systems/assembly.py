"""Assembly: entities from the words of a world file, in SI numbers; files and Python both come through here."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Entity, ExternalForce, Force, Material, Motion, RigidBody, Transform, World, tag
from carom.ecs.column import Integers
from carom.ecs.component import Component
from carom.ecs.components.collider import ColliderPose
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.errors import DeclarationError
from carom.ecs.hierarchy import compose
from carom.ecs.spatial import quaternion
from carom.systems.compound import StatedBodies, joining, weigh
from carom.systems.entity_words import refuse_words
from carom.systems.freedom import refuse_locked_motion
from carom.systems.joints.stating import joint_of
from carom.systems.mass import Part, rigid_body
from carom.systems.materials import material_of
from carom.systems.own_components import own_component
from carom.systems.particles.words import emitter_of
from carom.systems.paths import path_of, stated
from carom.systems.settings import Settings, time_of
from carom.systems.shapes import Shape
from carom.systems.shapes.stating import shapes_of, stacked
from carom.systems.surfaces import collider_of, visual_of

Words = Mapping[str, Any]
ENTITY_WORDS = (
    "name", "transform", "motion", "body", "keyframes", "collider", "material", "visual", "emitter", "joint", "tags"
)  # fmt: skip


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
    """Add an entity at each position (n, 3), m; ``words`` are those of `add_entity`, for all.

    A number, or list of numbers, may be given for each entity, a row of an array: ``body={"mass": masses}``.
    """
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
        world[StatedBodies].note(entities, words["body"])
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
    """Return the components that the words of an entity stand for, or of many where numbers have a row for each."""
    refuse_words(
        {
            "transform": transform,
            "motion": motion,
            "body": body,
            "material": material,
            "collider": collider,
            "visual": visual,
        }
    )
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
        bundles.append(Transform(**(transform or {})))
    else:
        bundles += path_of(world, {"transform": transform, "motion": motion, "body": body, "keyframes": keyframes})
    shapes = shapes_of(collider) if collider is not None else []
    if collider is not None:
        if shapes[0].static and body is not None:
            raise DeclarationError(f"collider.{shapes[0].key}: only a static entity may have it; remove body")
        bundles += [collider_of(world, collider, shapes), ColliderPose()]
    if body is not None:
        dimensions = world[Settings].dimensions
        refuse_locked_motion(motion or {}, body.get("locked", ()), dimensions)
        bundles += [
            _body(body, shapes, collider or {}, surface, dimensions),
            Motion(**(motion or {})),
            ExternalForce(),
            Force(),
            Flight(),
        ]
    elif motion is not None:
        raise DeclarationError("motion: a static entity does not move; give it a body")
    seen = visual_of(world, visual, collider, shapes, surface, body is not None)
    if seen is not None:
        bundles.append(seen)
    if emitter is not None:
        bundles.append(emitter if isinstance(emitter, Emitter) else emitter_of(emitter, time_of(world)))
    if body is not None and "parent" in own:
        raise DeclarationError("parent: a body moves by forces, not with who carries it; remove body or parent")
    return bundles + further


def _body(words: Words, shapes: Sequence[Shape], collider: Words, material: Material, dimensions: int) -> RigidBody:
    if not shapes:
        return rigid_body(words, [], dimensions)
    position = np.asarray(collider.get("position", (0.0, 0.0, 0.0)), np.float64)
    rotation = np.asarray(collider.get("rotation", quaternion.IDENTITY), np.float64)
    density = np.asarray(getattr(material, "density", Material.columns["density"].default), np.float64)
    solid = stacked([shape.mass_properties() for shape in shapes])
    return rigid_body(words, [Part(solid, density, position, rotation)], dimensions)
