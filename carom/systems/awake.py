"""Awake: which bodies the step moves, and whether there is anything to do at all."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, World
from carom.ecs.column import Integers
from carom.ecs.component import Component, Record, Resource
from carom.ecs.components.path import Path
from carom.ecs.writes import Written
from carom.systems.forces.law import Forces
from carom.systems.settings import Settings


class Awake(Resource):
    """The rows of bodies that do not sleep, kinematic ones among them, and of those that do; a cache.

    ``idle`` is a step in which nobody moves and nothing has changed since the one before. ``strangers`` tells of
    systems in the schedule that are not carom's, which may change anything; ``edited`` is what code outside had opened
    for writing when this step began, ``written`` what it wrote, where the world keeps a log of that.
    """

    def __init__(self) -> None:
        self.rows: Integers = np.zeros(0, np.int64)
        self.sleepers = self.bodies = self.rows
        self.idle = self.strangers = False
        self.edited: set[type[Record]] = set()
        self.written: dict[type[Component], Written] = {}
        self.settings: Settings | None = None
        self.restored = self.structure = self.laws = self.found = -1

    def find(self, world: World) -> None:
        """Find who is awake and who sleeps."""
        if self.found != world.structure:
            self.bodies = np.nonzero(world.table(RigidBody).present[: world.used()])[0]
            self.found = world.structure
        asleep = world.table(Motion).arrays["asleep"][self.bodies]
        if asleep.any():
            self.rows, self.sleepers = self.bodies[~asleep], self.bodies[asleep]
        else:
            self.rows, self.sleepers = self.bodies.copy(), self.bodies[:0]

    def now(self, world: World) -> Integers:
        """Return the rows of bodies that do not sleep, also before the first step and right after commands."""
        if self.found != world.structure:
            self.find(world)
        return self.rows

    def nobody_moves(self, world: World) -> bool:
        """Tell whether all who are awake stand still for as long as nobody touches them."""
        if self.strangers or len(world.row_numbers(Path)):
            return False
        motion, rows, inverse_mass = world[Motion], self.rows, world[RigidBody].inverse_mass
        if len(rows) and inverse_mass.item(rows.item(0)):  # most often the first can be moved
            return False
        return not any(values[rows].any() for values in (inverse_mass, motion.linear, motion.angular))

    def look(self, world: World) -> Changes:
        """Return what has changed since the last look."""
        self.edited, world.edited = world.edited, set()
        self.written = {} if world.writes is None else world.writes.take(world)
        settings, laws = world[Settings], world[Forces].count
        changes = Changes(
            self.edited,
            restored=self.restored != world.restored,
            structure=self.structure != world.structure,
            settings=self.settings is not settings or self.laws != laws,
        )
        self.settings, self.laws, self.restored, self.structure = settings, laws, world.restored, world.structure
        return changes


class Changes:
    """What code outside the step has done: kinds opened for writing, a snapshot restored, who is there, settings."""

    def __init__(self, edited: set[type[Record]], *, restored: bool, structure: bool, settings: bool) -> None:
        self.edited, self.restored, self.structure, self.settings = edited, restored, structure, settings

    def __bool__(self) -> bool:
        return bool(self.edited) or self.restored or self.structure or self.settings


def ask_to_wake(motion: Motion, rows: Integers) -> None:
    """Ask for those of some bodies (rows) that sleep to be woken before the next step; `Motion.still` says so."""
    motion.still[rows[motion.asleep[rows]]] = -1.0


def stirs(world: World) -> bool:
    """Tell whether there is anything to do in this step."""
    return not world[Awake].idle
