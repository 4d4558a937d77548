"""Filming: from where a world is photographed, one picture of it, and the observer that films a run."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from carom.ecs import Transform, World
from carom.ecs.errors import CaromError, did_you_mean
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera, Vector
from carom.tools.film import Film, Picture, save_png
from carom.tools.look import Look, look_of
from carom.tools.moments import Moments, every
from carom.tools.painter import Painter
from carom.tools.recorder.blueprint import default_camera
from carom.tools.rigs import AbsentError, Rig
from carom.worlds.builder import LoadedWorld


@dataclass(frozen=True)
class Overview:
    """A camera that has everything in view, wherever it has come to; ``up`` is that of the world."""

    up: Vector = (0.0, 1.0, 0.0)

    def camera(self, world: World, time: float | None = None, poses: Transform | None = None) -> Camera:
        """Return the camera as the world is now, whatever the time."""
        return default_camera(world, self.up)


@dataclass(frozen=True)
class Shot:
    """From where a world is photographed and how large: pixels across and down, pictures per simulated second."""

    view: Camera | Rig | Overview
    width: int = 640
    height: int = 480
    fps: float = 30.0
    look: Look = field(default_factory=Look)

    def camera(self, world: World, time: float | None = None, poses: Transform | None = None) -> Camera:
        """Return the camera as the world is now; at another time (s), with the poses of all rows then, where stated."""
        return self.view if isinstance(self.view, Camera) else self.view.camera(world, time, poses)

    def steady(self, world: World) -> Shot:
        """Return the shot for a film from now on, in which an overview stays where it is."""
        return replace(self, view=self.view.camera(world)) if isinstance(self.view, Overview) else self


def shot_of(loaded: LoadedWorld, name: str | None = None, look: Look | None = None) -> Shot:
    """Return the shot a world file states, by the camera of that name, and with its look unless another is given.

    Without a name it is the file's render.camera, else ``main``, else its first camera, else an overview.
    Raises CaromError for an unknown name.
    """
    known, render = loaded.cameras, loaded.render
    if name is not None and name not in known:
        parts = f"no camera is named {name!r}", f"accepted: {', '.join(known) or 'none'}", did_you_mean(name, known)
        raise CaromError(f"{loaded.path}: {'; '.join(filter(None, parts))}")
    chosen = name or render.camera or ("main" if "main" in known else next(iter(known), None))
    view = Rig(chosen, known[chosen], loaded.up) if chosen else Overview(loaded.up)
    return Shot(view, render.width, render.height, render.fps, look or look_of(loaded))


def photograph(shot: Shot, simulation: Simulation, path: Path, painter: Painter | None = None) -> None:
    """Write a picture (PNG) of a simulation as it is now, by the painter that watched it where there was one."""
    from carom.tools.renderer import Renderer

    painter = painter or Painter(simulation, shot.look)
    with Renderer(shot.width, shot.height) as renderer:
        save_png(path, painter.picture(renderer, shot.camera(simulation.world)))


class Photographer:
    """Takes a picture of a simulation at each of ``times`` (s, in order); ask `due` at the start and after every step.

    A camera stays where it was once whom it follows is gone. Close it when done, or use it in a ``with`` statement.
    """

    def __init__(self, shot: Shot, simulation: Simulation, times: Iterable[float]) -> None:
        from carom.tools.renderer import Renderer

        self._shot, self._simulation, self.moments = shot.steady(simulation.world), simulation, Moments(times)
        self._renderer, self._painter = Renderer(shot.width, shot.height), Painter(simulation, shot.look)
        self._last: Camera | None = None

    def due(self) -> Iterator[Picture]:
        """Yield the pictures (height, width, 3) whose time has come."""
        self._painter.watch()
        for time, poses in self.moments.due(self._simulation):
            yield self._painter.picture(self._renderer, self._camera(time, poses), poses, time)

    def _camera(self, time: float, poses: Transform) -> Camera:
        """Return the camera at a time, where it was last once whom it follows or looks at is gone."""
        try:
            self._last = self._shot.camera(self._simulation.world, time, poses)
        except AbsentError:
            if self._last is None:
                raise
        return self._last

    def close(self) -> None:
        """Free what it draws with."""
        self._renderer.close()

    def __enter__(self) -> Photographer:
        return self

    def __exit__(self, *fault: object) -> None:
        self.close()


def frames(simulation: Simulation, shot: Shot, times: Iterable[float]) -> Iterator[Picture]:
    """Yield a picture (height, width, 3) at each of ``times`` (s, in order), taking the steps that lead there."""
    with Photographer(shot, simulation, times) as photographer:
        yield from photographer.due()
        while not photographer.moments.over:
            simulation.step()
            yield from photographer.due()


class Photographing(ABC):
    """The observer that takes pictures at ``times`` (s, in order); what becomes of each is said by who inherits."""

    def __init__(self, shot: Shot, times: Iterable[float] | None) -> None:
        self._shot, self._times = shot, times
        self._photographer: Photographer | None = None

    @abstractmethod
    def take(self, picture: Picture) -> None:
        """Do something with the next picture."""

    def begin(self, simulation: Simulation) -> None:
        """Take the start, where it is one of the times; without times as many a second as the shot says."""
        times = every(1.0 / self._shot.fps, simulation.time) if self._times is None else self._times
        self._photographer = Photographer(self._shot, simulation, times)
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Take the pictures whose time has come."""
        assert self._photographer is not None, "begin() comes before observe()"
        for picture in self._photographer.due():
            self.take(picture)

    def end(self, simulation: Simulation) -> None:
        """Free what it drew with."""
        if self._photographer is not None:
            self._photographer.close()


class Filming(Photographing):
    """Films a simulation: a picture at each of ``times`` (s), by default as many a second as the shot says.

    A film whose times are 1 / fps apart runs at the speed of the simulation, whatever the steps.
    """

    def __init__(self, shot: Shot, path: Path, times: Iterable[float] | None = None) -> None:
        super().__init__(shot, times)
        self._film = Film(path, shot.width, shot.height, shot.fps)

    def take(self, picture: Picture) -> None:
        """Add the picture to the film."""
        self._film.add(picture)

    def end(self, simulation: Simulation) -> None:
        """Finish the film."""
        try:
            self._film.close()
        finally:
            super().end(simulation)
