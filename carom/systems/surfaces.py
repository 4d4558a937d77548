"""Surfaces: what an entity touches others with, and what is seen of it, from its words in SI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from carom.ecs import Collider, Material, Visual, World
from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.constants import FARTHEST
from carom.systems.layers import EVERYTHING, Layers
from carom.systems.materials import opaque
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Bounds
from carom.systems.shapes.stating import shapes_of, stacked

Words = Mapping[str, Any]
COLLIDER_COLUMNS = ("position", "rotation", "sensor", "surface_velocity")
BODY_COLOR = (0.35, 0.55, 0.8, 1.0)  # of bodies of which none is stated, so that they stand out from what is static


def collider_of(world: World, words: Words, shapes: Sequence[Shape]) -> Collider:
    """Return the Collider bundle of words whose shape, or the shape of each entity, is known."""
    layers = world[Layers]
    layer = words.get("layer", "default")
    mask = layers.mask(words["collides_with"]) if "collides_with" in words else layers.masks.get(layer, EVERYTHING)
    values = _shape_columns(world, shapes)
    bounds = stacked([shape.bounds() for shape in shapes])
    reach = float(np.max(np.asarray(bounds.half) + np.asarray(bounds.radius)[..., None], initial=0.0))
    if FARTHEST < reach < np.inf:
        raise DeclarationError(f"collider: reaches {reach:.3g} m, farther than detection can tell, {FARTHEST:g} m")
    center, half, radius = _offset_bounds(bounds, words)
    values |= {key: words[key] for key in COLLIDER_COLUMNS if key in words}
    values |= {"layer": layers.bit(layer), "mask": mask}
    values |= {"bound_center": center, "bound_half": half, "bound_radius": radius}
    enters = (words.get("on_enter") or {}).get("layer")
    if enters is not None:
        values |= {"enter_layer": layers.bit(enters), "enter_mask": layers.masks.get(enters, EVERYTHING)}
    return Collider(**values)


def visual_of(
    world: World,
    words: Words | bool | None,
    collider: Words | None,
    shapes: Sequence[Shape],
    material: Material,
    moves: bool,
) -> Visual | None:
    """Return the Visual bundle of words; None for what is not seen. Raises DeclarationError for what has no shape."""
    if words is False or (words is None and (collider is None or collider.get("sensor", False))):
        return None
    look: Words = words if isinstance(words, Mapping) else {}
    own = any(key in SHAPES for key in look) or "shape" in look
    drawn = shapes_of(look, seen=True) if own else shapes
    if not drawn:
        raise DeclarationError(f"visual: an entity without a collider states one shape of {', '.join(sorted(SHAPES))}")
    place = look if own else collider or {}
    values = _shape_columns(world, drawn)
    values |= {key: place[key] for key in ("position", "rotation") if key in place}
    finished = any(part.finish for part in getattr(getattr(drawn[0], "geometry", None), "parts", ()))
    plain = (1.0, 1.0, 1.0) if finished else getattr(material, "color", BODY_COLOR if moves else None)
    color = look.get("color", plain)
    if color is not None:
        values["color"] = opaque(color)
    return Visual(**values, visible=look.get("visible", True))


def _offset_bounds(bounds: Bounds, words: Words) -> tuple[Floats, Floats, Floats]:
    rotation = words.get("rotation", quaternion.IDENTITY)
    half, radius = np.asarray(bounds.half), np.asarray(bounds.radius)
    center = np.asarray(words.get("position", (0.0, 0.0, 0.0))) + quaternion.rotate(rotation, bounds.center)
    if "rotation" not in words:
        return center, half, radius
    return center, (np.abs(quaternion.matrix(rotation)) * half[..., None, :]).sum(axis=-1), radius


def _shape_columns(world: World, shapes: Sequence[Shape]) -> dict[str, Any]:
    geometries = [getattr(shape, "geometry", None) for shape in shapes]
    numbers = [-1 if geometry is None else world[Geometries].number(geometry) for geometry in geometries]
    size = [shape.packed() for shape in shapes]
    if len(shapes) == 1:
        return {"shape": shapes[0].number, "size": size[0], "geometry": numbers[0]}
    return {"shape": shapes[0].number, "size": np.array(size), "geometry": np.array(numbers)}
