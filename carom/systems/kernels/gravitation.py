"""Gravitation of bodies pair by pair, eight others at a time."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lanes import WIDTH, address, choose, load, root, spread, store

HEAVY, ROWS = 3, 4  # a group of eight bodies is their x, y, z and, after them, masses


@kernel("pull", makes_arrays=True)
def sum_pairs(mass, center, constant, softening, pull):
    """Write the pull G m1 m2 r / (r^2 + s^2)^(3/2) on each body (n, 3), equal and opposite to the last bit.

    Return the potential energy, -G m1 m2 / sqrt(r^2 + s^2) summed over pairs. Pairs of one group are scalars, those of
    two groups lanes.
    """
    count = len(mass)
    groups = (count + WIDTH - 1) // WIDTH
    bodies, pulls, sums = np.zeros((ROWS * groups, WIDTH)), np.zeros((3 * groups, WIDTH)), np.zeros((4, WIDTH))
    for i in range(count):
        g, lane = i // WIDTH, i % WIDTH
        bodies[ROWS * g + HEAVY, lane] = mass[i]
        for k in range(3):
            bodies[ROWS * g + k, lane] = center[i, k]
            pull[i, k] = 0.0
    soft, energy = softening * softening, 0.0
    at, on, into = address(bodies), address(pulls), address(sums)
    for i in range(count):
        last = min(i // WIDTH * WIDTH + WIDTH, count)
        for j in range(i + 1, last):
            dx, dy, dz = center[j, 0] - center[i, 0], center[j, 1] - center[i, 1], center[j, 2] - center[i, 2]
            squared = dx * dx + dy * dy + dz * dz + soft
            if squared > 0.0:
                strength = constant * mass[i] * mass[j] / (squared * sqrt(squared))
                energy -= strength * squared
                for k, d in enumerate((dx, dy, dz)):
                    pull[i, k] += strength * d
                    pull[j, k] -= strength * d
    zero, one = spread(0.0), spread(1.0)
    for i in range(count):
        scaled = constant * mass[i]
        x, y, z = center[i, 0], center[i, 1], center[i, 2]
        ax, ay, az, depth = zero, zero, zero, zero
        for g in range(i // WIDTH + 1, groups):
            p, q = ROWS * g, 3 * g
            dx, dy, dz = load(at, p) - x, load(at, p + 1) - y, load(at, p + 2) - z
            squared = dx * dx + dy * dy + dz * dz + soft
            apart = choose(squared, squared, one)  # at one point there is no direction to be pulled in
            strength = scaled * load(at, p + HEAVY) / (apart * root(apart))
            px, py, pz = strength * dx, strength * dy, strength * dz
            ax, ay, az, depth = ax + px, ay + py, az + pz, depth + strength * squared
            store(on, q, load(on, q) - px)
            store(on, q + 1, load(on, q + 1) - py)
            store(on, q + 2, load(on, q + 2) - pz)
        store(into, 0, ax)
        store(into, 1, ay)
        store(into, 2, az)
        store(into, 3, depth)
        for lane in range(WIDTH):
            energy -= sums[3, lane]
            for k in range(3):
                pull[i, k] += sums[k, lane]
    for i in range(count):
        for k in range(3):
            pull[i, k] += pulls[3 * (i // WIDTH) + k, i % WIDTH]
    return energy
