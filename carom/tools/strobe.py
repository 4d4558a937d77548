"""Strobe: one picture of a whole motion, the moving bodies at moment after moment, as in a book on physics."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Floats
from carom.systems.compound import bodies_of
from carom.systems.simulation import Simulation
from carom.tools.batch import Batch
from carom.tools.film import save_png
from carom.tools.filming import Shot
from carom.tools.moments import Moments
from carom.tools.painter import STIRRED, Painter

PER_INSTANCE = "poses", "colors", "ids"
PALE, FADED = np.array((0.93, 0.94, 0.95)), 0.65  # the colour that the earliest instance is mixed with, and how far


class Strobe:
    """Photographs a simulation at the last of ``times`` (s, in order), with what moves also where it was at the others.

    Earlier instances are paler. All are drawn at once, so that what is nearer hides what is farther, whichever was
    first. ``entities`` are the bodies that are shown more than once: by default all that move.
    """

    def __init__(self, shot: Shot, path: Path, times: Iterable[float], entities: Sequence[int] | None = None) -> None:
        self._shot, self._path, self._entities = shot, path, entities
        self._moments = Moments(times)
        self._instants: list[list[Batch]] = []

    def begin(self, simulation: Simulation) -> None:
        """See the start."""
        self._shot = self._shot.steady(simulation.world)
        self._painter = Painter(simulation, self._shot.look)
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep where everything is when its time has come."""
        self._painter.watch()
        self._instants += [self._painter.batches(poses) for _, poses in self._moments.due(simulation)]

    def end(self, simulation: Simulation) -> None:
        """Draw the picture."""
        from carom.tools.renderer import Renderer

        if not self._instants:
            return
        shown = chosen(simulation.world, self._entities)
        camera, stirred = self._shot.camera(simulation.world), np.full((4, 4), STIRRED)
        stirred[:3, 3] *= camera.distance
        with Renderer(self._shot.width, self._shot.height) as renderer:
            batches = overlaid(self._instants, shown, stirred)
            save_png(self._path, self._painter.picture(renderer, camera, batches=batches))


def chosen(world: World, entities: Sequence[int] | None) -> Booleans:
    """Return for each row whether it belongs to one of ``entities``; None: all do."""
    if entities is None:
        return np.ones(world.used(), np.bool_)
    rows = np.array([world.row(entity) for entity in entities], np.int64)
    return np.isin(np.arange(world.used()), rows) | np.isin(bodies_of(world), rows)


def overlaid(instants: Sequence[list[Batch]], shown: Booleans, stirred: Floats) -> list[Batch]:
    """Return the last of ``instants``, and of those before what is ``shown`` (by id) and elsewhere than later.

    Elsewhere is where an entry of its pose is off by more than ``stirred`` (4, 4). Copies of a mesh are one batch.
    """
    later = np.full((len(shown), 4, 4), np.nan)
    found: list[Batch] = []
    for age, batches in enumerate(reversed(instants)):
        fade = FADED * age / max(len(instants) - 1, 1)
        now = later.copy()  # of one id there may be several batches
        for batch in batches:
            away = ~(np.abs(batch.poses - later[batch.ids]) <= stirred).all(axis=(1, 2))
            keep = np.nonzero(away & (shown[batch.ids] | (age == 0)))[0]
            now[batch.ids[keep]] = batch.poses[keep]
            if len(keep):
                found.append(paler(batch.take(keep), fade))
        later = now
    return merged(found)


def paler(batch: Batch, fade: float) -> Batch:
    """Return a batch in paler colours."""
    colors = batch.colors.copy()
    colors[:, :3] += fade * (PALE - colors[:, :3])
    return replace(batch, colors=colors)


def merged(batches: Sequence[Batch]) -> list[Batch]:
    """Return batches of one mesh as one, in order of their first."""
    groups: dict[tuple[int, int], list[Batch]] = {}
    for batch in batches:
        groups.setdefault((id(batch.vertices), id(batch.faces)), []).append(batch)
    found = []
    for group in groups.values():
        poses, colors, ids = (np.concatenate([getattr(one, name) for one in group]) for name in PER_INSTANCE)
        found.append(replace(group[0], poses=poses, colors=colors, ids=ids))
    return found
