"""Sensors: who entered, and the layer a sensor gives to those who do."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.commands import Commands
from carom.ecs.relations.enter import Enter, Inside
from carom.systems.settings import Settings

if TYPE_CHECKING:
    from carom.systems.detection.contacts import Found


def sense(world: World, found: Found) -> Found:
    """Take the sensors' pairs out of ``found``, log who newly overlaps one, and queue its change of layer."""
    collider = world[Collider]
    if not collider.sensor.any() and not world.count(Inside):
        return found
    sensing_a, sensing_b = collider.sensor[found.row_a], collider.sensor[found.row_b]
    sensing = sensing_a | sensing_b
    overlapping = sensing & (found.depth >= 0.0)
    sensor = world.entities(np.where(sensing_a, found.row_a, found.row_b)[overlapping])
    entity = world.entities(np.where(sensing_a, found.row_b, found.row_a)[overlapping])
    now = {(int(s), int(e)) for s, e in zip(sensor, entity, strict=True)}
    inside = world[Inside]
    before = {(int(inside.sensor[k]), int(inside.entity[k])) for k in range(inside.count)}
    for s, e in sorted(now - before):
        _log(world, s, e)
    ordered = sorted(now)
    world.resize(Inside, len(ordered))
    inside = world[Inside]
    for k, (s, e) in enumerate(ordered):
        inside.sensor[k], inside.entity[k] = s, e
    keep = ~sensing
    return type(found)(*(column[keep] for column in found))


def _log(world: World, sensor: int, entity: int) -> None:
    count = world.count(Enter)
    world.resize(Enter, count + 1)
    enter = world[Enter]
    enter.time[count] = (world.frame - 1) * world[Settings].dt
    enter.sensor[count], enter.entity[count] = sensor, entity
    row = world.row(sensor)
    layer, mask = int(world[Collider].enter_layer[row]), int(world[Collider].enter_mask[row])
    if layer >= 0:
        world[Commands].ask(lambda world: _change_layer(world, entity, layer, mask))


def _change_layer(world: World, entity: int, layer: int, mask: int) -> None:
    with world.edit(Collider) as collider:
        row = world.row(entity)
        collider.layer[row], collider.mask[row] = layer, mask
