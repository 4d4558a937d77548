"""Sensors: who enters and leaves them, when inside the step, and the layer a sensor gives to those who enter."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World, system
from carom.ecs.column import Booleans
from carom.ecs.commands import Commands
from carom.ecs.components.flight import Flight
from carom.ecs.relations.enter import Enter, Exit, Inside
from carom.ecs.relations.impact import Impact
from carom.systems.constants import SENSED
from carom.systems.courses import Courses
from carom.systems.crossings import Search, carry_out, is_out, may_trip
from carom.systems.detection.answered import Answered
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.sensors import Sensing
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.threads import Threads

Pair = tuple[int, int]  # sensor, entity


@system(
    reads=(RigidBody, Motion, Transform, Flight, Collider, Impact, Settings, Geometries, Threads, Progress),
    writes=(
        Enter, Exit, Inside, Sensing, ColliderPose, Answered, FclObjects, PackedHulls, PackedMeshes, Commands,
    ),
)  # fmt: skip
def sense(world: World, dt: float) -> None:
    """Tell who entered and left sensors on the way flown, and when."""
    sensing, clock = world[Sensing], world[Progress].clock
    if not len(sensing.pairs) and not world[Inside].count:
        return
    sensing.keep(np.all(world.slots.live(sensing.pairs), axis=1))
    pairs = list(map(tuple, sensing.pairs.tolist()))
    table = world[Inside]
    held = zip(table.sensor[: table.count].tolist(), table.entity[: table.count].tolist(), strict=True)
    inside: dict[Pair, float] = dict(zip(held, table.since[: table.count].tolist(), strict=True))
    crossed = [(clock, *pair, False) for pair in inside.keys() - set(pairs)]  # gone, far away, or no longer sensed
    for number, search in searches(world, sensing, np.array([pair in inside for pair in pairs], np.bool_), dt):
        crossed += [(clock + time, *pairs[number], comes) for time, comes in search.found]
    if not crossed:
        return
    crossed.sort(key=lambda row: row[:3])
    for time, sensor, entity, comes in crossed:
        if comes:
            inside[sensor, entity] = time
            _give_layer(world, sensor, entity)
        else:
            inside.pop((sensor, entity), None)
    for kind, comes in ((Enter, True), (Exit, False)):
        _log(world, kind, [row[:3] for row in crossed if row[3] is comes])
    world.resize(Inside, len(inside))
    table = world[Inside]
    for row, (sensor, entity) in enumerate(sorted(inside)):
        table.sensor[row], table.entity[row], table.since[row] = sensor, entity, inside[sensor, entity]


def searches(world: World, sensing: Sensing, inside: Booleans, span: float) -> list[tuple[int, Search]]:
    """Return what was found of each pair, by its number, that may have crossed a border in the substep.

    Only those are measured that are so near a border that they may come to it.
    """
    if not len(inside):
        return []
    courses = Courses(world, sensing, span)
    before = courses.gaps(np.arange(len(inside)), np.zeros(len(inside))) if sensing.gaps is None else sensing.gaps
    after = before - np.copysign(courses.speed * span, before)
    near = np.nonzero((np.abs(before) < courses.speed * span + SENSED) | is_out(before, inside))[0]
    if len(near) and sensing.gaps is not None:
        before[near] = courses.gaps(near, np.zeros(len(near)))
    if len(near):
        after[near] = courses.gaps(near, np.full(len(near), span))
    sensing.gaps = after
    bend = np.where((courses.knot > 0.0).any(axis=1), np.inf, courses.bend)
    crosses = may_trip(before[near], after[near], inside[near], courses.speed[near], bend[near], span)
    crosses |= is_out(before[near], inside[near]) | is_out(after[near], inside[near])
    found: list[tuple[int, Search]] = []
    for pair in near[crosses].tolist():
        knots = sorted({knot for knot in courses.knot[pair].tolist() if knot > 0.0})
        found.append((pair, Search(float(courses.speed[pair]), float(courses.bend[pair]), knots, bool(inside[pair]))))
    asking = [(pair, search.run(float(before[pair]), float(after[pair]), span)) for pair, search in found]
    carry_out(asking, courses.gaps)
    return found


def _log(world: World, kind: type[Enter] | type[Exit], crossed: list[tuple[float, int, int]]) -> None:
    """Append rows to a table, and keep it in order."""
    first = world.count(kind)
    world.resize(kind, first + len(crossed))
    table = world[kind]
    for row, (time, sensor, entity) in enumerate(crossed, first):
        table.time[row], table.sensor[row], table.entity[row] = time, sensor, entity
    order = np.lexsort((table.entity[: table.count], table.sensor[: table.count], table.time[: table.count]))
    for column in (table.time, table.sensor, table.entity):
        column[: len(order)] = column[order]


def _give_layer(world: World, sensor: int, entity: int) -> None:
    row = world.row(sensor)
    layer, mask = int(world[Collider].enter_layer[row]), int(world[Collider].enter_mask[row])
    if layer >= 0:
        world[Commands].ask(lambda world: _change_layer(world, entity, layer, mask))


def _change_layer(world: World, entity: int, layer: int, mask: int) -> None:
    if entity not in world:
        return
    with world.edit(Collider) as collider:
        row = world.row(entity)
        collider.layer[row], collider.mask[row] = layer, mask
