"""Index: the grid and the tree in which the broad phase looks up neighbours."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.slots import as_rows
from carom.systems.constants import CELL_SLACK, MOST_CELLS_ALONG, SIZE_CLASS
from carom.systems.kernels.broad_lookup import look_up
from carom.systems.kernels.broad_pairs import order_pairs
from carom.systems.kernels.grid import AGAINST_ALL, IN_GRID, IN_TREE, lead_astray, pairs_in_cells, sort_into_cells
from carom.systems.kernels.kernel import Kernel
from carom.systems.kernels.tree import grow_tree
from carom.systems.shapes.plane import Plane

ROOM_PER_ROW = 16  # candidates there is room for at first; what is not written costs address space only
QUARTER = 50  # bits of a float64 behind those that tell quarters of an octave
EACH = np.ones(SIZE_CLASS, np.int64)
VOLUMES = 2.0 ** (-0.75 * np.arange(SIZE_CLASS))  # of members from the largest down, as part of the largest's
NEAR_CELLS = 13.5  # that a member of the grid is tested against: half of all 27
TREE_TESTS = 100.0  # what a look-up in the tree costs, in tests of two bounds
CELLS_AROUND = 2.0**19  # the middle body, in which bodies stay in the grid where others are too far out
MOST_CELLS = 2.0**62  # whose numbers fit into 64 bits


class Index:
    """Who is where: moving bodies of one size in a grid, others in a tree, endless bounds and strays in neither.

    ``fat_lower`` and ``fat_upper`` (m) are the bounds by which rows are placed and found, ``known`` is what else says
    whose pairs they may be: row of the body, layer, mask, and flags.
    """

    def __init__(
        self, world: World, rows: Integers, fat_lower: Floats, fat_upper: Floats, known: Integers, comes: float
    ) -> None:
        self.rows, self.fat_lower, self.fat_upper, self.known, self.comes = rows, fat_lower, fat_upper, known, comes
        self.place = np.zeros(len(known), np.int64)
        self.cell = np.zeros((3, 3))  # origin, edges and counts along the axes
        moves, ends, size = self._sizes(world)
        in_grid = self._lay_out_cells(self._most_alike(moves & ends, size))
        in_tree = ends & ~in_grid
        self.place[rows] = np.where(in_grid, IN_GRID, np.where(ends, IN_TREE, AGAINST_ALL))
        against_all = rows[~ends]
        self._apart, self._fixed = np.concatenate((against_all, rows)), len(against_all)  # with room for all as strays
        self._count = self._fixed
        self.outside_grid = rows[~in_grid]
        self._fill_grid(rows[in_grid])
        self._grow_tree(world, rows[in_tree], size[in_tree] // SIZE_CLASS)
        self._room = ROOM_PER_ROW * len(rows)

    def _sizes(self, world: World) -> tuple[Booleans, Booleans, Integers]:
        """Return which rows move, which have bounds that end, and sizes in quarter octaves."""
        rows = as_rows(self.rows)
        with np.errstate(invalid="ignore", over="ignore"):
            x, y, z = (self.fat_upper[rows] - self.fat_lower[rows]).T
        longest = np.maximum(np.maximum(x, y), z)
        ends = np.isfinite(longest) & (world[Collider].shape[rows] != Plane.number)
        return self.known[rows, 0] >= 0, ends, longest.view(np.int64) >> QUARTER

    def _most_alike(self, which: Booleans, size: Integers) -> Booleans:
        """Return those within a factor of four in size for which a grid pays most, as a mask.

        Cells must be as large as their largest member, and are crowded where most are smaller.
        """
        if not which.any():
            return which
        least = int(size[which].min())
        counts = np.bincount(size[which] - least)
        inside, filled = (np.convolve(counts, of)[: len(counts)] for of in (EACH, VOLUMES))  # by their largest size
        crowd = inside / np.maximum(filled, VOLUMES[-1])  # in a cell, of members packed densely
        cost = NEAR_CELLS * crowd * inside + TREE_TESTS * (counts.sum() - inside)
        largest = least + int(np.argmin(cost))
        return which & (size <= largest) & (size > largest - SIZE_CLASS)

    def _lay_out_cells(self, which: Booleans) -> Booleans:
        """Lay out the cells for these rows and return which of them are in.

        That is all of them, but where some are so far out that the cells between could not be numbered.
        """
        while which.any():
            lower, upper = self.fat_lower[self.rows[which]].T.copy(), self.fat_upper[self.rows[which]].T.copy()
            origin = lower.min(axis=1)
            edge = (upper - lower).max(axis=1) * (1.0 + CELL_SLACK)
            with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
                along = (lower.max(axis=1) - origin) / edge
            count = np.floor(along) + 4.0  # empty ones at both ends, so that no neighbours wrap round
            if (along < MOST_CELLS_ALONG).all() and count.prod() < MOST_CELLS:
                self.cell[:] = origin, edge, count
                break
            middle = np.sort(lower, axis=1)[:, lower.shape[1] // 2]
            which = which.copy()
            which[which] = (np.abs(lower.T - middle) < CELLS_AROUND * edge).all(axis=1)
        return which

    def _fill_grid(self, rows: Integers) -> None:
        self.grid_rows, self.grid_cells, self.boxes = rows, np.empty(len(rows), np.int64), np.empty((len(rows), 6))
        sort_into_cells(self.cell, self.fat_lower, self.fat_upper, self.grid_rows, self.grid_cells, self.boxes)

    def _grow_tree(self, world: World, rows: Integers, size: Integers) -> None:
        order = np.argsort(size, kind="stable")
        self.members = rows[order]
        most = 2 * len(rows)
        bounds, span = np.empty((most, 6)), np.empty((most, 2), np.int64)
        skip, moves = np.empty(most, np.int64), np.empty(most, np.bool_)
        count = grow_tree(
            size[order], world[ColliderPose].body_row, self.fat_lower, self.fat_upper,
            self.members, bounds, span, skip, moves,
        )  # fmt: skip
        self.nodes = bounds[:count], span[:count], skip[:count], moves[:count]

    def all_pairs(self, world: World) -> Integers:
        """Return all pairs (n, 2), sorted, whose fat bounds overlap."""
        alike = self._filled(pairs_in_cells, self.grid_rows, self.grid_cells, self.boxes, self.cell)
        if len(self.outside_grid):
            alike = np.concatenate((alike, self._looked_up(world, self.outside_grid)))
        return self._ordered(alike)

    def pairs_of(self, world: World, rows: Integers) -> Integers:
        """Return the pairs (n, 2), sorted, that some rows are in."""
        return self._ordered(self._looked_up(world, rows))

    @property
    def strays(self) -> Integers:
        """The rows that have left grid and tree."""
        return self._apart[self._fixed : self._count]

    def lead_astray(self, rows: Integers) -> None:
        """Take rows out of grid and tree: from now on they are tested one by one."""
        self._count = lead_astray(rows, self.place, self._apart, self._count)

    def _looked_up(self, world: World, asking: Integers) -> Integers:
        collider, pose = world[Collider], world[ColliderPose]
        return self._filled(
            look_up, asking, self.rows, self._apart[: self._count], self.place, collider.shape, collider.size,
            pose.body_row, pose.position, pose.rotation, self.fat_lower, self.fat_upper, self.comes,
            self.cell, self.grid_rows, self.grid_cells, self.members, *self.nodes,
        )  # fmt: skip

    def _filled(self, fill: Kernel, *arguments: Any) -> Integers:
        """Return what ``fill`` writes and counts, given room enough; it returns -1 as long as there is too little."""
        while True:
            found: Integers = np.empty((self._room, 2), np.int64)
            count = fill(*arguments, found)
            if count >= 0:
                return found[:count]
            self._room *= 2

    def _ordered(self, candidates: Integers) -> Integers:
        scratch, pairs = np.empty_like(candidates), np.empty_like(candidates)
        return pairs[: order_pairs(candidates, len(self.place), self.known, scratch, pairs)]
