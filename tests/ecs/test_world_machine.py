"""Thousands of random changes of a world, each held against plain dicts and lists."""

from __future__ import annotations

import numpy as np
import pytest
from faults import error
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    initialize,
    precondition,
    rule,
    run_state_machine_as_test,
)
from plain_world import KINDS, WATCHED, Bond, Link, Place
from world_machine import QUERIES, Compared

from carom.ecs import (
    Component,
    DeclarationError,
    Name,
    restore_snapshot,
    state_hash,
    take_snapshot,
)

NUMBERS = st.sampled_from([0.0, -0.0, 1.5, -2.25, float("nan"), float("inf"), 1e-320])
TRIPLES = st.tuples(NUMBERS, NUMBERS, NUMBERS)
NAMES = st.sampled_from(["", "ball", "wall", "rain[0]", "rain[1]", "rain[1,2]", "Ω"])
PICK = st.integers(0, 10**6)  # whom of those there are, by the rest of a division
KIND = st.sampled_from(KINDS)


class Machine(Compared):
    """Changes of one world and of its model."""

    @initialize()
    def watch(self) -> None:
        """Have changes noted from the first entity on."""
        self.take_mark()

    @precondition(lambda self: len(self.model.held) < 40)
    @rule(count=st.sampled_from([0, 1, 1, 2, 3, 5, 20]), kinds=st.sets(KIND), numbers=TRIPLES, pick=PICK)
    def spawn_many(self, count: int, kinds: set[type[Component]], numbers: tuple[float, ...], pick: int) -> None:
        """New ones stand in the lowest gap that holds them all; arrays give each its own value."""
        values = {kind: self.bundle(kind, numbers, pick) for kind in sorted(kinds - {Name}, key=lambda kind: kind.key)}
        if Place in values and count:
            values[Place]["position"] = np.outer(np.arange(1, count + 1), numbers)
        names = [f"many{self.mark}.{pick}.{k}" for k in range(count)] if Name in kinds and count else None
        if names and any(map(self.taken, names)):
            return
        first = self.model.first_row(count)
        made = self.world.spawn_many(count, *(kind(**given) for kind, given in values.items()), names=names)
        handles = made.tolist()
        assert len({*handles, *self.model.held}) == count + len(self.model.held)
        self.model.place(first, handles)
        for k, handle in enumerate(handles):
            for kind, given in values.items():
                own = {"position": given["position"][k]} if kind is Place else {}
                self.model.fill(handle, kind, given | own)
            if names:
                self.model.fill(handle, Name, {"text": names[k]})
        self.ever = [*self.ever[-50:], *handles]

    @rule(name=NAMES)
    def spawn_named(self, name: str) -> None:
        """A name that is taken is refused, and nothing has happened."""
        if self.taken(name):
            message = f"two entities would be named {name!r}; names are unique, choose another"
            with error(DeclarationError, message):
                self.world.spawn(Place(), name=name)
            return
        first = self.model.first_row(1)
        handle = int(self.world.spawn(Place(), name=name))
        self.model.place(first, [handle])
        self.model.fill(handle, Place, {})
        self.model.fill(handle, Name, {"text": name})
        self.ever.append(handle)

    @precondition(Compared.living)
    @rule(picks=st.lists(PICK, min_size=1, max_size=6), as_array=st.booleans())
    def despawn(self, picks: list[int], as_array: bool) -> None:
        """Some go, as an array or one by one, also where one is named twice; those they carry go with them."""
        handles = [self.pick(number) for number in picks]
        self.world.despawn(*([np.array(handles)] if as_array else handles))
        self.model.despawn(handles)

    @rule(number=st.integers(0, len(QUERIES) - 1))
    def despawn_query(self, number: int) -> None:
        """Everyone a query finds goes."""
        kinds, without, any_of = QUERIES[number]
        if len(found := self.model.matching(kinds, without, any_of)) < 8:
            self.world.despawn(self.world.query(*kinds, without=without, any_of=any_of))
            self.model.despawn([handle for row in found if (handle := self.model.rows[row]) is not None])

    @precondition(Compared.living)
    @rule(kind=KIND, numbers=TRIPLES, name=NAMES, who=PICK, whom=PICK)
    def attach(self, kind: type[Component], numbers: tuple[float, ...], name: str, who: int, whom: int) -> None:
        """A component comes, or is replaced by another of its kind."""
        entity = self.pick(who)
        given = {"text": name} if kind is Name else self.bundle(kind, numbers, whom)
        if kind is Name and self.taken(name, entity):
            with pytest.raises(DeclarationError):
                self.world.attach(entity, Name(text=name))
            return
        self.world.attach(entity, kind(**given))
        self.model.fill(entity, kind, given)

    @precondition(Compared.living)
    @rule(kinds=st.sets(KIND, min_size=1, max_size=2), who=PICK)
    def detach(self, kinds: set[type[Component]], who: int) -> None:
        """Components go; those that are not there are no fault."""
        entity = self.pick(who)
        self.world.detach(entity, *kinds)
        for kind in kinds:
            self.model.held[entity].pop(kind, None)

    @precondition(Compared.living)
    @rule(numbers=TRIPLES, who=PICK, way=st.sampled_from(["whole", "element", "slice", "sum", "edit", "turns"]))
    def write(self, numbers: tuple[float, ...], who: int, way: str) -> None:
        """Values are written through an entity or through the table."""
        entity = self.pick(who)
        if Place not in self.model.held[entity]:
            return
        place, values = self.world[entity].place, self.model.held[entity][Place]
        if way == "whole":
            place.position = numbers
            values["position"][:] = numbers
        elif way == "element":
            place.position[who % 3] = numbers[0]
            values["position"][who % 3] = numbers[0]
        elif way == "slice":
            place.position[1:] = numbers[1:]
            values["position"][1:] = numbers[1:]
        elif way == "sum":
            place.position += numbers
            values["position"] += numbers
        elif way == "edit":
            with self.world.edit(Place) as table:
                table.position[self.world.row(entity)] = numbers
            values["position"][:] = numbers
        else:
            place.turns += 1
            values["turns"] += 1

    @precondition(Compared.living)
    @rule(name=NAMES, who=PICK)
    def rename(self, name: str, who: int) -> None:
        """A name is edited; that of another is refused."""
        entity = self.pick(who)
        if Name not in self.model.held[entity]:
            return
        if self.taken(name, entity):
            with pytest.raises(DeclarationError):
                self.world[entity].name.text = name
            return
        self.world[entity].name.text = name
        self.model.fill(entity, Name, {"text": name})

    @rule(count=st.integers(0, 4), pick=PICK)
    def bind(self, count: int, pick: int) -> None:
        """Rows of a relation hold handles and rows."""
        whom = [(self.pick(pick + k) if self.model.held else -1, (pick + k) % 7 - 1) for k in range(count)]
        with self.world.faces(None):
            self.world.resize(Bond, count)
            bond = self.world[Bond]
            bond.who[:count], bond.row[:count] = np.array(whom, np.int64).reshape(-1, 2).T
        self.model.bonds = whom

    @rule()
    def compact(self) -> None:
        """All stand in the first rows, in their order; the hash is as it was."""
        before = state_hash(self.world)
        self.world.compact()
        self.model.compact()
        assert state_hash(self.world) == before

    @rule()
    def save(self) -> None:
        """Keep a snapshot."""
        self.saved = [*self.saved[-2:], (take_snapshot(self.world), self.model.saved(), state_hash(self.world))]

    @precondition(lambda self: self.saved)
    @rule(which=PICK)
    def restore(self, which: int) -> None:
        """Everything is as it was saved, by hash too."""
        snapshot, model, saved_hash = self.saved[which % len(self.saved)]
        restore_snapshot(self.world, snapshot)
        self.model.restore(model)
        assert state_hash(self.world) == saved_hash

    @rule()
    def take_mark(self) -> None:
        """From here on changes count anew."""
        self.model.look(self.mark)
        self.mark = self.world.mark(*WATCHED)

    @rule(back=st.integers(0, 3))
    def changed_since(self, back: int) -> None:
        """Those who came or hold something else since a mark, and nobody else."""
        mark = max(1, self.mark - back)
        self.model.look(self.mark)
        for kinds in ((Place,), (Place, Link)):
            expected = [
                row
                for row in self.model.matching(kinds, (), ())
                if any(self.model.changed[kind][self.model.rows[row] or 0] >= mark for kind in kinds)
            ]
            assert self.world.row_numbers(*kinds, changed_since=mark).tolist() == expected


@pytest.mark.parametrize("steps", [2_000, pytest.param(10_000, marks=pytest.mark.slow)])
def test_a_world_does_what_plain_dicts_do(steps: int) -> None:
    """Whatever comes, goes, moves, is saved and restored: the same rows, values, names, changes and faults."""
    Machine.steps = 0
    run_state_machine_as_test(
        Machine,
        settings=settings(
            max_examples=steps // 29,  # of at most 50 steps
            stateful_step_count=50,
            derandomize=True,
            database=None,
            deadline=None,
            suppress_health_check=list(HealthCheck),
        ),
    )
    assert Machine.steps >= steps
