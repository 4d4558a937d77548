"""A world and its model in plain dicts and lists, compared after every step."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis.stateful import (
    RuleBasedStateMachine,
    invariant,
)
from plain_world import KINDS, RED, Bond, Link, Place, PlainWorld

from carom.ecs import (
    Component,
    EntityError,
    Name,
    Parent,
    Snapshot,
    World,
    state_hash,
)

QUERIES: list[tuple[tuple[type[Component], ...], ...]] = [
    ((), (), ()),
    ((Place,), (), ()),
    ((Place, Link), (), ()),
    ((Place,), (RED,), ()),
    ((), (), (Link, RED)),
    ((Place,), (Parent,), (Name, RED)),
]


class Compared(RuleBasedStateMachine):
    """One world beside its model: after every step all that can be asked of both is the same."""

    steps: ClassVar[int] = 0

    def __init__(self) -> None:
        super().__init__()
        self.world, self.model = World(capacity=1), PlainWorld()
        self.mark, self.ever = 0, [0]
        self.saved: list[tuple[Snapshot, PlainWorld, str]] = []
        self.hashes: dict[str, str] = {}

    def living(self) -> bool:
        """Tell whether anybody can be picked."""
        return bool(self.model.held)

    def pick(self, number: int) -> int:
        """Return a living entity."""
        handles = sorted(self.model.held)
        return handles[number % len(handles)]

    def bundle(self, kind: type[Component], numbers: tuple[float, ...], pick: int) -> dict[str, Any]:
        """Return values for a component."""
        if kind is Place:
            return {"position": numbers, "turns": pick % 100} if pick % 3 else {"position": numbers}
        if kind is Link:
            return {"target": self.pick(pick), "row": pick % (len(self.model.rows) + 3)} if self.model.held else {}
        if kind is Parent:
            return {"entity": self.pick(pick), "position": numbers} if self.model.held else {}
        return {}

    def taken(self, name: str, holder: int = -1) -> bool:
        """Tell whether another than ``holder`` has a name."""
        named = {h: str(held[Name]["text"]) for h, held in self.model.held.items() if Name in held}
        return bool(name) and any(text == name and h != holder for h, text in named.items())

    @invariant()
    def rows_and_queries_agree(self) -> None:
        """Handles lead to their rows and back; queries find the same rows, as a slice where they are contiguous."""
        type(self).steps += 1
        world, rows = self.world, self.model.rows
        assert world.used() == len(rows)
        living = [row for row, handle in enumerate(rows) if handle is not None]
        handles = [handle for handle in rows if handle is not None]
        assert [world.row(handle) for handle in handles] == world.slots.rows(np.array(handles, int)).tolist() == living
        assert world.entities(np.array(living, int)).tolist() == handles
        for kinds, without, any_of in QUERIES:
            expected = self.model.matching(kinds, without, any_of)
            found = world.rows(*kinds, without=without, any_of=any_of)
            contiguous = not expected or expected[-1] - expected[0] + 1 == len(expected)
            assert isinstance(found, slice) == contiguous
            assert np.r_[found].tolist() == expected
            query = world.query(*kinds, without=without, any_of=any_of)
            assert query.numbers.tolist() == expected
            assert query.entities.tolist() == [rows[row] for row in expected]
            assert query.has(RED).tolist() == [RED in self.model.held[rows[row] or 0] for row in expected]

    @invariant()
    def columns_agree(self) -> None:
        """Every column holds the model's bits, and zeros where nobody has the component."""
        for kind in KINDS:
            table, rows = self.world.table(kind), self.model.matching((kind,), (), ())
            assert np.nonzero(table.present)[0].tolist() == rows
            for name, array in table.arrays.items():
                expected = [self.model.held[self.model.rows[row] or 0][kind][name] for row in rows]
                assert array[rows].tobytes() == b"".join(value.tobytes() for value in expected), (kind, name)
                assert not array[~table.present].any()
        bond = self.world[Bond]
        assert list(zip(bond.who[: bond.count].tolist(), bond.row[: bond.count].tolist(), strict=True)) == (
            self.model.bonds
        )

    @invariant()
    def names_and_families_agree(self) -> None:
        """Names are found by themselves and by patterns, children by who carries them."""
        world, model = self.world, self.model
        named = [
            (int(h), str(model.held[h][Name]["text"])) for h in model.rows if h is not None and Name in model.held[h]
        ]
        named = [(handle, text) for handle, text in named if text]
        assert world.names() == [text for _, text in named]
        assert world.find_all("rain").tolist() == [handle for handle, text in named if text.startswith("rain")]
        assert world.find_all("*").tolist() == [handle for handle, _ in named]
        for handle, text in named[:3]:
            assert world.find(text) == handle
            assert world.name(handle) == text
        for parent in list(model.held)[:2]:
            expected = [
                h for h in model.rows if h is not None and model.held[h].get(Parent, {}).get("entity") == parent
            ]
            assert world.children(parent).tolist() == expected

    @invariant()
    def stale_handles_raise(self) -> None:
        """Who is gone is told, whatever has the row now."""
        stale = [handle for handle in self.ever if handle not in self.model.held][-3:]
        for handle in stale:
            assert handle not in self.world
            with pytest.raises(EntityError, match=r"^entity \d+, generation \d+, (was despawned|never was)"):
                self.world.despawn(handle, *list(self.model.held)[:1])

    @invariant()
    def hashes_agree(self) -> None:
        """Two states have one hash exactly if the model says that they are the same."""
        found, state = state_hash(self.world), self.model.state()
        assert self.hashes.setdefault(found, state) == state
        assert self.hashes.setdefault(state, found) == found
