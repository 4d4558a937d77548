"""Glimpse: a short film of a whole run, however long that takes."""

from __future__ import annotations

from pathlib import Path

from carom.systems.simulation import Simulation
from carom.tools.film import Film, Picture
from carom.tools.filming import Shot
from carom.tools.painter import Painter
from carom.tools.renderer import Renderer

RATE = 12.0  # pictures a second
FEWEST, MOST = 24, 64  # pictures: short runs are shown slower than they are, long ones faster


class Glimpse:
    """Films a run of at most ``frames`` steps in few pictures; when they are too many, every other one goes.

    From then on only half as many are taken, so a run that ends before its time is shown to its end as well. ``speed``
    is how much faster than the simulation the film has come to be.
    """

    def __init__(self, shot: Shot, path: Path, frames: int) -> None:
        self._shot, self._path, self._frames = shot, path, frames
        self._pictures: list[Picture] = []
        self.speed = 0.0

    def begin(self, simulation: Simulation) -> None:
        """See the start."""
        self._shot = self._shot.steady(simulation.world)
        evenly = min(1.0 / (RATE * simulation.settings.dt), self._frames / FEWEST)
        self._stride = max(1, round(evenly))
        self._renderer = Renderer(self._shot.width, self._shot.height)
        self._painter = Painter(simulation, self._shot.look)
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Take a picture of every so many steps."""
        self._painter.watch()
        if simulation.frame % self._stride:
            return
        camera = self._shot.camera(simulation.world)
        self._pictures.append(self._painter.picture(self._renderer, camera))
        if len(self._pictures) == MOST:
            self._pictures, self._stride = self._pictures[::2], 2 * self._stride

    def end(self, simulation: Simulation) -> None:
        """Write the film."""
        self._renderer.close()
        rate = RATE * min(1.0, len(self._pictures) / FEWEST)
        self.speed = self._stride * simulation.settings.dt * rate
        with Film(self._path, self._shot.width, self._shot.height, rate) as film:
            for picture in self._pictures:
                film.add(picture)
