"""Hierarchy: entities that others carry."""

from __future__ import annotations

from carom.ecs import Parent, Transform, World, system
from carom.ecs.hierarchy import compose


@system(reads=(Parent,), writes=(Transform,))
def carry_children(world: World, dt: float) -> None:
    """Place carried entities by the poses of those who carry them."""
    compose(world)
