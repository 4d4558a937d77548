"""What a ring keeps leads back to the same bits, and its memory does not grow."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from heaps import bin_of_balls, hashes, stack_of_boxes

from carom.ecs import DeclarationError, NonFiniteError, SnapshotError, Transform, state_hash
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.worlds import load_world

WORLDS: dict[str, tuple[Callable[[], Simulation], int, int]] = {
    "the break of billiards": (lambda: load_world("billiards").simulation, 40, 50),
    "a stack of boxes": (stack_of_boxes, 30, 30),
    "a bin of 40 balls": (lambda: bin_of_balls(40), 30, 30),
}


def ringed(simulation: Simulation, ring: Ring) -> Ring:
    """Let a ring observe a simulation from now on."""
    ring.begin(simulation)
    simulation.observers.append(ring)
    return ring


@pytest.mark.parametrize("every", [1, 7])
@pytest.mark.parametrize("world", WORLDS)
def test_what_is_rewound_happens_again_to_the_last_bit(world: str, every: int) -> None:
    """At frames dense with contacts; also to frames between two snapshots, and twice over."""
    make, start, frames = WORLDS[world]
    simulation = make()
    simulation.step(start)
    ring = ringed(simulation, Ring(60, every))
    past = [state_hash(simulation.world), *hashes(simulation, frames)]
    assert simulation.world.count(Contact) >= 4
    for back in (frames - 3, 10, frames):
        ring.rewind(simulation, back)
        assert simulation.frame == start + frames - back
        assert state_hash(simulation.world) == past[frames - back]
        assert hashes(simulation, back) == past[frames - back + 1 :]


def test_a_ring_keeps_the_last_ones_of_every_few_frames() -> None:
    """What came after the frame gone back to is forgotten; so is what came after a state somebody restored."""
    simulation = stack_of_boxes()
    simulation.step(2)
    ring = ringed(simulation, Ring(4, 5))
    assert ring.frames == [2]
    simulation.step(21)
    assert ring.frames == [5, 10, 15, 20]
    ring.rewind_to(simulation, 13)
    assert ring.frames == [5, 10]
    ring.rewind_to(simulation, 13)
    assert simulation.frame == 13
    simulation.step(8)
    assert ring.frames == [5, 10, 15, 20]
    ring.end(simulation)
    assert ring.frames == [5, 10, 15, 20]


def test_rewinding_is_unseen_by_observers() -> None:
    """They saw these frames when they happened; afterwards they watch again."""
    seen: list[int] = []

    class Watcher(Ring):
        def observe(self, simulation: Simulation) -> None:
            """Note the frame."""
            seen.append(simulation.frame)

    followed = stack_of_boxes()
    ring = ringed(followed, Ring(3, 10))
    followed.observers.append(Watcher(1))
    followed.step(6)
    ring.rewind(followed, 2)
    followed.step(1)
    assert seen == [1, 2, 3, 4, 5, 6, 5]


class Seen:
    """An observer that keeps the hash of every frame."""

    def __init__(self) -> None:
        self.hashes: dict[int, str] = {}
        self.ended = False

    def begin(self, simulation: Simulation) -> None:
        """Keep the first."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep another."""
        assert simulation.frame not in self.hashes
        self.hashes[simulation.frame] = state_hash(simulation.world)

    def end(self, simulation: Simulation) -> None:
        """Note that this was all."""
        self.ended = True


def test_a_ring_shows_what_led_here_to_the_last_bit() -> None:
    """From snapshots seconds apart, whatever was done by hand between steps; what comes after is what would have."""
    simulation, other = stack_of_boxes(), stack_of_boxes()
    ring, then, now = Ring.of_seconds(0.5, simulation), Seen(), Seen()
    for observer in (ring, then):
        observer.begin(simulation)
        simulation.observers.append(observer)
    for one in (simulation, other):
        for number in range(5):
            one.step(17)
            one[f"box{number % 4}"].motion.linear = (0.0, 1.0, 0.3)
        one.step(3)
    simulation["box1"].motion.linear = (0.0, 0.0, 0.0)  # seen in the last frame
    answered = vars(simulation.world[Answered]).copy()
    ring.show(simulation, now)
    assert list(now.hashes) == list(range(52, 89))
    assert now.ended
    assert now.hashes | {88: then.hashes[88]} == {frame: then.hashes[frame] for frame in range(52, 89)}
    assert now.hashes[88] == state_hash(simulation.world) != then.hashes[88]
    assert vars(simulation.world[Answered]) == answered
    other["box1"].motion.linear = (0.0, 0.0, 0.0)
    assert hashes(simulation, 40) == hashes(other, 40)
    assert list(then.hashes) == list(range(129))


def test_a_ring_keeps_what_was_done_by_hand() -> None:
    """A frame of which there is no snapshot is gone back to all the same."""
    simulation = stack_of_boxes()
    ring = ringed(simulation, Ring(3, 20))
    simulation.step(5)
    simulation["box0"].motion.linear = (0.0, 2.0, 0.0)
    past = hashes(simulation, 30)
    assert ring.frames == [0, 6, 20]
    ring.rewind_to(simulation, 15)
    assert [state_hash(simulation.world), *hashes(simulation, 20)] == past[9:30]


def test_showing_forgets_nothing_that_was_done_since_the_last_step() -> None:
    """Who sleeps and was pushed in between wakes all the same."""
    simulation = stack_of_boxes()
    ring = ringed(simulation, Ring(2, 60))
    simulation.step(400)
    assert simulation["box3"].motion.asleep
    simulation["box3"].motion.linear = (0.0, 2.0, 0.0)
    ring.show(simulation, Seen())
    simulation.step()
    assert not simulation["box3"].motion.asleep
    assert simulation["box3"].motion.linear[1] > 1.5
    assert ring.frames[-1] == 401


def test_what_was_before_other_rules_is_no_past() -> None:
    """A snapshot holds neither forces nor systems, so that what they did cannot be done again."""
    simulation = stack_of_boxes()
    ring = ringed(simulation, Ring(9, 2))
    simulation.step(5)
    simulation.force("wind", velocity=(5.0, 0.0, 0.0))
    simulation.step(2)
    assert ring.frames == [6]
    simulation.step()
    simulation.force_function(lambda world, rows: np.zeros((len(rows), 3)))
    simulation.step()
    assert ring.frames == [9]


def test_a_step_that_was_not_finished_is_not_shown() -> None:
    """The last frame is that before it, and the world stays in the state that the fault tells of."""
    simulation = stack_of_boxes()
    ring, seen = ringed(simulation, Ring(2, 30)), Seen()
    simulation.step(7)
    simulation["box0"].motion.linear = (np.nan, 0.0, 0.0)
    with np.errstate(all="ignore"), pytest.raises(NonFiniteError):
        simulation.step()
    ring.show(simulation, seen)
    assert list(seen.hashes) == list(range(8))
    assert simulation.frame == 8
    assert np.isnan(simulation["box0"].motion.linear[0])


def test_memory_of_the_oldest_is_used_again() -> None:
    """A full ring takes none, whatever it goes back to."""
    simulation = stack_of_boxes()
    ring = ringed(simulation, Ring(3))
    simulation.step(40)  # until the table of contacts has its size

    def memory() -> set[int]:
        return {id(snapshot.memory) for snapshot in [*ring._kept, *ring._spare]}

    simulation.world.spawn_many(2000, Transform())
    simulation.step(3)
    before = memory()
    simulation.step(5)
    ring.rewind(simulation, 2)
    simulation.step(5)
    assert memory() == before
    assert len(before) == 3


def test_there_is_no_way_back_beyond_the_oldest_nor_forward() -> None:
    """The message says how far it goes; the world stays where it is."""
    simulation = stack_of_boxes()
    empty, ring = Ring(2), Ring(2, 2)
    simulation.observers.append(ring)
    simulation.step(6)
    then = state_hash(simulation.world)
    for frame, where, reach in (
        (3, ring, "goes back from frame 6 to 4"),
        (7, ring, "goes back from frame 6 to 4"),
        (5, empty, "has kept nothing"),
    ):
        with pytest.raises(SnapshotError) as fault:
            where.rewind_to(simulation, frame)
        assert str(fault.value) == f"no way back to frame {frame}: the ring {reach}"
    assert (simulation.frame, state_hash(simulation.world)) == (6, then)


@pytest.mark.parametrize(("count", "every", "message"), [(0, 1, "count"), (1, 0, "every")])
def test_a_ring_keeps_at_least_one(count: int, every: int, message: str) -> None:
    """Of every frame at the most."""
    with pytest.raises(DeclarationError, match=f"^a ring's {message} is 1 or more, received 0$"):
        Ring(count, every)
