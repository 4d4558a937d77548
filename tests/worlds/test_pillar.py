"""The world `pillar`, stroke by stroke: straight flights between flat walls and a disc."""

from __future__ import annotations

import math

import numpy as np

from carom.worlds import load_world
from carom.worlds.units import read_quantity

INSIDE, PILLAR = 0.95, 0.4  # m: walls and pillar for the ball's centre


def strokes(position: np.ndarray, velocity: np.ndarray, until: float) -> list[tuple[float, str, np.ndarray]]:
    """Return time, what was struck and where the centre was, up to a time, and last of all where it is then."""
    told, time = [], 0.0
    while True:
        wall = np.where(velocity > 0.0, INSIDE - position, -INSIDE - position) / velocity
        axis = int(wall.argmin())
        along, square = position @ velocity, velocity @ velocity
        inside = along**2 - square * (position @ position - PILLAR**2)
        disc = (-along - math.sqrt(inside)) / square if along < 0.0 < inside else math.inf
        wait = min(wall[axis], disc)
        if time + wait > until:
            return [*told, (until, "", position + velocity * (until - time))]
        time, position = time + wait, position + velocity * wait
        if disc < wall[axis]:
            normal = position / math.hypot(*position)
            velocity = velocity - 2.0 * (velocity @ normal) * normal
            told.append((time, "pillar", position))
        else:
            velocity = velocity * np.where(np.arange(2) == axis, -1.0, 1.0)
            told.append((time, "wall", position))


def test_the_numbers_of_the_pillar_are_those_of_a_solution_stroke_by_stroke() -> None:
    """Strokes at the pillar, and how far the two are from each other."""
    document = load_world("pillar").document
    one, other = (
        (np.array(body["transform"]["position"][:2]), np.array(body["motion"]["linear"][:2]))
        for body in document["entities"][:2]
    )
    struck = [(time, place) for time, what, place in strokes(*one, 8.0) if what == "pillar"]
    for words in document["expect"]:
        if "when" in words:
            time, place = struck[words["when"]["nth"] - 1]
            np.testing.assert_allclose(words["time"]["is"], time, rtol=0, atol=1e-9)
            np.testing.assert_allclose(words["point"]["is"][:2], place * 0.35 / PILLAR, rtol=0, atol=1e-7)
        elif "at" in words:
            moment = read_quantity(words["at"], "s")
            apart = math.dist(strokes(*one, moment)[-1][2], strokes(*other, moment)[-1][2])
            stated = read_quantity(words["distance(one, other)"]["is"], "m")
            np.testing.assert_allclose(stated, apart, rtol=1e-6)
