"""Broad phase: whom single rows meet, looked up in the grid, the tree and among those in neither."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.broad_cache import HALF_SPACE, meets_half_space
from carom.systems.kernels.grid import AGAINST_ALL, IN_GRID, IN_TREE, cell_along
from carom.systems.kernels.kernel import kernel


@kernel("found", makes_arrays=True)
def look_up(
    asking, rows, apart, place, shape, size, body_row, pose_position, pose_rotation, fat_lower, fat_upper,
    comes, cell, grid_rows, grid_cells, members, bounds, span, skip, moves, found,
):  # fmt: skip
    """Write a candidate for all whose fat bounds overlap those of the rows ``asking``.

    Half spaces come as far as told (m). ``apart`` are the rows in neither grid nor tree, which are tested one by
    one. Two that both ask are written once. Returns the count of candidates, or -1 where they do not fit in.
    """
    near, asks = np.empty(len(rows) + 1, np.int64), np.zeros(len(place), np.bool_)
    for i in asking:
        asks[i] = True
    count = 0
    for i in asking:
        nearby = 0
        lx, ly, lz = fat_lower[i, 0], fat_lower[i, 1], fat_lower[i, 2]
        ux, uy, uz = fat_upper[i, 0], fat_upper[i, 1], fat_upper[i, 2]
        flat = shape[i] == HALF_SPACE
        if place[i] == AGAINST_ALL:
            for j in rows:
                near[nearby] = j
                nearby += 1
        else:
            for j in apart:
                near[nearby] = j
                nearby += 1
            if len(grid_rows) > 0:
                # Members are where their lower corner is, so also one cell below the bounds asked for.
                x0, x1 = max(cell_along(lx, 0, cell) - 1, 0), cell_along(ux, 0, cell)
                y0, y1 = max(cell_along(ly, 1, cell) - 1, 0), cell_along(uy, 1, cell)
                z0, z1 = max(cell_along(lz, 2, cell) - 1, 0), cell_along(uz, 2, cell)
                outside = x1 < 1 or y1 < 1 or z1 < 1
                outside |= x0 > cell[2, 0] - 3.0 or y0 > cell[2, 1] - 3.0 or z0 > cell[2, 2] - 3.0
                if outside:
                    x1 = x0 - 1
                whole = (x1 - x0 + 1.0) * (y1 - y0 + 1.0) > len(grid_rows)
                if whole:  # fewer members than rows of cells
                    x1, y1 = x0, y0
                for x in range(x0, x1 + 1):
                    for y in range(y0, y1 + 1):
                        start = (x * int(cell[2, 1]) + y) * int(cell[2, 2])
                        t, last = 0, grid_cells[len(grid_cells) - 1]
                        if not whole:
                            last = start + z1
                            end = len(grid_rows)
                            while t < end:
                                middle = (t + end) >> 1
                                if grid_cells[middle] < start + z0:
                                    t = middle + 1
                                else:
                                    end = middle
                        while t < len(grid_rows) and grid_cells[t] <= last:
                            near[nearby] = grid_rows[t]
                            nearby += 1 if place[grid_rows[t]] == IN_GRID else 0
                            t += 1
            node = 0
            while node < len(skip):
                if (
                    lx <= bounds[node, 3] and bounds[node, 0] <= ux and ly <= bounds[node, 4] and bounds[node, 1] <= uy
                    and lz <= bounds[node, 5] and bounds[node, 2] <= uz and (moves[node] or body_row[i] >= 0)
                ):  # fmt: skip
                    if skip[node] == node + 1:
                        for m in range(span[node, 0], span[node, 1]):
                            if place[members[m]] == IN_TREE:
                                near[nearby] = members[m]
                                nearby += 1
                    node += 1
                else:
                    node = skip[node]
        if count + nearby > len(found):
            return -1
        for k in range(nearby):
            j = near[k]
            if j == i or (asks[j] and j < i):
                continue
            if flat or shape[j] == HALF_SPACE:
                plane, box = (i, j) if flat else (j, i)
                meets = meets_half_space(plane, box, size, pose_position, pose_rotation, fat_lower, fat_upper, comes)
            else:
                meets = (
                    lx <= fat_upper[j, 0] and fat_lower[j, 0] <= ux and ly <= fat_upper[j, 1]
                    and fat_lower[j, 1] <= uy and lz <= fat_upper[j, 2] and fat_lower[j, 2] <= uz
                )  # fmt: skip
            if meets:
                found[count, 0], found[count, 1] = i, j
                count += 1
    return count
