"""Entities of a world file into a simulation."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.component import Component
from carom.ecs.components.joint import Joint
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.components.parent import Parent
from carom.ecs.errors import DeclarationError
from carom.systems.assembly import Materials
from carom.systems.compound import StatedBodies, joining, weigh
from carom.systems.joints.stating import read_joint
from carom.systems.layers import Layers
from carom.systems.own_components import components_of_files
from carom.systems.parameters import WordFault
from carom.systems.particles.words import read_emitter
from carom.systems.paths import faults_of_path
from carom.systems.settings import Random
from carom.systems.simulation import Simulation
from carom.worlds.errors import Path, ReportedError, WordError
from carom.worlds.generated import holds_entities
from carom.worlds.geometry import GEOMETRY_WORDS, GeometryReader
from carom.worlds.laying import Laying
from carom.worlds.names import known
from carom.worlds.source import Source

SOURCES = ("file", "image", "points", "heights")  # words that say where a geometry comes from
PROVISIONAL = {"mass": 1.0}
SUB_PATH = re.compile(r"([a-z_]+(?:\.[a-z_]+)*): (.*)", re.DOTALL)


class Pointer(NamedTuple):
    """A column that holds entities, with the names the file states for it there."""

    path: Path
    kind: type[Component]
    column: str
    names: Any


class Populator:
    """Adds entities, reporting what is wrong with each where the file says it."""

    def __init__(self, source: Source, simulation: Simulation, geometries: GeometryReader) -> None:
        self.source, self.simulation = source, simulation
        self.geometries = geometries
        self.taken: dict[str, Path] = {}
        self.pointers: list[tuple[Integers, Pointer]] = []
        self.places_in_file: dict[int, Path] = {}
        self.carriers: set[str] = set()
        self.unweighed: list[int] = []  # bodies whose mass depends on what they carry
        self.laying = Laying(self)
        self.joints: list[tuple[int, Path, dict[str, Any]]] = []

    def add_all(self, entities: list[Any]) -> None:
        """Add the entities of a file in its order; None stands for one already reported."""
        stated = [None if model is None else model.model_dump(exclude_unset=True) for model in entities]
        parents = [words.get("parent", {}).get("entity") for words in stated if words is not None]
        self.carriers = {name.partition("[")[0] for name in parents if name is not None}
        for index, words in enumerate(stated):
            if words is not None:
                self.add(("entities", index), words)

    def add(self, path: Path, words: dict[str, Any]) -> None:
        """Add one entity, or the copies of its grid."""
        grid = words.pop("grid", None)
        name = words.pop("name", None)
        if name is not None and name in self.taken:
            where = self.source.place(self.taken[name])
            self.source.report((*path, "name"), "two entities of one name", received=f"{name!r}, also of {where}")
            return
        if name is not None:
            self.taken[name] = path
        if not (self.names_hold(path, words) and self.path_holds(path, words, grid) and self.emits(path, words)):
            return
        if "chain" in words:
            self.laying.add(path, name, words)
            return
        transform = words.pop("transform", {})
        jitter = transform.pop("jitter", None)
        pointers = self.take_pointers(path, words)
        joint = words.get("joint")
        if joint is not None:
            words["joint"] = Joint()
        body = words.get("body")
        waits = name in self.carriers and body is not None and "mass" not in body
        if body is not None and waits:
            words["body"] = body | PROVISIONAL
        try:
            self.read_geometries(path, words)
            positions = self.places(name, grid, np.array(transform.get("position", (0.0, 0.0, 0.0))))
            if jitter is not None:
                reach = np.broadcast_to(jitter, 3)
                positions = positions + self.simulation.world[Random].generator.uniform(-reach, reach, positions.shape)
            names = None if name is None else copies(name, grid)
            entities = self.simulation.add_many(positions, names=names, transform=transform, **words)
            self.pointers += [(entities, pointer) for pointer in pointers]
            self.places_in_file.update(dict.fromkeys(entities.tolist(), path))
            if joint is not None:
                self.joints.append((int(entities[0]), path, joint))
            if waits:
                self.simulation.world[StatedBodies].words.update(dict.fromkeys(entities.tolist(), body))
                self.unweighed += entities.tolist()
        except ReportedError:
            return
        except DeclarationError as fault:
            self.report(path, str(fault))

    def take_pointers(self, path: Path, words: dict[str, Any]) -> list[Pointer]:
        """Take out what names other entities, which may come later in the file."""
        own = components_of_files()
        return [
            Pointer((*path, key, name), own[key], name, words[key].pop(name))
            for key in own
            if key in words
            for name in words[key].copy()
            if holds_entities(own[key].columns[name])
        ]

    def point_all(self) -> None:
        """Let columns hold the entities the file names, now that all are there; report unknown names."""
        world = self.simulation.world
        names = world.names()
        for entities, pointer in self.pointers:
            column = pointer.kind.columns[pointer.column]
            try:
                found = [world.find(known("entity", str(name), names)) for name in np.ravel(pointer.names)]
            except WordError as fault:
                self.source.report_value(pointer.path, fault)
                continue
            with world.edit(pointer.kind) as table:
                getattr(table, pointer.column)[world.slots.rows(entities)] = np.reshape(found, column.shape)

    def weigh_all(self) -> None:
        """Let bodies weigh what they carry, now that it is known; report what cannot be carried by a body."""
        world = self.simulation.world
        bodies = world.slots.rows(np.array(self.unweighed, np.int64))
        joined = self.each(world.row_numbers(Parent), lambda rows: joining(world, rows))
        if joined is not None:
            self.each(np.union1d(bodies, joined), lambda rows: weigh(world, rows))

    def join_all(self) -> None:
        """Let joints hold whom they name, at the poses where all are now; report everything that is wrong with them."""
        self.laying.join_all()
        world = self.simulation.world
        for entity, path, words in self.joints:
            faults: list[WordFault] = []
            made = read_joint(world, words, faults)
            for fault in faults:
                self.source.report_value((*path, *fault.steps), fault)
            if made is not None:
                with world.edit(Joint) as table:
                    for name, value in vars(made).items():
                        getattr(table, name)[world.row(entity)] = value

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
                self.report(self.places_in_file[self.simulation.world.entity(row)], str(fault))
        return None

    def places(self, name: str | None, grid: dict[str, Any] | None, position: Floats) -> Floats:
        """Return the position of each copy (n, 3)."""
        if grid is None:
            return position[None]
        longest = f"{name}[{','.join(str(count - 1) for count in grid['count'])}]"
        if name is not None and len(longest) > NAME_LENGTH:
            raise DeclarationError(f"grid: the name {longest!r} of its last copy exceeds {NAME_LENGTH} characters")
        steps = np.indices(grid["count"]).reshape(3, -1).T
        return np.asarray(position + np.array(grid.get("origin", (0.0, 0.0, 0.0))) + steps * grid["spacing"])

    def read_geometries(self, path: Path, words: dict[str, Any]) -> None:
        """Put shapes in the place of the words of meshes and hulls of an entity."""
        for key in ("collider", "visual"):
            if isinstance(words.get(key), dict):
                self.read_geometry((*path, key), words[key])

    def read_geometry(self, path: Path, words: dict[str, Any]) -> None:
        """Put shapes in the place of the words of meshes and hulls; report files that cannot be used."""
        for key in GEOMETRY_WORDS:
            if key in words:
                place = next(word for word in SOURCES if word in words[key])
                written_in, _ = self.source.home(self.source.locate((*path, key, place)))
                try:
                    words[key] = self.geometries.shape(
                        key, words[key], folder=written_in.folder, seen=path[-1] == "visual"
                    )
                except DeclarationError as fault:
                    self.source.report((*path, key, place), str(fault))
                    raise ReportedError from None
                for note in words[key].geometry.notes:
                    self.source.warn((*path, key, place), note)

    def names_hold(self, path: Path, words: dict[str, Any]) -> bool:
        """Report names of materials and layers that nothing defines."""
        layers, materials = self.simulation.world[Layers].bits, self.simulation.world[Materials].named
        collider = words.get("collider", {})
        uses: list[tuple[Path, str, str, Any]] = []
        if isinstance(words.get("material"), str):
            uses.append((("material",), "material", words["material"], materials))
        if "layer" in collider:
            uses.append((("collider", "layer"), "layer", collider["layer"], layers))
        for number, name in enumerate(collider.get("collides_with", ())):
            uses.append((("collider", "collides_with", number), "layer", name, layers))
        if "on_enter" in collider:
            uses.append((("collider", "on_enter", "layer"), "layer", collider["on_enter"]["layer"], layers))
        held = True
        for place, kind, name, choices in uses:
            try:
                known(kind, name, choices)
            except WordError as fault:
                self.source.report_value((*path, *place), fault)
                held = False
        return held

    def path_holds(self, path: Path, words: dict[str, Any], grid: Any) -> bool:
        """Report everything that is wrong with keyframes."""
        if "keyframes" not in words:
            return True
        faults = list(faults_of_path(words))
        if grid is not None:
            faults.append(WordFault(("grid",), "all copies would go the same way; remove grid or keyframes"))
        for fault in faults:
            self.source.report((*path, *fault.steps), fault.what, received=fault.received)
        return not faults

    def emits(self, path: Path, words: dict[str, Any]) -> bool:
        """Put an emitter in the place of its words; report everything that is wrong with them."""
        faults: list[WordFault] = []
        if "emitter" in words:
            words["emitter"] = read_emitter(words["emitter"], faults)
        for fault in faults:
            self.source.report_value((*path, *fault.steps), fault)
        return not faults

    def report(self, path: Path, message: str) -> None:
        """Report what assembly says, at the words it names when they are in the file."""
        found = SUB_PATH.fullmatch(message)
        if found is not None:
            steps = tuple(found[1].split("."))
            for place in ((*path, *steps), (*path, "collider", *steps)):
                if self.source.written(place) or steps[0] in ("body", "motion", "collider", "visual", "grid"):
                    self.source.report(place, found[2])
                    return
        place = (*path, "collider") if message.startswith("state exactly one shape") else path
        self.source.report(place, message)


def copies(name: str, grid: dict[str, Any] | None) -> list[str]:
    """Return the name of each copy in the order of their places."""
    if grid is None:
        return [name]
    return [f"{name}[{i},{j},{k}]" for i, j, k in product(*map(range, grid["count"]))]
