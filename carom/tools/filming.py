"""Filming: from where a world is photographed, one picture of it, and the observer that films a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from carom.ecs import World
from carom.ecs.errors import CaromError, did_you_mean
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.film import Film, save_png
from carom.tools.recorder.blueprint import default_camera
from carom.worlds.builder import LoadedWorld

if TYPE_CHECKING:
    from carom.tools.renderer import Renderer
    from carom.tools.scene import Scene

ROUNDING = 1e-9  # of a picture's time, for steps that meet it but for rounding


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
        parts = f"no camera is named {name!r}", f"accepted: {', '.join(known) or 'none'}", did_you_mean(name, known)
        raise CaromError(f"{loaded.path}: {'; '.join(filter(None, parts))}")
    chosen = name or render.camera or ("main" if "main" in known else next(iter(known), None))
    if chosen is None:
        camera = default_camera(loaded.simulation.world)
    else:
        words = known[chosen]
        camera = Camera(words.position, words.target, words.up or loaded.up, words.fov)
    return Shot(camera, render.width, render.height, render.fps)


def photograph(shot: Shot, world: World, path: Path) -> None:
    """Write a picture (PNG) of a world as it is now."""
    from carom.tools.renderer import Renderer
    from carom.tools.scene import Scene

    with Renderer(shot.width, shot.height) as renderer:
        save_png(path, renderer.picture(Scene(world).batches(), shot.camera))


class Filming:
    """Films a simulation into an MP4.

    A picture is taken at the first step that is not before its time, so that a film of any frame rate runs at the
    speed of the simulation.
    """

    def __init__(self, shot: Shot, path: Path) -> None:
        self._shot = shot
        self._film = Film(path, shot.width, shot.height, shot.fps)
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
        """Take the next picture when its time has come."""
        assert self._renderer is not None and self._scene is not None, "begin() comes before observe()"
        if simulation.time * self._shot.fps >= self._film.frames - ROUNDING:
            self._film.add(self._renderer.picture(self._scene.batches(), self._shot.camera))

    def end(self, simulation: Simulation) -> None:
        """Finish the film."""
        try:
            self._film.close()
        finally:
            if self._renderer is not None:
                self._renderer.close()
