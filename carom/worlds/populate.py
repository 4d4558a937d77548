"""Entities of a world file into a simulation."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from typing import Any, TypeVar

import numpy as np

from carom.ecs.column import Integers
from carom.ecs.components.parent import Parent
from carom.ecs.errors import DeclarationError
from carom.systems.compound import StatedBodies, joining, weigh
from carom.systems.simulation import Simulation
from carom.worlds.crowd import Form, Member, Some, add_run, runs
from carom.worlds.forms import form_of
from carom.worlds.generators import Setting
from carom.worlds.geometry import GeometryReader
from carom.worlds.intake import Intake
from carom.worlds.names import whole_of_copy
from carom.worlds.source import Source
from carom.worlds.unfold import Item

Found = TypeVar("Found")


class Populator:
    """Adds entities, reporting what is wrong with each where the file says it."""

    def __init__(self, source: Source, simulation: Simulation, geometries: GeometryReader, setting: Setting) -> None:
        self.simulation = simulation
        self.intake = Intake(source, simulation, geometries, setting)
        self.unweighed: list[int] = []  # bodies whose mass depends on what they carry

    def add_all(self, items: list[Item]) -> None:
        """Add the entities of a file in its order, those together whose words are of one form."""
        stated = [(item, item.words.model_dump(exclude_unset=True)) for item in items if item.words is not None]
        parents = [(item.group, words["parent"].get("entity")) for item, words in stated if "parent" in words]
        carriers = [group.whole(name) for group, name in parents if name is not None]
        self.intake.carriers = {*carriers, *map(whole_of_copy, carriers)}
        crowd: list[Some] = []
        for item, words in stated:
            if "chain" in words:  # its links are laid at once, after those before it
                self.add(crowd)
                crowd = []
            some = self.intake.read(item, words)
            if some is None:
                continue
            if some.rotations is None:
                self.add(crowd)
                self.add_alone(some)
                crowd = []
            else:
                crowd.append(some)
        self.add(crowd)

    def add(self, crowd: Sequence[Some]) -> None:
        """Add entities in their order, made up by their form."""
        world, forms = self.simulation.world, dict[Hashable, list[int]]()
        for number, some in enumerate(crowd):
            forms.setdefault(form_of(some.words), []).append(number)
        members: dict[int, Member] = {}
        for numbers in forms.values():
            for part, form in self.told(crowd, numbers, lambda alike: Form(world, alike)):
                members |= {number: Member(crowd[number], form, place) for place, number in enumerate(part)}
        for run in runs(members[number] for number in sorted(members)):
            for part, entities in self.told(run, range(len(run)), lambda some: add_run(world, some)):
                ends = np.cumsum([len(run[number].some.positions) for number in part])
                for number, made in zip(part, np.split(entities, ends[:-1]), strict=True):
                    self.settle(run[number].some, made)

    def add_alone(self, some: Some) -> None:
        """Add an entity whose words say where it is."""
        try:
            self.settle(some, self.simulation.add_many(some.positions, names=some.names, **some.words))
        except DeclarationError as fault:
            self.intake.report(some.path, str(fault))

    def settle(self, some: Some, made: Integers) -> None:
        """Note what is to be done of entities once all are there."""
        self.intake.places_in_file.update(dict.fromkeys(made.tolist(), some.path))
        self.intake.connections.add(made, some)
        if some.weight is not None:
            self.simulation.world[StatedBodies].words.update(dict.fromkeys(made.tolist(), some.weight))
            self.unweighed += made.tolist()

    def told(
        self, crowd: Sequence[Any], numbers: Sequence[int], act: Callable[[list[Any]], Found]
    ) -> Iterator[tuple[Sequence[int], Found]]:
        """Yield what ``act`` makes of some of a crowd; where it refuses, of halves of them, to report whom."""
        try:
            yield numbers, act([crowd[number] for number in numbers])
        except DeclarationError as fault:
            if len(numbers) == 1:
                one = crowd[numbers[0]]
                self.intake.report((one.some if isinstance(one, Member) else one).path, str(fault))
                return
            half = len(numbers) // 2
            yield from self.told(crowd, numbers[:half], act)
            yield from self.told(crowd, numbers[half:], act)

    def weigh_all(self) -> None:
        """Let bodies weigh what they carry, now that it is known; report what cannot be carried by a body."""
        world = self.simulation.world
        bodies = world.slots.rows(np.array(self.unweighed, np.int64))
        joined = self.each(world.row_numbers(Parent), lambda rows: joining(world, rows))
        if joined is not None:
            self.each(np.union1d(bodies, joined), lambda rows: weigh(world, rows))

    def join_all(self) -> None:
        """Let joints and the links of chains hold each other, at the poses where all are now."""
        self.intake.laying.join_all()
        self.intake.connections.join_all()

    def each(self, rows: Integers, act: Callable[[Integers], Any]) -> Any:
        """Return what ``act`` makes of all rows; where it refuses, try one by one to report whom."""
        try:
            return act(rows)
        except DeclarationError:
            pass
        for row in rows:
            try:
                act(np.array([row]))
            except DeclarationError as fault:
                self.intake.report(self.intake.places_in_file[self.simulation.world.entity(row)], str(fault))
        return None
