"""Meetings: when two bodies that move and turn fast come to touch, by conservative advancement.

Planes that part two convex solids say for how long they cannot touch, however they turn: the gap over the greatest
speed at which it may close (Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, section 2.3).
"""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import CAST_GAP, GLIDING, MEET, STEPS_TO_MEET
from carom.systems.kernels.arriving import came_since, is_round, somebody_arrives, sought_to
from carom.systems.kernels.bodies import length_of
from carom.systems.kernels.cores import AROUND, CORE, HALF_SPACE, KIND, PLACE, write_place
from carom.systems.kernels.distance import APART, FAR, MEETING
from carom.systems.kernels.expansion import expand
from carom.systems.kernels.fast_pairs import NEVER, between
from carom.systems.kernels.frames import put, put_both, turned
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.mesh_tree import FEW, put_triangle, triangles_around
from carom.systems.kernels.nearing import MOST_STEPS, near
from carom.systems.kernels.parting_cores import normal_or_centers, part_from_half_space
from carom.systems.kernels.polytope import MOST_CORNERS, MOST_FACES
from carom.systems.kernels.seen import closing_seen, speeds_seen
from carom.systems.kernels.spatial import cross
from carom.systems.kernels.swinging import REACH, TRUSTED, swing_now


@inlined
def across(i, nx, ny, nz, angular):
    """Return how fast the turning of body i may take a point 1 m from its centre along n."""
    if i < 0:
        return 0.0
    x, y, z = cross(nx, ny, nz, angular[i, 0], angular[i, 1], angular[i, 2])
    return sqrt(x * x + y * y + z * z)


@inlined
def most_of(p, i, o, limit, numbers, center, turns, linear, angular, felt):
    """Return by how much forces may hasten pair p within ``limit`` (s), and how fast any two points may close then.

    Before the latter how fast turning moves either; and at last how fast trust in contacts goes, which stay on their
    faces while bodies glide. Those are no more than what either sees of the other.
    """
    pull = (length_of(i, felt) + length_of(o, felt)) * limit
    swing_i = swing_now(p, 0, i, turns, angular, numbers)
    swing_o = swing_now(p, 1, o, turns, angular, numbers)
    gliding = between(i, o, linear, linear) + pull
    most, spent = gliding + swing_i + swing_o, GLIDING * gliding + swing_i + swing_o
    if i >= 0 and o >= 0:
        for side, one, other in ((0, i, o), (1, o, i)):
            seen, of_trust = speeds_seen(
                p, one, other, side, limit, pull, numbers, center, linear, angular, linear, angular
            )
            most, spent = min(most, seen), min(spent, of_trust)
    return pull, swing_i, swing_o, most, spent


@inlined
def time_of_way(way, speed, limit):
    """Return how long a way (m) takes, NEVER if not within ``limit`` seconds."""
    return way / speed if way < limit * speed else NEVER


@inlined
def meet(
    p, i, o, limit, found, ends, numbers, core, vertices, center, turns, linear, angular, felt,
    detected_center, detected_turns, bodies_reach, local_position, local_rotation, position, rotation,
    place, corner, name, weight, seen, corners, face, plane, rim,
):  # fmt: skip
    """Return when the two cores of pair p are to be looked at again (s, NEVER if not within ``limit``).

    That is where they have come so near that their contact is to be found, or, where they are near already and it is
    ``found``, after they may have moved as far as it is trusted, which is returned too (m), else 0: how far they glide
    counts wholly where a face ``ends``. And now, where points arrive that were too far to be found.
    """
    trust, around, time = numbers[p, TRUSTED], core[AROUND] + core[CORE + AROUND], 0.0
    pull, swing_i, swing_o, most, spent = most_of(p, i, o, limit, numbers, center, turns, linear, angular, felt)
    nx, ny, nz = 0.0, 1.0, 0.0
    for _ in range(STEPS_TO_MEET):
        put_both(i, o, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
        write_place(position, rotation, 0, 1, place)
        reach = most * (limit - time) + trust + around
        if core[CORE + KIND] == HALF_SPACE:
            gap, mx, my, mz, _, _, _ = part_from_half_space(core, place, vertices)
            state = FAR if gap > reach else APART
        else:
            state, gap, mx, my, mz, _, _, _ = near(
                core, place, vertices, nx, ny, nz, reach, CAST_GAP, corner, name, weight, seen
            )
        if state == FAR:
            return NEVER, 0.0
        gap = 0.0 if state == MEETING else gap - around
        if found and time == 0.0 and gap <= trust:
            sought = sought_to(p, i, o, numbers, bodies_reach)
            came = came_since(
                p, i, o, numbers, core, center, turns, detected_center, detected_turns, local_position, local_rotation
            )  # fmt: skip
            rolls = came > MEET * trust and (is_round(core, 0) or is_round(core, 1))  # not where they were just found
            if most * limit + came > sought or rolls:
                if state == MEETING:
                    mx, my, mz = normal_or_centers(place, 0.0, 0.0, 0.0)
                    _, mx, my, mz, _, _, _ = expand(core, place, vertices, mx, my, mz, corners, face, plane, rim)
                mx, my, mz = turned(rotation, 0, mx, my, mz)
                if somebody_arrives(
                    p, i, o, limit, mx, my, mz, sought, rolls, core, vertices, center, turns, linear, angular,
                    detected_center, detected_turns, local_position, local_rotation, position, rotation, place,
                ):  # fmt: skip
                    return 0.0, 0.0
            return time_of_way(trust, most if ends else spent, limit), trust
        if gap <= MEET * trust:
            return time, 0.0
        nx, ny, nz = mx, my, mz
        wx, wy, wz = turned(rotation, 0, nx, ny, nz)
        closing = pull + min(across(i, wx, wy, wz, angular) * numbers[p, REACH], swing_i)
        closing += min(across(o, wx, wy, wz, angular) * numbers[p, REACH + 1], swing_o)
        for k, n in enumerate((wx, wy, wz)):
            closing += n * ((linear[i, k] if i >= 0 else 0.0) - (linear[o, k] if o >= 0 else 0.0))
        if i >= 0 and o >= 0:
            for side, one, other, sense in ((0, i, o, 1.0), (1, o, i, -1.0)):
                as_seen = closing_seen(
                    p, one, other, side, limit, pull, sense * wx, sense * wy, sense * wz, numbers, center, linear,
                    angular,
                )  # fmt: skip
                closing = min(closing, as_seen)
        if closing <= 0.0 or gap > closing * (limit - time):
            return NEVER, 0.0
        time += (gap - 0.5 * MEET * trust) / closing
    return time, 0.0


@kernel("room", "near", "left", "times", makes_arrays=True, within=True)
def foresee_meetings(
    span, first_only, found, center, turns, linear, angular, felt,
    detected_center, detected_turns, reach, bodies, numbers, cores, roots, local_position, local_rotation,
    bounds, nodes, triangles, room, asked, near, left, times,
):  # fmt: skip
    """Write when (s) each pair of ``bodies`` that is ``asked`` is to be detected anew as they move now.

    NEVER if not in ``span``, 0 of who is not asked; who has a time above 0 keeps it. Return the first (s). Where
    contacts have been ``found``, who has been ``near`` ever since is trusted for a way that is written into ``left``
    (m), but of meshes, of which some triangles may be near and others not. Else it is for what is left of that. Points
    arrive that were farther apart than contacts were sought, as bodies ``reach``, where they were ``detected``. Where
    only the first counts, later ones are not told. Local poses (n, 2, ...) are of both shapes about the centres of
    their bodies, of what stands in the world. ``room`` are the vertices of all hulls, and three more for a triangle of
    a mesh, which is the first of a pair that has one of ``roots``.
    """
    place = np.empty(PLACE)
    corner, name, weight, seen = np.empty(12), np.empty(8, np.int64), np.empty(4), np.empty(3 * MOST_STEPS)
    corners, face = np.empty(6 * MOST_CORNERS), np.empty(3 * MOST_FACES, np.int64)
    plane, rim = np.empty(4 * MOST_FACES), np.empty(2 * 3 * MOST_FACES, np.int64)
    position, rotation, touched = np.empty((2, 3)), np.empty((2, 4)), np.empty(FEW, np.uint32)
    first, sooner = NEVER, span
    for p in range(len(bodies)):
        if not asked[p]:
            times[p] = 0.0
            continue
        i, o, core = bodies[p, 0], bodies[p, 1], cores[p]
        limit, soonest, known, trusted = sooner if first_only else span, NEVER, found and near[p], 0.0
        if not known and left[p] > 0.0:
            soonest = 0.0
            if left[p] > MEET * numbers[p, TRUSTED]:
                spent = most_of(p, i, o, limit, numbers, center, turns, linear, angular, felt)[4]
                soonest = time_of_way(left[p], spent, limit)
        elif times[p] > 0.0:
            soonest = times[p]
        elif roots[p] < 0:
            soonest, trusted = meet(
                p, i, o, limit, known, False, numbers, core, room, center, turns, linear, angular, felt,
                detected_center, detected_turns, reach, local_position, local_rotation, position, rotation,
                place, corner, name, weight, seen, corners, face, plane, rim,
            )  # fmt: skip
            left[p] = trusted
        else:
            put(0, i, 0.0, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
            wide = numbers[p, REACH + 1] + core[CORE + AROUND] + numbers[p, TRUSTED]  # and turning, but of the mesh
            wide += limit * (between(i, o, linear, linear) + length_of(i, angular) * numbers[p, REACH])
            count, touched = triangles_around(
                roots[p], bounds, nodes, triangles, position, rotation, center[o, 0], center[o, 1], center[o, 2], wide,
                touched,
            )  # fmt: skip
            for c in range(count):
                put_triangle(touched[c], triangles, room)
                time, way = meet(
                    p, i, o, min(limit, soonest), known, True, numbers, core, room, center, turns, linear, angular,
                    felt, detected_center, detected_turns, reach, local_position, local_rotation, position, rotation,
                    place, corner, name, weight, seen, corners, face, plane, rim,
                )  # fmt: skip
                soonest, trusted = min(soonest, time), max(trusted, way)
        near[p] = near[p] and (trusted > 0.0 or not found)
        times[p] = soonest
        first, sooner = min(first, soonest), min(sooner, soonest)
    return first
