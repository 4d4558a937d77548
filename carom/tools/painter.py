"""Painter: pictures of one world with everything that is drawn over it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from carom.ecs import Transform
from carom.systems.simulation import Simulation
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.coloring import Coloring
from carom.tools.film import Picture
from carom.tools.ghosts import copies, elsewhere, ghosts_of, legend_of_ghosts, path_lines
from carom.tools.legends import legend_inset
from carom.tools.look import Look
from carom.tools.marks import Mark
from carom.tools.overlays import OVERLAYS
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.overlays.plot import Plot
from carom.tools.particles import particle_marks
from carom.tools.quantities import quantity
from carom.tools.scene import Scene
from carom.tools.view import View

if TYPE_CHECKING:
    from carom.tools.renderer import Renderer

STIRRED = 1e-3  # of the distance to the target, about a pixel, and of a turn (rad): less is no motion


class Painter:
    """Draws a world by a look; it is an observer too, of runs whose overlays look back, such as trails."""

    def __init__(self, simulation: Simulation, look: Look) -> None:
        self._simulation, self._scene = simulation, Scene(simulation.world)
        self._coloring = Coloring(look.color)
        self._wireframe = look.wireframe
        keys = dict.fromkeys((*(("wireframe",) if look.wireframe else ()), *look.overlays))
        self._overlays: list[Overlay] = [OVERLAYS[key]() for key in keys]
        self._overlays += [Plot(quantity(text, simulation.world)) for text in look.plots]

    def batches(self, transform: Transform | None = None) -> list[Batch]:
        """Return the bodies as they are now, or at other poses, in the colours of the mode."""
        return self._scene.batches(transform, self._coloring)

    def picture(
        self, renderer: Renderer, camera: Camera, transform: Transform | None = None, time: float | None = None,
        batches: Sequence[Batch] | None = None,
    ) -> Picture:  # fmt: skip
        """Return the picture (height, width, 3) of the world as it is now.

        Poses, time (s) and bodies may be others than those of now.
        """
        return self.pictures(renderer, [camera], transform, time, batches)[0]

    def pictures(
        self, renderer: Renderer, cameras: Sequence[Camera], transform: Transform | None = None,
        time: float | None = None, batches: Sequence[Batch] | None = None,
    ) -> list[Picture]:  # fmt: skip
        """Return the `picture` of each camera."""
        simulation = self._simulation
        transform = simulation.world[Transform] if transform is None else transform
        time = simulation.time if time is None else time
        batches = self.batches(transform) if batches is None else batches
        views = [View(camera, renderer.width, renderer.height) for camera in cameras]
        marks = [self._marks(Seen(simulation, batches, transform, time, view)) for view in views]
        batches = [*batches, *self.ghosts(transform, time, STIRRED * min(camera.distance for camera in cameras))]
        solid = [batch for batch in batches if batch.floor is not None] if self._wireframe else batches
        return renderer.pictures(solid, cameras, marks)

    def ghosts(self, transform: Transform, time: float, blur: float) -> list[Batch]:
        """Return the copies that the ghosts of the world are, but for those nearer than ``blur`` (m) to others."""
        found: list[Batch] = []
        for ghost, poses, rows in elsewhere(self._simulation.world, transform, time, blur):
            if len(rows):
                found += copies(ghost, self._scene.batches(poses), rows)
        return found

    def watch(self) -> None:
        """See the world at the start and after every step."""
        for overlay in self._overlays:
            overlay.watch(self._simulation.world)

    def begin(self, simulation: Simulation) -> None:
        """Watch the start."""
        self.watch()

    def observe(self, simulation: Simulation) -> None:
        """Watch a step."""
        self.watch()

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""

    def _marks(self, seen: Seen) -> Sequence[Mark]:
        marks = [mark for overlay in self._overlays for mark in overlay.marks(seen)]
        legends = [legend for legend in (self._coloring.legend, legend_of_ghosts(seen.world)) if legend is not None]
        paths = [lines for ghost in ghosts_of(seen.world) if (lines := path_lines(ghost)) is not None]
        clouds = particle_marks(seen.world, seen.view)
        return [*clouds, *paths, *(legend_inset(legend, seen.view) for legend in legends), *marks]
