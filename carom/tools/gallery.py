"""Gallery: worlds of the library as one page, each with its film, its lesson and what it expects."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory

from carom.systems.simulation import Simulation
from carom.tools.film import Film, Picture
from carom.tools.filming import Photographing, Shot, shot_of
from carom.tools.session import Summary, run
from carom.worlds.builder import LoadedWorld
from carom.worlds.expectation import Outcome
from carom.worlds.library import lesson

WIDTH = 320  # of the films, px
RATE, MOST = 12.0, 64  # pictures a second, and how many a film has at most


@dataclass(frozen=True)
class Card:
    """What the page shows of a world: the moments of its film as WebP, its text, and what became of its run."""

    name: str
    group: str
    film: bytes
    loaded: LoadedWorld
    summary: Summary

    @property
    def outcomes(self) -> list[Outcome]:
        """Return what became of each expectation."""
        return [item.outcome() for item in self.loaded.expectations]


class Glimpse(Photographing):
    """Films a run of unknown length in few pictures: once they are too many every other one goes.

    From then on the interval is twice as long, so that the film shows the whole run, the faster the longer that takes.
    """

    def __init__(self, shot: Shot, path: Path) -> None:
        super().__init__(shot, self._moments())
        self._path, self._pictures, self._interval = path, list[Picture](), 1.0 / RATE

    def _moments(self) -> Iterator[float]:
        number = 0
        while True:
            yield number * self._interval
            number = len(self._pictures)

    def take(self, picture: Picture) -> None:
        """Keep the picture."""
        self._pictures.append(picture)
        if len(self._pictures) == MOST:
            self._pictures, self._interval = self._pictures[::2], 2.0 * self._interval

    def end(self, simulation: Simulation) -> None:
        """Write the film."""
        super().end(simulation)
        with Film(self._path, self._shot.width, self._shot.height, RATE) as film:
            for picture in self._pictures:
                film.add(picture)
