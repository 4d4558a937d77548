"""Telling: whether what is known of the contacts of a fast pair still tells where it meets, so that none are sought."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ROLLED_ASIDE, SOON_SPENT, TOLD, TOLD_ALIKE
from carom.systems.kernels.cores import AROUND, CORE, HALF_SPACE, KIND, PLACE, write_place
from carom.systems.kernels.frames import placed, put_both, put_on, turned
from carom.systems.kernels.kernel import making
from carom.systems.kernels.meeting import most_of
from carom.systems.kernels.mesh_tree import FEW, put_triangle, triangles_around
from carom.systems.kernels.nearing import MOST_STEPS
from carom.systems.kernels.parting_cores import part, part_from_half_space
from carom.systems.kernels.polytope import MOST_CORNERS, MOST_FACES
from carom.systems.kernels.smooth import is_round
from carom.systems.kernels.swinging import REACH, TRUSTED
from carom.systems.kernels.told import gap_told


@making
def ask_told(
    span, center, turns, linear, angular, felt, bodies, numbers, cores, roots, local_position, local_rotation,
    bounds, nodes, triangles, room, asked, times, body_a, body_b, normal, spans, around, places, left, tells,
):  # fmt: skip
    """Tell whether the contacts of all pairs whose ``times`` to be looked at have come still tell where they meet.

    That is so where the nearest of them is as far as the two are, and leads as they are parted; and will be, as they
    move now, when they have moved as far as contacts are trusted. Whose do are trusted again (``left``), who soon would
    have to be asked too, and are noted in ``tells``. Of what is round the nearest is put where that touches by now.
    """
    place, position, rotation = np.empty(PLACE), np.empty((2, 3)), np.empty((2, 4))
    name, weight, seen = np.empty(8, np.int64), np.empty(4), np.empty(3 * MOST_STEPS)
    corner, face = np.empty(6 * MOST_CORNERS), np.empty(3 * MOST_FACES, np.int64)
    plane, rim, touched = np.empty(4 * MOST_FACES), np.empty(2 * 3 * MOST_FACES, np.int64), np.empty(FEW, np.uint32)
    for p in range(len(bodies)):
        tells[p], trust, due = False, numbers[p, TRUSTED], times[p] <= 0.0
        if not asked[p] or not (due or left[p] <= SOON_SPENT * trust):
            continue
        i, o, core, true = bodies[p, 0], bodies[p, 1], cores[p], spans[p, 0] < spans[p, 1]
        _, _, _, most, spent = most_of(p, i, o, span, numbers, center, turns, linear, angular, felt)
        spent = spent if roots[p] < 0 else most
        for time in (0.0, trust / spent if trust < spent * span else span):
            if not true:
                continue
            told = 1e300
            for c in range(spans[p, 0], spans[p, 1]):
                gap = gap_told(c, time, body_a, body_b, normal, around, places, center, turns, linear, angular)
                told = min(told, gap)
            put_both(i, o, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
            write_place(position, rotation, 0, 1, place)
            rounds = core[AROUND] + core[CORE + AROUND]
            reach, count = max(told, 0.0) + trust + rounds, 1
            if roots[p] >= 0:
                count, touched = triangles_around(
                    roots[p], bounds, nodes, triangles, position, rotation, center[o, 0] + time * linear[o, 0],
                    center[o, 1] + time * linear[o, 1], center[o, 2] + time * linear[o, 2],
                    numbers[p, REACH + 1] + reach, touched,
                )  # fmt: skip
            gap, nx, ny, nz, px, py, pz = 1e300, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0
            for n in range(count):
                if roots[p] >= 0:
                    put_triangle(touched[n], triangles, room)
                if core[CORE + KIND] == HALF_SPACE:
                    away, mx, my, mz, qx, qy, qz = part_from_half_space(core, place, room)
                else:
                    away, mx, my, mz, qx, qy, qz = part(
                        core, place, room, False, 0.0, 0.0, 0.0, reach, corner, face, plane, rim, name, weight, seen
                    )  # fmt: skip
                if away < gap:
                    gap, nx, ny, nz, px, py, pz = away, mx, my, mz, qx, qy, qz
            nx, ny, nz = turned(rotation, 0, nx, ny, nz)
            nearest, most_alike = -1, TOLD_ALIKE
            for c in range(spans[p, 0], spans[p, 1]):
                alike = (nx * normal[c, 0] + ny * normal[c, 1] + nz * normal[c, 2]) * (1.0 if body_a[c] == i else -1.0)
                away = gap_told(c, time, body_a, body_b, normal, around, places, center, turns, linear, angular)
                if alike >= most_alike and away - told <= TOLD * trust:
                    nearest, most_alike = c, alike
            off = abs(gap - rounds - told)
            true = nearest >= 0 and off <= TOLD * trust
            if true and time == 0.0 and off > ROLLED_ASIDE * trust and is_round(core):
                x, y, z = placed(position, rotation, 0, px, py, pz)
                first = 0 if body_a[nearest] == i else 1
                put_on(nearest, first, i, x, y, z, center, turns, places)
                put_on(nearest, 1 - first, o, x + gap * nx, y + gap * ny, z + gap * nz, center, turns, places)
        if due and not true:
            return False
        if true:
            left[p], tells[p] = trust, True
    return True
