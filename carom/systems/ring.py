"""Ring: the last snapshots of a simulation, to go back to any frame since the oldest."""

from __future__ import annotations

from collections import deque

from carom.ecs import DeclarationError, Snapshot, SnapshotError, restore_snapshot, take_snapshot
from carom.systems.observer import unobserved
from carom.systems.simulation import Simulation


class Ring:
    """Keep the last ``count`` snapshots, of every ``every``-th frame: ``simulation.observers.append(ring)``.

    A new snapshot takes the memory of the oldest: once the ring is full, nothing grows, and no memory is touched for
    the first time, which costs more than the copying. Raises DeclarationError for less than one of either.
    """

    def __init__(self, count: int, every: int = 1) -> None:
        for name, value in (("count", count), ("every", every)):
            if value < 1:
                raise DeclarationError(f"a ring's {name} is 1 or more, received {value}")
        self.count, self.every = count, every
        self._kept: deque[Snapshot] = deque()
        self._spare: list[Snapshot] = []

    @property
    def frames(self) -> list[int]:
        """The frames of which a snapshot is kept, the oldest first."""
        return [snapshot.frame for snapshot in self._kept]

    @property
    def snapshots(self) -> list[Snapshot]:
        """What is kept, the oldest first; each lasts until the ring gives its memory to a later one."""
        return list(self._kept)

    def begin(self, simulation: Simulation) -> None:
        """Keep the world before its first step."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep the world if it is one of the frames, or nothing is kept yet."""
        world = simulation.world
        self._forget_from(world.frame)  # somebody restored an earlier state: what was kept of later ones is no past
        if self._kept and world.frame % self.every:
            return
        if len(self._kept) == self.count:
            self._spare.append(self._kept.popleft())
        self._kept.append(take_snapshot(world, reuse=self._spare.pop() if self._spare else None))

    def end(self, simulation: Simulation) -> None:
        """Leave everything as it is."""

    def rewind(self, simulation: Simulation, frames: int) -> None:
        """Go back by a number of frames; see `rewind_to`."""
        self.rewind_to(simulation, simulation.world.frame - frames)

    def rewind_to(self, simulation: Simulation, frame: int) -> None:
        """Make the world what it was after ``frame``; what was kept of later frames is forgotten.

        Between two snapshots the simulation steps again from the earlier one, unseen by its observers: to the same
        bits, unless somebody changed the world by hand in between, which is not done again. Raises SnapshotError for a
        frame before the oldest or after the current one.
        """
        world = simulation.world
        if frame == world.frame:
            return
        if not self._kept or not self._kept[0].frame <= frame <= world.frame:
            reach = f"goes back from frame {world.frame} to {self._kept[0].frame}" if self._kept else "has kept nothing"
            raise SnapshotError(f"no way back to frame {frame}: the ring {reach}")
        self._forget_from(frame + 1)
        earlier = self._kept[-1]
        restore_snapshot(world, earlier)
        with unobserved(simulation):
            simulation.step(frame - earlier.frame)

    def _forget_from(self, frame: int) -> None:
        while self._kept and self._kept[-1].frame >= frame:
            self._spare.append(self._kept.pop())
