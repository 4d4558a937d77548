"""Side: one of two runs that are compared, a recording or a world that is simulated."""

from __future__ import annotations

from pathlib import Path

from carom.ecs import Snapshot, restore_snapshot, state_hash, take_snapshot
from carom.ecs.errors import CaromError
from carom.systems.observer import unobserved
from carom.systems.simulation import Simulation
from carom.tools.replay import Replay
from carom.worlds.builder import LoadedWorld, load_world


class Side:
    """A run by its name: a recording (.rrd), simulated again where needed, or a world, simulated from its start.

    ``frames`` are those of which a recording holds all state, None for a world, of which any can be had. Raises
    CaromError for what is neither.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.replay = Replay(name) if Path(name).suffix.lower() == ".rrd" else None
        self.loaded: LoadedWorld = self.replay.loaded() if self.replay else load_world(name)
        self.notes = self.replay.notes if self.replay else []
        self.frames = sorted(self.replay.states) if self.replay else None
        self._edits = self.replay.recording.edits() if self.replay else {}
        self._kept: dict[int, Snapshot] = {}

    @property
    def simulation(self) -> Simulation:
        """The simulation that goes from frame to frame."""
        return self.loaded.simulation

    @property
    def first(self) -> int:
        """The first frame."""
        return self.replay.first if self.replay else 0

    @property
    def last(self) -> int:
        """The last frame that can be compared."""
        return self.frames[-1] if self.frames else self.loaded.run.frames

    def hash_at(self, frame: int) -> str:
        """Return the hash of all state in one of ``frames``; a world is asked in order of frames."""
        if self.replay:
            return self.replay.states[frame].hash
        with unobserved(self.simulation):
            self.simulation.step(frame - self.simulation.frame)
        self._kept[frame] = take_snapshot(self.simulation.world)
        return state_hash(self.simulation.world)

    def state_at(self, frame: int) -> Snapshot:
        """Return all state in one of ``frames``, or in a frame that a world was asked the hash of."""
        if self.replay:
            return self.replay.snapshot(self.simulation.world, self.replay.states[frame])
        return self._kept[frame]

    def go_to(self, frame: int) -> None:
        """Make the simulation what it was in such a frame."""
        if self.replay:
            self.replay.restore(self.simulation.world, self.replay.states[frame])
        else:
            restore_snapshot(self.simulation.world, self._kept[frame])

    def start(self) -> Simulation:
        """Make the simulation what it was in the first frame, and return it."""
        if self.replay:
            self.go_to(self.replay.first)
        else:
            self.loaded = load_world(self.name)
        return self.simulation

    def simulation_at(self, frame: int) -> Simulation:
        """Return a simulation of its own in any frame; raise CaromError for one the run does not have."""
        if self.replay:
            return self.replay.simulation_at(frame)
        if frame > self.last:
            raise CaromError(f"{self.name} does not have frame {frame}, but frames 0 to {self.last}")
        simulation = load_world(self.name).simulation
        simulation.step(frame)
        return simulation

    def redo(self, simulation: Simulation | None = None) -> bool:
        """Do what code outside did before the next step; tell whether that was anything."""
        simulation = simulation or self.simulation
        if self.replay is None or simulation.frame + 1 not in self._edits:
            return False
        self.replay.redo(simulation.world)
        return True

    def step(self) -> None:
        """Take the next step as it was taken then."""
        self.redo()
        with unobserved(self.simulation):
            self.simulation.step()
