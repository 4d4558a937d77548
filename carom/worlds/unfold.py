"""Unfolding: entities and groups of a file into entities with words of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.worlds.check import check, check_item, refuse_form
from carom.worlds.errors import Path
from carom.worlds.generators import GENERATORS, Setting
from carom.worlds.groups import WORLD, Group
from carom.worlds.prefab import MEMBERS, Prefabs
from carom.worlds.schema import group_type
from carom.worlds.source import Source
from carom.worlds.variables import Variables

MOST_MEMBERS = 20_000  # of all groups together: groups of groups of groups would fill the memory
DEEPEST = 16


def generators_of(source: Source, path: Path, words: Any) -> list[str]:
    """Return the generator that words state, if any; report a second one."""
    stated = [key for key in GENERATORS if getattr(words, key) is not None]
    for key in stated[1:]:
        source.report((*path, key), f"is stated beside {stated[0]}; state one of them")
    return stated[:1]


class Item(NamedTuple):
    """An entity of a world, or a crowd of copies of one: None where it was reported; its name is the whole one."""

    path: Path
    name: str | None
    words: Any
    group: Group


Filling = Callable[["Unfolding", Group], None]  # unfolds what a group holds
# The lowest and highest corners (3,), m, of the box around the colliders of entities; None where there is none.
Measure = Callable[[list[Item]], tuple[Floats, Floats] | None]


class Unfolding:
    """Turns entities and groups of a file into entities with words of their own."""

    def __init__(self, source: Source, prefabs: Prefabs, setting: Setting, measure: Measure) -> None:
        self.source, self.prefabs, self.setting, self.measure = source, prefabs, setting, measure
        self.items: list[Item] = []
        self.members = 0

    def unfold(self, path: Path, words: Any, outer: Variables | None = None, group: Group = WORLD) -> None:
        """Add an entity, or all of a group."""
        words, outer = self.prefabs.extended(path, words, outer)
        if isinstance(words, dict) and MEMBERS in words:
            self._unfold_group(path, words, outer, group)
            return
        name = words.get("name") if isinstance(words, dict) else None
        whole = group.prefix + name if isinstance(name, str) else None
        if whole is not None and group is not WORLD and len(whole) > NAME_LENGTH:
            self.source.report((*path, "name"), f"is too long in its group: {whole!r} exceeds {NAME_LENGTH} characters")
            words = None
        model = None if words is None else check_item(self.source, "entities", path, words)
        self.items.append(Item(path, whole, model, group))

    def _unfold_group(self, path: Path, words: dict[str, Any], outer: Variables, group: Group) -> None:
        written = self.source.locate((*path, MEMBERS))
        stated = words.pop(MEMBERS)
        name = words.get("name")
        if not isinstance(stated, list):
            refuse_form(self.source, (*path, MEMBERS), stated, list)
            stated = []
        frame = check(self.source, group_type(), words, path)
        if group.inside(written):
            self.source.report(path, "is a group that holds itself")
            frame = None
        if frame is None or self._too_many(path, len(stated), group):
            self.items.append(
                Item(path, name if isinstance(name, str) else None, None, group)
            )  # whoever names it or its members has said it already
            return
        members = frozenset(str(item["name"]) for item in stated if isinstance(item, dict) and "name" in item)

        def fill(unfolding: Unfolding, inner: Group) -> None:
            for number, member in enumerate(stated):
                unfolding.unfold((*written, number), member, outer, inner)

        for inner in self._copies(path, frame, Group("", members, written, outer=group), fill):
            fill(self, inner)

    def _copies(
        self, path: Path, frame: Any, group: Group, fill: Callable[[Unfolding, Group], None]
    ) -> Iterator[Group]:
        """Yield a group with its name and pose, or one for each copy that a generator makes of it."""
        outer = group.outer or WORLD
        position, rotation = np.array([frame.transform.position]), np.array([frame.transform.rotation])
        names = [frame.name]
        for key in generators_of(self.source, path, frame):
            setting = self.setting
            if GENERATORS[key].sized:
                turned = np.array(frame.transform.rotation)
                measured = self._measured(replace(group, prefix=f"{frame.name}.", rotation=turned), fill)
                if measured is None:  # told of those it holds, of which one is unfolded for that
                    self.items.append(Item(path, f"{outer.prefix}{frame.name}", None, outer))
                    break
                setting = measured
            try:
                made = getattr(frame, key).copies(setting)
            except DeclarationError as fault:
                self.source.report((*path, key), str(fault).removeprefix(f"{key}: "))
                return
            position, names = position + made.positions, made.names(frame.name)
            turns = np.array([quaternion.IDENTITY]) if made.rotations is None else made.rotations
            rotation = np.broadcast_to(quaternion.multiply(turns, rotation), (len(names), 4))
            if self._too_many(path, (len(names) - 1) * len(group.members), outer):
                return
        places, turned = outer.point(position), outer.turn(rotation)
        for name, place, turn in zip(names, places, turned, strict=True):
            yield replace(group, prefix=f"{outer.prefix}{name}.", position=place, rotation=turn)

    def _measured(self, group: Group, fill: Filling) -> Setting | None:
        """Return the setting of a group that is as large as all it holds; None where something is wrong with that."""
        source, told = self.source, (len(self.source.faults), len(self.source.warnings))
        trial = Unfolding(source, self.prefabs, self.setting._replace(draws=deepcopy(self.setting.draws)), self.measure)
        trial.members = self.members
        fill(trial, group)
        self.members = trial.members  # what is made to be measured counts, since groups in groups are measured again
        measured = self.measure(trial.items) if len(source.faults) == told[0] else None
        wrong = len(source.faults) > told[0]
        del source.faults[told[0] :], source.warnings[told[1] :]
        if wrong:
            return None
        if measured is None:
            return self.setting
        low, high = measured
        return self.setting._replace(edges=high - low, reach=float(np.linalg.norm(np.maximum(-low, high))))

    def _too_many(self, path: Path, count: int, group: Group) -> bool:
        self.members += count
        if self.members > MOST_MEMBERS:
            self.source.report(path, f"groups of a world may have {MOST_MEMBERS} entities in all")
        elif group.depth == DEEPEST:
            self.source.report(path, f"is a group in more than {DEEPEST} others, one in another")
        else:
            return False
        return True
