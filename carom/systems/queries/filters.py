"""Filters: which colliders a query sees."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypedDict

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Booleans, Integers
from carom.systems.layers import Layers


class Filters(TypedDict, total=False):
    """What narrows a query: names of ``layers``, ``only`` these entities, ``without`` those, and with ``sensors``.

    ``tag`` narrows nothing; it is what the query is called in a recording.

    An entity stands for its own collider and, where it is a body, for all that belong to it. Colliders on layer
    ``none`` are never seen, sensors where they are asked for.
    """

    layers: Iterable[str] | str
    only: Iterable[int] | int
    without: Iterable[int] | int
    sensors: bool
    tag: str


def seen(world: World, rows: Integers, body: Integers, filters: Filters) -> Booleans:
    """Return for each row in use whether the filters let its collider through.

    Raises DeclarationError for an unknown layer and EntityError for an entity that lives no more.
    """
    collider, used = world[Collider], world.used()
    layers = filters.get("layers")
    mask = -1 if layers is None else world[Layers].mask([layers] if isinstance(layers, str) else layers)
    found = np.zeros(used, np.bool_)
    found[rows] = collider.layer[rows] & mask != 0
    if not filters.get("sensors", False):
        found &= ~collider.sensor[:used]
    if (only := filters.get("only")) is not None:
        found &= _belonging(world, body, only)
    if (without := filters.get("without")) is not None:
        found &= ~_belonging(world, body, without)
    return found


def _belonging(world: World, body: Integers, entities: Iterable[int] | int) -> Booleans:
    handles = np.fromiter(entities if isinstance(entities, Iterable) else [entities], np.int64)
    named = np.zeros(len(body), np.bool_)
    named[world.slots.rows(handles)] = True
    found: Booleans = named | (named[body] & (body >= 0))
    return found
