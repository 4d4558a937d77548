"""Prefabs: bundles of components under one name, spawned with or without changes."""

from __future__ import annotations

from collections.abc import Iterable

from carom.ecs.component import Component, Record
from carom.ecs.errors import DeclarationError


class Prefab:
    """Components that make up a kind of thing: ``world.spawn(ball, Transform(position=(0, 1, 0)))``.

    A prefab may extend others; of several values for a column the last one counts.
    """

    def __init__(self, *bundles: Component | Prefab) -> None:
        self.bundles = tuple(merge(bundles))


def merge(bundles: Iterable[Component | Prefab]) -> list[Component]:
    """Return one bundle for each kind, with the last value stated for each column."""
    merged: dict[type[Record], Component] = {}
    for bundle in bundles:
        for part in bundle.bundles if isinstance(bundle, Prefab) else (bundle,):
            kind = type(part)
            if not isinstance(part, Component):
                name = part.__name__ if isinstance(part, type) else kind.__name__
                received = f"the class {name}; write {name}(...)" if isinstance(part, type) else f"{name} {part!r}"
                raise DeclarationError(f"an entity is made of components and prefabs, received {received}")
            if kind not in merged:
                merged[kind] = kind()
            vars(merged[kind]).update(vars(part))
    return list(merged.values())
