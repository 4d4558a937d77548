"""Observing: what is told of many bodies and contacts after a step; the step itself never calls this."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.ecs.entity import INDEX_BITS, INDEX_MASK
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, product, turn


@kernel("energies")
def find_kinetic_energies(rows, mass, inertia, principal, rotation, linear, angular, energies):
    """Write the energy of motion and rotation (n,) of bodies ``rows`` (n,)."""
    for m in range(len(rows)):
        energies[m] = kinetic_energy(rows[m], mass, inertia, principal, rotation, linear, angular)


@inlined
def kinetic_energy(i, mass, inertia, principal, rotation, linear, angular):
    """Return the energy of motion and rotation of body i."""
    x, y, z = angular[i, 0], angular[i, 1], angular[i, 2]
    if inertia[i, 0] != inertia[i, 1] or inertia[i, 1] != inertia[i, 2]:  # else it is the same about all axes
        qx, qy, qz, qw = product(
            rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
            principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3],
        )  # fmt: skip
        x, y, z = turn(-qx, -qy, -qz, qw, x, y, z)
    moving = linear[i, 0] * linear[i, 0] + linear[i, 1] * linear[i, 1] + linear[i, 2] * linear[i, 2]
    turning = inertia[i, 0] * x * x + inertia[i, 1] * y * y + inertia[i, 2] * z * z
    return 0.5 * (mass[i] * moving + turning)


@kernel("sums")
def sum_energies(
    rows, inverse_mass, mass, inertia, principal, scale, center_of_mass, position, rotation, linear, angular, gravity,
    sums,
):  # fmt: skip
    """Write the kinetic energy and the weights of all bodies ``rows`` (n,) that can be pushed, as two sums."""
    moving, held, gx, gy, gz = 0.0, 0.0, gravity[0], gravity[1], gravity[2]
    for i in rows.view(np.uint64):  # without sign: none counts from the end
        if inverse_mass[i] > 0.0:
            moving += kinetic_energy(i, mass, inertia, principal, rotation, linear, angular)
            x, y, z = centre(i, position, rotation, center_of_mass)
            held -= mass[i] * scale[i] * (x * gx + y * gy + z * gz)
    sums[0], sums[1] = moving, held


@kernel("energies")
def find_weights(rows, mass, scale, center_of_mass, position, rotation, gravity, energies):
    """Write -s m g.x (n,) of the centres of mass of bodies ``rows`` (n,), s the ``scale`` of gravity (3,) on each."""
    for m in range(len(rows)):
        i = rows[m]
        x, y, z = centre(i, position, rotation, center_of_mass)
        energies[m] = -mass[i] * scale[i] * (x * gravity[0] + y * gravity[1] + z * gravity[2])


@inlined
def centre(i, position, rotation, center_of_mass):
    """Return the centre of mass of body i, world frame."""
    x, y, z = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
    if x != 0.0 or y != 0.0 or z != 0.0:
        x, y, z = turn(rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], x, y, z)
    return position[i, 0] + x, position[i, 1] + y, position[i, 2] + z


@kernel("one", "other", "depths", "impulses", "points", "normals", "speeds")
def note_contacts(
    count, a, b, depth, impulse, point, normal, alive, generations, row_shift, owner,
    position, rotation, center_of_mass, linear, angular, one, other, depths, impulses, points, normals, speeds,
):  # fmt: skip
    """Write what there is of those of ``count`` contacts that touch; return how many they are.

    Colliders, handles, go to ``one`` and ``other`` (n,), what is known of points to the columns of that name, points,
    normals and speeds in float32; speeds are how fast both sides close there. ``owner`` is the row of the body that
    each row belongs to, -1 for none; who is gone does not move.
    """
    found = 0
    for k in range(count):
        if not (depth[k] >= 0.0 or impulse[k] > 0.0):
            continue
        one[found], other[found], depths[found], impulses[found] = a[k], b[k], depth[k], impulse[k]
        px, py, pz = point[k, 0], point[k, 1], point[k, 2]
        for c in range(3):
            points[found, c], normals[found, c] = point[k, c], normal[k, c]
        speed, sign = 0.0, 1.0
        for handle in (a[k], b[k]):
            index = handle & INDEX_MASK
            row = index + row_shift[index]
            i = owner[row] if alive[row] and generations[index] == handle >> INDEX_BITS else -1
            if i >= 0:
                cx, cy, cz = centre(i, position, rotation, center_of_mass)
                x, y, z = cross(angular[i, 0], angular[i, 1], angular[i, 2], px - cx, py - cy, pz - cz)
                x, y, z = x + linear[i, 0], y + linear[i, 1], z + linear[i, 2]
                speed += sign * (x * normal[k, 0] + y * normal[k, 1] + z * normal[k, 2])
            sign = -1.0
        speeds[found] = speed
        found += 1
    return found


@kernel("places", "turns", "moved")
def note_poses(rows, position, rotation, starts, seen_places, seen_turns, places, turns, moved):
    """Write poses (n, 3), (n, 4) in float32, and which groups, from each of ``starts`` on, differ from those seen."""
    for g in range(len(starts)):
        last = starts[g + 1] if g + 1 < len(starts) else len(rows)
        differs = False
        for m in range(starts[g], last):
            i = rows[m]
            for k in range(3):
                places[m, k] = position[i, k]
                differs |= places[m, k] != seen_places[m, k]
            for k in range(4):
                turns[m, k] = rotation[i, k]
                differs |= turns[m, k] != seen_turns[m, k]
        moved[g] = differs


def compile_observing() -> None:
    """Look at nothing, for `carom warm`."""
    numbers, vectors, turns = np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 4))
    ids = np.zeros(0, np.int32)
    places, orientations = vectors.astype(np.float32), turns.astype(np.float32)
    bodies = vectors, turns, vectors, vectors, vectors
    one, sums = np.zeros(0), np.zeros(2)
    contacts = 0, numbers, numbers, one, one, vectors, vectors, np.zeros(0, np.bool_), ids, ids, numbers
    note_contacts(*contacts, *bodies, numbers, numbers, one, one, places, places, one.astype(np.float32))
    sum_energies(numbers, one, one, vectors, turns, one, vectors, vectors, turns, vectors, vectors, np.zeros(3), sums)
    note_poses(numbers, vectors, turns, numbers, places, orientations, places, orientations, np.zeros(0, np.bool_))
