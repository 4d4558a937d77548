"""What a ring keeps leads back to the same bits, and its memory does not grow."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from heaps import bin_of_balls, hashes, stack_of_boxes

from carom.ecs import DeclarationError, SnapshotError, Transform, state_hash
from carom.ecs.relations.contact import Contact
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
