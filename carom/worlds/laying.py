"""Laying: chains of a world file, links first and then, when everybody is there, the joints between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.ecs.column import Integers
from carom.ecs.errors import DeclarationError
from carom.systems.chains import BALL, Course, capsule_along, hung, join_links, lay_links, refuse_lines
from carom.systems.chains import WORLD as THE_WORLD
from carom.worlds.errors import Path, ReportedError, WordError
from carom.worlds.groups import Group
from carom.worlds.names import known
from carom.worlds.sections import NOBODY, WORLD

if TYPE_CHECKING:
    from carom.worlds.intake import Intake

BESIDE = ("keyframes", "parent")  # words that say in other ways where copies are


class Laid(NamedTuple):
    """A chain whose links are there."""

    path: Path
    name: str
    course: Course
    links: Integers
    joint: Any
    ends: tuple[str, ...]


class Laying:
    """Lays chains, reporting what is wrong with each where the file says it."""

    def __init__(self, intake: Intake) -> None:
        self.intake, self.laid = intake, list[Laid]()

    def add(self, path: Path, name: str | None, words: dict[str, Any], group: Group, copying: list[str]) -> None:
        """Add the links of a chain of a group; ``copying`` are the generators it states beside."""
        intake, chain, transform = self.intake, words.pop("chain"), words.pop("transform", {})
        joint = words.pop("joint", BALL)
        surplus = copying + [word for word in BESIDE if word in words]
        surplus += [f"transform.{key}" for key in transform if key != "position"]
        if name is None:
            intake.source.report((*path, "chain"), "has no name, after which its links are called; state name")
            return
        if surplus:
            intake.source.report((*path, "chain"), f"says where its links are; remove {', '.join(surplus)}")
            return
        start = np.array(transform.get("position", (0.0, 0.0, 0.0)), np.float64)
        try:
            course = hung(intake.simulation, start, np.array(chain["end"]), chain["count"], chain.get("sag", 0.0))
            if "collider" not in words:
                words["collider"] = capsule_along(course, chain.get("radius"))
        except DeclarationError as fault:
            intake.report((*path, "chain"), str(fault))
            return
        try:
            refuse_lines(joint)
            intake.read_geometries(path, words)
            links = lay_links(intake.simulation, name, course, **words)
        except ReportedError:
            return
        except DeclarationError as fault:
            intake.report(path, str(fault))
            return
        intake.places_in_file.update(dict.fromkeys(links.tolist(), path))
        ends = chain.get("a", WORLD), chain.get("b", NOBODY)
        self.laid.append(Laid(path, name, course, links, joint, tuple(map(group.whole, ends))))

    def join_all(self) -> None:
        """Join the links of all chains, and their ends to whom they name."""
        source, simulation = self.intake.source, self.intake.simulation
        names = [WORLD, NOBODY, *simulation.world.names()]
        for laid in self.laid:
            held: list[str | int | None] = []
            for side, whom in zip("ab", laid.ends, strict=True):
                try:
                    found = known("entity", whom, names)
                    held.append({WORLD: THE_WORLD, NOBODY: None}.get(found, found))
                except WordError as fault:
                    source.report_value((*laid.path, "chain", side), fault)
            if len(held) < 2:
                continue
            try:
                join_links(simulation, laid.name, laid.course, laid.links, laid.joint, *held)
            except DeclarationError as fault:
                self.intake.report(laid.path, str(fault))
