"""Gravitation: the pulls of all bodies on all, pair by pair or, of very many, by a tree."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.systems.constants import PAIR_BY_PAIR
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.gravitation import sum_pairs
from carom.systems.kernels.gravitation_tree import NODE, grow_gravity_tree, sum_tree, take_drift
from carom.systems.kernels.lane_widths import WIDTH


def attract(
    mass: Floats, center: Floats, constant: float, softening: float, opening: float, crew: Integers = ALONE
) -> tuple[Floats, float]:
    """Return the pull on each body (n, 3) in N, and the potential energy of all in J.

    Bodies have masses (n,) in kg and centres of mass (n, 3) in m. Above `PAIR_BY_PAIR` it is by a tree.
    """
    if len(mass) > PAIR_BY_PAIR:
        return attract_by_tree(mass, center, constant, softening, opening, crew)
    pull = np.empty((len(mass), 3))
    return pull, sum_pairs(mass, center, constant, softening, pull)


def attract_by_tree(
    mass: Floats, center: Floats, constant: float, softening: float, opening: float, crew: Integers = ALONE
) -> tuple[Floats, float]:
    """Return what `attract` does, by a tree whose leaves a crew shares; no bit depends on how.

    The error grows with ``opening``. It is of single pulls: together they are 0 but for rounding, as in nature.
    """
    leaves = (len(mass) + WIDTH - 1) // WIDTH
    order, pull, energy = np.arange(len(mass)), np.empty((len(mass), 3)), np.empty(len(mass))
    span, nodes = np.empty((2 * leaves - 1, 2), np.int64), np.empty((2 * leaves - 1, NODE))
    grow_gravity_tree(mass, center, order, span, nodes)
    asked = mass, center, constant, softening, opening, order, span, nodes, pull, energy
    sum_tree(crew, *asked)
    take_drift(mass, pull)
    return pull, float(energy.sum())
