"""Sensors: who entered, and the layer a sensor gives to those who do."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.commands import Commands
from carom.ecs.relations.enter import Enter, Inside
from carom.systems.settings import Settings

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Found


def sense(world: World, found: Found) -> Found:
    """Take the sensors' pairs out of ``found``, log who newly overlaps one, and queue its change of layer."""
    sensor = world[Collider].sensor
    sensing_a = sensor[found.row_a]
    sensing = sensing_a | sensor[found.row_b]
    if not sensing.any():
        if world.count(Inside):
            world.resize(Inside, 0)
        return found
    overlapping = sensing & (found.depth >= 0.0)
    sensors = world.entities(np.where(sensing_a, found.row_a, found.row_b)[overlapping])
    entities = world.entities(np.where(sensing_a, found.row_b, found.row_a)[overlapping])
    now = sorted(set(zip(sensors.tolist(), entities.tolist(), strict=True)))  # each pair once, whatever its points
    inside = world[Inside]
    before = set(zip(inside.sensor[: inside.count].tolist(), inside.entity[: inside.count].tolist(), strict=True))
    for one, other in now:
        if (one, other) not in before:
            _log(world, one, other)
    world.resize(Inside, len(now))
    inside = world[Inside]
    inside.sensor[: len(now)], inside.entity[: len(now)] = [s for s, _ in now], [e for _, e in now]
    keep = ~sensing
    return found.take(keep)


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
