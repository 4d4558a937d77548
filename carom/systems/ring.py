"""Ring: the last snapshots of a simulation, to go back to any frame since the oldest, or to show what led here."""

from __future__ import annotations

import math
from collections import deque

from carom.ecs import (
    DeclarationError,
    Schedule,
    Snapshot,
    SnapshotError,
    restore_snapshot,
    take_snapshot,
)
from carom.ecs.writes import WriteLog
from carom.systems.detection.answered import uncounted
from carom.systems.edits import NOTHING, Done, EditWatch, Retelling
from carom.systems.events import Events
from carom.systems.forces.law import Forces
from carom.systems.observer import Observer, unobserved
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation

SNAPSHOTS_EVERY = 1.0  # s; a snapshot takes half a millisecond, 1.2 ms with a thousand boxes


class Ring:
    """Keep the last ``count`` snapshots, of every ``every``-th frame: ``simulation.observers.append(ring)``.

    Beside these it keeps one of each frame before which code outside the step changed the world, since that is not
    done again on the way from one snapshot to the next; what was before other settings, forces, events or systems it
    forgets. A new snapshot takes the memory of the oldest: once the ring is full, nothing grows, and no memory is
    touched for the first time, which costs more than the copying. Raises DeclarationError for less than one of either.
    """

    def __init__(self, count: int, every: int = 1) -> None:
        for name, value in (("count", count), ("every", every)):
            if value < 1:
                raise DeclarationError(f"a ring's {name} is 1 or more, received {value}")
        self.count, self.every = count, every
        self._kept: deque[Snapshot] = deque()
        self._spare: list[Snapshot] = []
        self._edits = EditWatch()
        self._done: dict[int, Done] = {}  # from outside, by the frame it led to
        self._rules: tuple[Settings, int, int, Schedule] | None = None
        self._seen = -1
        self._showing = False

    @classmethod
    def of_seconds(cls, seconds: float, simulation: Simulation) -> Ring:
        """Return a ring that goes back by so many seconds, and by up to one more: it keeps a snapshot of each."""
        dt = simulation.settings.dt
        every = max(1, round(min(seconds, SNAPSHOTS_EVERY) / dt))
        return cls(1 + math.ceil(seconds / (every * dt) - 1e-9), every)

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
        simulation.world.writes = simulation.world.writes or WriteLog()
        self._edits.begin(simulation)
        self._rules, self._seen = _rules(simulation), simulation.frame
        self._keep(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep the world if it is one of the frames, was changed from outside, or nothing is kept yet."""
        if self._showing:
            return
        frame = simulation.frame
        done = self._edits.done(simulation)
        if self._rules != _rules(simulation):
            self._forget_from(0)
        self._forget_from(frame)  # somebody restored an earlier state: what was kept of later ones is no past
        if done.words or not self._kept or frame % self.every == 0:
            self._keep(simulation)
        if done.words:
            self._done[frame] = done
        self._rules, self._seen = _rules(simulation), frame

    def end(self, simulation: Simulation) -> None:
        """Leave everything as it is."""

    def rewind(self, simulation: Simulation, frames: int) -> None:
        """Go back by a number of frames; see `rewind_to`."""
        self.rewind_to(simulation, simulation.world.frame - frames)

    def rewind_to(self, simulation: Simulation, frame: int) -> None:
        """Make the world what it was after ``frame``; what was kept of later frames is forgotten.

        Between two snapshots the simulation steps again from the earlier one, unseen by its observers: to the same
        bits. Raises SnapshotError for a frame before the oldest or after the current one.
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
        self._edits.begin(simulation)

    def show(self, simulation: Simulation, observer: Observer) -> None:
        """Show an observer such as a recorder all frames since the oldest snapshot again, and leave the world as it is.

        The last of them is the world of now, or, where a step was not finished, what it was before that step. Others
        who observe the simulation see nothing of it, and no counts change.
        """
        world = simulation.world
        writes, world.writes = world.writes, None
        now = take_snapshot(world)
        last = now.frame if now.frame == self._seen or not self._kept else self._seen
        known = {snapshot.frame: snapshot for snapshot in self._kept if snapshot.frame <= last}
        if last == now.frame:
            known[last] = now
        tell, self._showing, retelling = observer.begin, True, Retelling()
        world.add(retelling)
        with unobserved(simulation), uncounted(world):
            try:
                for frame in range(min(known), last + 1):
                    if frame in known:
                        restore_snapshot(world, known[frame])
                    else:
                        simulation.step()
                    retelling.done = self._done.get(frame, NOTHING)
                    tell(simulation)
                    tell = observer.observe
            finally:
                observer.end(simulation)
                restore_snapshot(world, now)
                self._edits.pass_over(simulation)
                world.writes = writes
                self._showing, retelling.done = False, None

    def _keep(self, simulation: Simulation) -> None:
        world, reach = simulation.world, (self.count - 1) * self.every
        self._forget_from(world.frame)
        while len(self._kept) > 1 and self._kept[1].frame <= world.frame - reach:
            self._spare.append(self._kept.popleft())
        del self._spare[self.count :]
        self._kept.append(take_snapshot(world, reuse=self._spare.pop() if self._spare else None))
        self._done = {frame: done for frame, done in self._done.items() if self._kept[0].frame < frame < world.frame}

    def _forget_from(self, frame: int) -> None:
        while self._kept and self._kept[-1].frame >= frame:
            self._spare.append(self._kept.pop())


def _rules(simulation: Simulation) -> tuple[Settings, int, int, Schedule]:
    """Return what a snapshot does not hold and a step depends on."""
    world = simulation.world
    return world[Settings], world[Forces].count, len(world[Events].entries), simulation.schedule
