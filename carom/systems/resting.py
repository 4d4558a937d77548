"""Resting: the manifolds of the contact table, and how contacts that rest yield."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.awake import Awake
from carom.systems.constants import BEARING_SWEEPS
from carom.systems.kernels.arcs import bend_arcs
from carom.systems.kernels.ball_touches import write_touches
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.filling import hand_over
from carom.systems.kernels.groups import RUNS
from carom.systems.kernels.lane_widths import BLOCK, PLANES
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.packing import (
    are_placed,
    find_bound,
    pack_bodies,
    pack_moving,
)
from carom.systems.kernels.resting import PAGE_ROWS
from carom.systems.kernels.rows import are_same_rows
from carom.systems.kernels.settling import sink_contacts, tell_depths
from carom.systems.kernels.sorting import sort_groups
from carom.systems.kernels.turns import take_turns
from carom.systems.linkage import Linkage
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.threads import crew_for
from carom.systems.yielding import HARD, Yielding, relax_sweeps, yielding


class Stage(NamedTuple):
    """A stage of solving, so many sweeps over all groups; ``soft`` and ``rigid`` say how contacts yield in it."""

    name: str
    sweeps: int
    h: float
    soft: Yielding
    rigid: Yielding


class Resting(Resource):
    """Runs of contacts on one plane, in groups that are solved side by side, and the bodies they are of.

    ``hearers`` are told of every sweep that has been done, by its stage and number; 0 is before the first.
    """

    def __init__(self) -> None:
        self.hearers: list[Callable[[Stage, int], None]] = []
        self.count = self.groups = self.levels = 0
        self.solids = self.balls = False  # whether some contacts are not of balls on exact arcs, and some of two balls
        self.belts = False  # whether surfaces of colliders run
        self.structure = -1  # that of the world when contacts were detected
        self.awake: Integers | None = None  # who was awake then
        self.bound = np.zeros(0, np.int64)  # the rows of bodies that contacts or joints are of
        self.bound_of: tuple[Integers, Integers] | None = None  # who was awake and joined when they were found
        self.packed: tuple[Integers, Integers] | None = None  # the rows of bodies that are packed, and who was awake
        self.centred = False  # whether all of them have their centres of mass at their origins
        self.placed = False  # whether they have not moved since
        self.start, self.beside = np.zeros(1, np.int64), np.zeros(0, np.int64)
        self.bodies, self.lanes, self.scratch = aligned(PLANES, 1, BLOCK), aligned(0, WIDTH), aligned(0, 2, 0, WIDTH)
        self.stirred = np.empty((2, 1), np.int64)  # the last sweeps by which each body was, and bears what is heavy
        self.crushed = np.zeros(1, np.bool_)  # who is, for whom sweeping on would be in vain
        self.leans = np.zeros((2, 1), np.bool_)  # who rests on something, as balls on exact arcs do in the second row
        self.reserve(0)

    def reserve(self, count: int) -> None:
        """Make room for so many manifolds in so many groups."""
        self.group_of, self.lane_of = np.empty(count, np.int64), np.empty(count, np.int64)
        self.index_a, self.index_b = np.empty((count, WIDTH), np.int64), np.empty((count, WIDTH), np.int64)
        self.first, self.size = np.empty((count, WIDTH), np.int64), np.empty((count, WIDTH), np.int64)
        self.points, self.row, self.closes = (np.empty(count, np.int64) for _ in range(3))
        self.asks, self.run_ends = np.zeros(count, np.int64), np.empty(2 * RUNS * count, np.int64)
        self.even, self.fresh, self.stale, self.looks = (np.ones(count, np.bool_) for _ in range(4))
        self.ends = np.zeros(2, np.int64)

    def knows(self, world: World) -> bool:
        """Tell whether contacts were detected since anything was done from outside and anybody woken or put to sleep.

        Who is awake is found anew after each of these.
        """
        same = self.structure == world.structure and self.awake is world[Awake].now(world)
        return same and not world[Awake].strangers

    def rows(self, world: World) -> Integers:
        """Return the rows of bodies that are awake and have contacts or joints: the only ones that are packed."""
        awake, linkage, of = world[Awake].now(world), world[Linkage], self.bound_of
        if of is None or of[0] is not awake or of[1] is not linkage.index_a:
            found, self.bound_of = np.empty_like(awake), (awake, linkage.index_a)
            count = find_bound(
                awake, self.bodies.shape[1] - 1, self.groups, self.index_a, self.index_b,
                linkage.groups, linkage.index_a, linkage.index_b, found,
            )  # fmt: skip
            if not are_same_rows(found[:count], self.bound):  # else they may be packed already
                self.bound = found[:count]
        return self.bound

    def crushed_among(self, world: World) -> Booleans:
        """Return the column of bodies that are crushed, the last of which is nobody."""
        size = len(world[RigidBody].inverse_mass) + 1
        if len(self.crushed) != size:
            self.crushed = np.zeros(size, np.bool_)
        return self.crushed

    def level_ends(self) -> list[int]:
        """Return where the groups of each level end."""
        ends: list[int] = self.run_ends[RUNS - 1 : self.levels * RUNS : RUNS].tolist()
        return ends

    def pack(self, world: World) -> None:
        """Write what the stage needs to know of bodies, as they are now; of those that have not moved, what moves."""
        flight, motion = world[Flight], world[Motion]
        rows = self.rows(world)
        known = self._knows(world)
        placed = known and self.placed and self.centred  # a centre that is found by its origin is rounded
        if placed or (known and are_placed(rows, flight.center, world[Transform].rotation, self.bodies)):
            if self.groups:  # joints learn of velocities where they are pressed
                pack_moving(rows, motion.linear, motion.angular, flight.felt, self.bodies)
            return
        self._pack_anew(world)

    def _knows(self, world: World) -> bool:
        """Tell whether the same bodies are packed; who is awake is found anew after every change from outside."""
        packed, now = self.packed, world[Awake].now(world)
        return packed is not None and packed[0] is self.rows(world) and packed[1] is now and not world[Awake].strangers

    def _pack_anew(self, world: World) -> None:
        flight, motion, body, rows = world[Flight], world[Motion], world[RigidBody], self.rows(world)
        weigh = bool(self.groups) or not self._knows(world)
        crew = crew_for(world, len(rows))
        apart = np.zeros(threads_of(crew), np.bool_)
        pack_bodies(
            crew, rows, weigh, body.center_of_mass, flight.center, motion.linear, motion.angular, flight.felt,
            body.inverse_mass, body.inverse_inertia, body.principal_axes, body.freedom,
            world[Transform].rotation, self.bodies, apart,
        )  # fmt: skip
        self.centred = not any(apart.tolist())
        self.packed, world[Linkage].measured = (rows, world[Awake].now(world)), False

    def sort(self, world: World, h: float) -> int:
        """Find which manifolds rest, and mark their bodies as touching; return how many do."""
        contact, flight, settings = world[Contact], world[Flight], world[Settings]
        joined = world[Linkage].holds
        crew = crew_for(world, self.count)
        numbers = np.zeros(threads_of(crew), np.int64)
        self.leans.fill(False)
        sort_groups(
            crew, self.groups, h, settings.integrator == "verlet",
            float(settings.response == "full"), joined, self.ends, self.index_a, self.index_b, self.first, self.size,
            self.points, self.row, self.fresh, self.stale, self.looks, self.asks, self.lanes, self.bodies,
            flight.center, world[Transform].rotation,
            contact.kind, contact.ball, contact.other, contact.sign, contact.radius, contact.extent,
            contact.other_position, contact.other_rotation, contact.body_a, contact.body_b, contact.normal,
            contact.depth, contact.point, contact.offset_a, contact.offset_b, contact.resting, contact.strikes,
            self.beside, flight.held, flight.touching, self.leans, numbers,
        )  # fmt: skip
        if self.balls and (joined or world[Progress].left == 0.0):  # at last; where there are joints, at once
            write_touches(
                crew, contact.count, contact.kind, contact.sign, contact.radius, contact.extent,
                contact.body_a, contact.body_b, world[RigidBody].inverse_mass, flight.center,
                contact.normal, contact.depth, contact.point, contact.offset_a, contact.offset_b,
            )  # fmt: skip
        return sum(numbers.tolist())

    def bend(self, world: World, h: float) -> None:
        """Spread what velocities of balls have changed by over the arcs they fly."""
        if not self.leans[1].any():
            return
        motion, flight = world[Motion], world[Flight]
        bend_arcs(
            crew_for(world, self.count), h, self.rows(world), self.leans, self.levels, self.run_ends,
            self.index_a, self.index_b, self.row, self.asks, self.lanes, self.bodies,
            flight.start_linear, flight.start_angular, motion.linear, motion.angular,
            flight.acceleration, flight.angular_acceleration,
        )  # fmt: skip

    def press(self, world: World, h: float) -> None:
        """Apply the impulses of the substep before, then solve every group once with its overlap pushed out."""
        if world[Linkage].groups:
            world[Linkage].measure(world, self.bodies)
        self._solve(world, Stage("solve", 1, h, *yielding(h)))

    def sink(self, world: World) -> None:
        """Find how deep contacts have come to be."""
        self.forget_poses()
        if not self.groups:
            return
        flight, contact, body = world[Flight], world[Contact], world[RigidBody]
        sink_contacts(
            crew_for(world, self.count), self.groups, self.rows(world), flight.start_center, flight.center,
            flight.turned, body.inverse_mass, body.inverse_inertia, body.principal_axes, body.freedom,
            world[Transform].rotation, self.index_a, self.index_b, self.points, self.row, self.fresh, self.bodies,
            self.lanes,
        )  # fmt: skip
        tell_depths(
            crew_for(world, self.count), self.groups, self.first, self.size, self.row, contact.kind, self.lanes,
            contact.depth,
        )  # fmt: skip

    def forget_poses(self) -> None:
        """Bodies have moved since they were packed; where there are contacts, by how much lies in the place of that."""
        self.placed = False
        if self.groups:
            self.packed = None

    def relax(self, world: World, h: float) -> None:
        """Take the speed by which overlap left out of the velocities."""
        linkage = world[Linkage]
        if linkage.groups:
            self._pack_anew(world)  # all of them have moved
            self.placed = True
            linkage.measure(world, self.bodies)
        self._solve(world, Stage("relax", relax_sweeps(world[Settings].substeps), h, HARD, HARD))

    def _solve(self, world: World, stage: Stage) -> None:
        """Do all sweeps of a stage, at once where nobody is to hear of each."""
        if not self.hearers:
            self._take_turns(world, stage, 0, stage.sweeps + BEARING_SWEEPS, begins=True)
            return
        done, follow = self._take_turns(world, stage, 0, 0, begins=True)
        self._tell(stage, done)
        while follow:
            done, follow = self._take_turns(world, stage, done, 1)
            self._tell(stage, done)

    def _take_turns(
        self, world: World, stage: Stage, swept: int, most: int, *, begins: bool = False
    ) -> tuple[int, bool]:
        """Sweep ``most`` times after those ``swept``; return how many are then, and whether others are to follow."""
        crew, motion, linkage = crew_for(world, self.count), world[Motion], world[Linkage]
        relaxing = stage.name == "relax"
        swept, follow = take_turns(
            crew, begins, swept, most, stage.sweeps, relaxing, stage.h, *linkage.asked(stage.h, relaxing),
            self.groups, self.ends, self.levels, self.run_ends, stage.soft, stage.rigid,
            self.index_a, self.index_b, self.points, self.row, self.asks, self.pages_for(crew), self.lanes,
            self.bodies, self.crushed, linkage.joined, self.stirred, self.rows(world), motion.linear, motion.angular,
        )  # fmt: skip
        return swept, follow

    def pages_for(self, crew: Integers) -> Floats:
        """Return room in which each thread of a crew solves the points of a group, and keeps what that had before."""
        if len(self.scratch) < threads_of(crew):
            self.scratch = aligned(threads_of(crew), 2, PAGE_ROWS, WIDTH)
        return self.scratch

    def _tell(self, stage: Stage, done: int) -> None:
        for hear in self.hearers:
            hear(stage, done)

    def hand_over(self, world: World) -> None:
        """Write the impulses of the resting stage into the contact table, those of the step added to what is there."""
        if not self.groups:
            return
        contact = world[Contact]
        hand_over(
            crew_for(world, self.count), self.groups, self.first, self.size, self.row, self.lanes,
            contact.impulse, contact.friction_impulse,
            contact.warm_normal, contact.warm_friction, contact.warm_rolling,
        )  # fmt: skip
