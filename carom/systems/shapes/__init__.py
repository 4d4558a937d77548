"""Shapes, one file each; importing this package fills the registry."""

from carom.systems.shapes import (
    box,
    capsule,
    cone,
    convex,
    cylinder,
    ellipsoid,
    height_field,
    mesh,
    plane,
    point,
    sphere,
)
from carom.systems.shapes.shape import BY_NUMBER, SHAPES, Shape

__all__ = [
    "BY_NUMBER",
    "SHAPES",
    "Shape",
    "box",
    "capsule",
    "cone",
    "convex",
    "cylinder",
    "ellipsoid",
    "height_field",
    "mesh",
    "plane",
    "point",
    "sphere",
]
