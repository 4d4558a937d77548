"""The loops of the bench of the table: a system as a user writes it, the best written by hand, and esper's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np

from carom.ecs import Motion, Phase, Schedule, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.systems.kernels.kernel import inlined, kernel
from carom.tools.bench.table_worlds import GONE, SETS, some

DT = 1 / 60
GRAVITY = (0.0, -9.81, 0.0)
Vector = tuple[float, float, float]


@inlined
def fall_row(row: int, position: Floats, velocity: Floats, gravity: Vector, dt: float) -> None:
    """Move one row by a semi-implicit step."""
    for k in range(3):
        velocity[row, k] += gravity[k] * dt
        position[row, k] += velocity[row, k] * dt


@kernel("position", "velocity")
def fall(rows: Integers, position: Floats, velocity: Floats, gravity: Vector, dt: float) -> None:
    """Move all rows: in one run where they are contiguous, which is vectorised, else one by one."""
    if len(rows) and rows[-1] - rows[0] == len(rows) - 1:
        for row in range(rows[0], rows[-1] + 1):
            fall_row(row, position, velocity, gravity, dt)
    else:
        for row in rows.view(np.uint64):  # without sign: none counts from the end
            fall_row(row, position, velocity, gravity, dt)


@system(writes=(Transform, Motion))
def fall_freely(world: World, dt: float) -> None:
    """Let everything that moves fall."""
    rows = world.row_numbers(Transform, Motion)
    fall(rows, world[Transform].position, world[Motion].linear, GRAVITY, dt)


def scheduled(world: World) -> Callable[[], None]:
    """Return one frame of carom."""
    schedule = Schedule(Phase("only", fall_freely))
    return lambda: schedule.run(world, DT)


def columns(world: World) -> tuple[Floats, Floats]:
    """Return position and velocity of all rows in use, to be written."""
    used = world.used()
    return world.table(Transform).arrays["position"][:used], world.table(Motion).arrays["linear"][:used]


@numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
def numba_all(position: Floats, velocity: Floats, gravity: Vector, dt: float) -> None:
    """Move every row of arrays that hold nobody else."""
    for row in range(len(position)):
        velocity[row, 0] += gravity[0] * dt
        velocity[row, 1] += gravity[1] * dt
        velocity[row, 2] += gravity[2] * dt
        position[row, 0] += velocity[row, 0] * dt
        position[row, 1] += velocity[row, 1] * dt
        position[row, 2] += velocity[row, 2] * dt


@numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
def numba_some(rows: Integers, position: Floats, velocity: Floats, gravity: Vector, dt: float) -> None:
    """Move these rows; given without sign, they need not be looked at for counting from the end."""
    for row in rows:
        velocity[row, 0] += gravity[0] * dt
        velocity[row, 1] += gravity[1] * dt
        velocity[row, 2] += gravity[2] * dt
        position[row, 0] += velocity[row, 0] * dt
        position[row, 1] += velocity[row, 1] * dt
        position[row, 2] += velocity[row, 2] * dt


def by_numba(world: World) -> Callable[[], None]:
    """Return the best loop over the same rows of the same columns that Numba compiles."""
    position, velocity = columns(world)
    if isinstance(found := world.rows(Transform, Motion), slice):
        return lambda: numba_all(position[found], velocity[found], GRAVITY, DT)
    rows = found.view(np.uint64)
    return lambda: numba_some(rows, position, velocity, GRAVITY, DT)


def by_numpy(world: World) -> Callable[[], None]:
    """Return the best of NumPy over the same rows of the same columns."""
    position, velocity = columns(world)
    rows: Any = world.rows(Transform, Motion)
    change = np.multiply(GRAVITY, DT)

    def step() -> None:
        velocity[rows] += change
        position[rows] += velocity[rows] * DT

    return step


class Position:
    """A component as esper's manual writes it."""

    __slots__ = ("x", "y", "z")

    def __init__(self, x: float, y: float, z: float) -> None:
        self.x, self.y, self.z = x, y, z


class Velocity(Position):
    """Another."""

    __slots__ = ()


class Mass:
    """A third."""


def by_esper(count: int, gaps: bool) -> Callable[[], None]:
    """Return one frame of esper over ``count`` entities, or over as many among others after the same despawns."""
    import esper

    esper.switch_world(f"bench {count} {gaps}")
    total = round(count * SETS / (SETS - 1) / (1 - GONE)) if gaps else count
    sets: list[tuple[type, ...]] = [(Velocity,), (Velocity, Mass), ()] if gaps else [(Velocity,)]
    made = []
    for k in range(total):
        parts = [Mass() if kind is Mass else kind(1.0, 2.0, 3.0) for kind in sets[k % len(sets)]]
        made.append(esper.create_entity(Position(0.0, 0.0, 0.0), *parts))
    for entity in some(np.array(made), round(total * GONE)) if gaps else ():
        esper.delete_entity(int(entity), immediate=True)

    x, y, z = GRAVITY

    def fall(_: object) -> None:
        for _, (position, velocity) in esper.get_components(Position, Velocity):
            velocity.x += x * DT
            velocity.y += y * DT
            velocity.z += z * DT
            position.x += velocity.x * DT
            position.y += velocity.y * DT
            position.z += velocity.z * DT

    esper.add_processor(type("Fall", (esper.Processor,), {"process": fall})())
    return lambda: esper.process()
