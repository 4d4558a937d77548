"""Substeps: where bodies are at the end of every substep, on a timeline that counts them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import Parent, System, Transform
from carom.ecs.hierarchy import carry
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.bodies import Bodies, Group, Noted, write_poses


class Substeps(Track):
    """Poses after every substep of every step, on ``substep`` and ``sim_time``.

    Steps in which bodies come or go are told by their frames alone.
    """

    key: ClassVar[str] = "substeps"
    detail: ClassVar[str] = "solver"
    every_step: ClassVar[bool] = True

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Put all that is recorded on the timeline too; hear of substeps from now on."""
        bodies = tracks[Bodies.key]
        assert isinstance(bodies, Bodies)
        self._simulation, self._stream, self._bodies, self._last = simulation, stream, bodies, bodies.nowhere()
        self._groups: dict[bytes, Group] = {}
        self._step: list[Noted] = []
        self._pending: list[Noted] = []
        stream.substeps = simulation.settings.substeps
        simulation.hearers.append(self._note)

    def end(self, simulation: Simulation) -> None:
        """Hear no longer."""
        simulation.hearers.remove(self._note)

    def _note(self, system: System) -> None:
        world, settings = self._simulation.world, self._simulation.settings
        progress: Progress = world[Progress]
        if system.name == "begin_step":
            self._step = []
        elif system.name == "relax" and progress.left:
            number = (world.frame - 1) * self._stream.substeps + progress.substep
            self._keep(Stamp(number, progress.clock + settings.dt / settings.substeps))

    def _keep(self, stamp: Stamp) -> None:
        world, bodies = self._simulation.world, self._bodies
        if bodies.structure != world.structure:
            return
        if self._groups is not bodies.groups:
            self.write(self._stream)
            self._groups, self._last = bodies.groups, bodies.nowhere()
        position, rotation = world[Transform].position.copy(), world[Transform].rotation.copy()
        carry(world, world.row_numbers(Parent, Transform), position, rotation)
        self._last, moved = bodies.noted(position, rotation, self._last)
        self._step.append((stamp, self._last, moved))

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the poses within the last step and at its end."""
        self._keep(Stamp(stamp.frame * stream.substeps, stamp.time))
        self._pending += self._step

    def write(self, stream: Stream) -> None:
        """Write the kept poses, one block per group."""
        write_poses(self._pending, list(self._groups.values()), stream.substep_rows)
        self._pending = []
