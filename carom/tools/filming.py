"""Filming: the observers that take a film and a last picture of a simulation."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.film import Film, save_png
from carom.tools.recorder.blueprint import default_camera
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import did_you_mean

if TYPE_CHECKING:
    from carom.tools.renderer import Renderer
    from carom.tools.scene import Scene


@dataclass(frozen=True)
class Shot:
    """From where a world is photographed and how large: pixels across and down, pictures per simulated second."""

    camera: Camera
    width: int = 640
    height: int = 480
    fps: float = 30.0


def shot_of(loaded: LoadedWorld, name: str | None = None) -> Shot:
    """Return the shot a world file states, by the camera of that name.

    Without a name it is the file's render.camera, else ``main``, else its first camera, else one that sees everything.
    Raises CaromError for an unknown name.
    """
    known, render = loaded.cameras, loaded.render
    if name is not None and name not in known:
        hint = f"; {did_you_mean(name, known)}" if did_you_mean(name, known) else ""
        raise CaromError(f"{loaded.path}: no camera is named {name!r}; accepted: {', '.join(known) or 'none'}{hint}")
    chosen = name or render.camera or ("main" if "main" in known else next(iter(known), None))
    if chosen is None:
        camera = default_camera(loaded.simulation.world)
    else:
        words = known[chosen]
        camera = Camera(words.position, words.target, words.up or loaded.up, words.fov)
    return Shot(camera, render.width, render.height, render.fps)


class Filming:
    """Films a simulation, and photographs its last state; either path may be None.

    A picture is taken at the first step that is not before its time, so that a film of any frame rate runs at the
    speed of the simulation.
    """

    def __init__(self, shot: Shot, *, film: Path | None = None, picture: Path | None = None) -> None:
        self._shot, self._picture = shot, picture
        self._film = Film(film, shot.width, shot.height, shot.fps) if film is not None else None
        self._taken = 0
        self._renderer: Renderer | None = None
        self._scene: Scene | None = None

    def begin(self, simulation: Simulation) -> None:
        """Make the renderer and film the start."""
        from carom.tools.renderer import Renderer
        from carom.tools.scene import Scene

        self._renderer = Renderer(self._shot.width, self._shot.height)
        self._scene = Scene(simulation.world)
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Take the next picture of the film when its time has come."""
        if self._film is not None and simulation.time * self._shot.fps >= self._taken - 1e-9:
            assert self._renderer is not None and self._scene is not None
            self._film.add(self._renderer.picture(self._scene.batches(), self._shot.camera))
            self._taken += 1

    def end(self, simulation: Simulation) -> None:
        """Photograph the last state and finish the film."""
        try:
            if self._picture is not None and self._renderer is not None and self._scene is not None:
                save_png(self._picture, self._renderer.picture(self._scene.batches(), self._shot.camera))
        finally:
            if self._film is not None:
                self._film.close()
            if self._renderer is not None:
                self._renderer.close()
