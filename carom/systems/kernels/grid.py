"""The grid: bodies of about one size by the cell of their lower corner, in order of cells.

Cells are as large as the largest of these bounds along each axis, so that two that overlap are in the same or in
neighbouring cells. There is no table of cells: members are sorted by the number of their cell, and who looks for
neighbours walks along in the same order. So a body far out costs no more than another.
"""

from __future__ import annotations

from math import floor

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel

DIGIT = 11  # bits sorted at once
IN_GRID, IN_TREE, AGAINST_ALL, ASTRAY = 1, 2, 3, 4  # places of rows; whoever is astray left grid or tree


@inlined
def cell_along(x, k, cell):
    """Return the cell of a coordinate along axis k, from 0 to one less than their count; ends are empty."""
    at = floor((x - cell[0, k]) / cell[1, k]) + 1.0
    return int(min(max(at, 0.0), cell[2, k] - 1.0))


@kernel("place", "apart")
def lead_astray(rows, place, apart, count):
    """Write those of ``rows`` that are not astray yet behind the ``count`` that are ``apart``; return the new count."""
    for i in rows:
        if place[i] != ASTRAY:
            place[i], apart[count] = ASTRAY, i
            count += 1
    return count


@kernel("grid_rows", "grid_cells", "boxes", makes_arrays=True)
def sort_into_cells(cell, fat_lower, fat_upper, grid_rows, grid_cells, boxes):
    """Bring the grid's members, given in order of rows, into that of cells; write their cells and bounds."""
    n = len(grid_rows)
    other_rows, other_cells = np.empty(n, np.int64), np.empty(n, np.int64)
    highest = 0
    for s in range(n):
        i, number = grid_rows[s], 0
        for k in range(3):
            number = number * int(cell[2, k]) + cell_along(fat_lower[i, k], k, cell)
        grid_cells[s] = number
        highest = max(highest, number)
    shift = 0
    start = np.empty((1 << DIGIT) + 1, np.int64)
    while highest >> shift > 0:
        for digit in range(len(start)):
            start[digit] = 0
        for s in range(n):
            start[((grid_cells[s] >> shift) & ((1 << DIGIT) - 1)) + 1] += 1
        for digit in range(len(start) - 1):
            start[digit + 1] += start[digit]
        for s in range(n):
            digit = (grid_cells[s] >> shift) & ((1 << DIGIT) - 1)
            other_rows[start[digit]], other_cells[start[digit]] = grid_rows[s], grid_cells[s]
            start[digit] += 1
        for s in range(n):
            grid_rows[s], grid_cells[s] = other_rows[s], other_cells[s]
        shift += DIGIT
    for s in range(n):
        for k in range(3):
            boxes[s, k], boxes[s, 3 + k] = fat_lower[grid_rows[s], k], fat_upper[grid_rows[s], k]


@kernel("found", makes_arrays=True)
def pairs_in_cells(grid_rows, grid_cells, boxes, cell, found):
    """Write the pairs of grid members whose fat bounds overlap; return their count, or -1 where they do not fit in.

    Each cell looks into half of its neighbours, in five runs of cells along z: itself and the next; and those beside
    it, three cells each. As cells come in order, the ends of every run only move forward.
    """
    n = len(grid_rows)
    across = int(cell[2, 2])
    layer = int(cell[2, 1]) * across
    before, after = np.zeros(5, np.int64), np.zeros(5, np.int64)
    count = 0
    for s in range(n):
        here = grid_cells[s]
        lx, ly, lz, ux, uy, uz = boxes[s, 0], boxes[s, 1], boxes[s, 2], boxes[s, 3], boxes[s, 4], boxes[s, 5]
        for run in range(5):
            first, last = here, here + 1
            if run > 0:
                middle = here + (across if run == 1 else layer + (run - 3) * across)
                first, last = middle - 1, middle + 1
            while before[run] < n and grid_cells[before[run]] < first:
                before[run] += 1
            while after[run] < n and grid_cells[after[run]] <= last:
                after[run] += 1
            start = s + 1 if run == 0 else before[run]
            if count + after[run] - start > len(found):
                return -1
            for t in range(start, after[run]):
                found[count, 0], found[count, 1] = grid_rows[s], grid_rows[t]
                # No branch: which of these bounds overlap is past foreseeing, and a wrong guess costs more.
                meets = (
                    (lx <= boxes[t, 3]) & (boxes[t, 0] <= ux) & (ly <= boxes[t, 4]) & (boxes[t, 1] <= uy)
                    & (lz <= boxes[t, 5]) & (boxes[t, 2] <= uz)
                )  # fmt: skip
                count += 1 if meets else 0
    return count
