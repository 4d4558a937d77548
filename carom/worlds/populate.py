"""Entities of a world file into a simulation."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.ecs import Motion
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Component
from carom.ecs.components.joint import Joint
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.components.parent import Parent
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.assembly import Materials, bundles_of, shape_of
from carom.systems.compound import StatedBodies, joining, weigh
from carom.systems.layers import Layers
from carom.systems.parameters import WordFault
from carom.systems.particles.words import read_emitter
from carom.systems.paths import faults_of_path
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.worlds.connections import Connections
from carom.worlds.crowd import LONE, Some, add_together
from carom.worlds.errors import Path, ReportedError, WordError
from carom.worlds.generators import GENERATORS, Setting
from carom.worlds.geometry import GEOMETRY_WORDS, GeometryReader
from carom.worlds.groups import Group
from carom.worlds.laying import Laying
from carom.worlds.names import known, whole_of_copy
from carom.worlds.source import Source
from carom.worlds.unfold import Item, generators_of

SOURCES = ("file", "image", "points", "vertices", "heights")  # words that say where a geometry comes from
PROVISIONAL = {"mass": 1.0}
SUB_PATH = re.compile(r"([a-z_]+(?:\.[a-z_]+)*): (.*)", re.DOTALL)


class Populator:
    """Adds entities, reporting what is wrong with each where the file says it."""

    def __init__(self, source: Source, simulation: Simulation, geometries: GeometryReader, setting: Setting) -> None:
        self.source, self.simulation = source, simulation
        self.geometries, self.setting = geometries, setting
        self.taken: dict[str, Path] = {}
        self.places_in_file: dict[int, Path] = {}
        self.carriers: set[str] = set()
        self.before: tuple[dict[str, Any], list[Component]] = ({}, [])  # words and components of the last entity
        self.unweighed: list[int] = []  # bodies whose mass depends on what they carry
        self.laying = Laying(self)
        self.connections = Connections(source, simulation)

    def add_all(self, items: list[Item]) -> None:
        """Add the entities of a file in its order, those together that differ only in where they are and move."""
        stated = [(item, item.words.model_dump(exclude_unset=True)) for item in items if item.words is not None]
        parents = [(item.group, words["parent"].get("entity")) for item, words in stated if "parent" in words]
        carriers = [group.whole(name) for group, name in parents if name is not None]
        self.carriers = {*carriers, *map(whole_of_copy, carriers)}
        crowd: list[Some] = []
        for item, words in stated:
            if "chain" in words:  # its links are laid at once, after those before it
                self.spawn(crowd)
                crowd = []
            some = self.read(item, words)
            if some is None:
                continue
            if crowd and not crowd[0].joins(some):
                self.spawn(crowd)
                crowd = []
            crowd.append(some)
        self.spawn(crowd)

    def read(self, item: Item, words: dict[str, Any]) -> Some | None:
        """Return an entity, or the copies of it; None for a chain, which is laid at once, and for what is refused."""
        path, group = item.path, item.group
        for word in ("name", "parameters"):
            words.pop(word, None)
        if item.name is not None and item.name in self.taken:
            where = self.source.place(self.taken[item.name])
            what, received = "two entities of one name", f"{item.name!r}, also of {where}"
            self.source.report((*path, "name"), what, received=received)
            return None
        if item.name is not None:
            self.taken[item.name] = path
        copying = generators_of(self.source, path, item.words)
        for key in GENERATORS:
            words.pop(key, None)
        if not (self.names_hold(path, words) and self.path_holds(path, words, copying) and self.emits(path, words)):
            return None
        group.place(words)
        try:
            if "chain" in words:
                self.laying.add(path, item.name, words, group, copying)
                return None
            self.read_geometries(path, words)
            return self.placed(item, words, *copying)
        except ReportedError:
            return None
        except DeclarationError as fault:
            self.report(path, str(fault))
            return None

    def placed(self, item: Item, words: dict[str, Any], key: str | None = None) -> Some:
        """Return where an entity is, or each copy that a generator makes of it; raise DeclarationError."""
        transform, group = words.pop("transform", {}), item.group
        positions = np.array([transform.get("position", (0.0, 0.0, 0.0))], np.float64)
        names, rotations = None if item.name is None else [item.name], None
        jitter = transform.pop("jitter", None)
        if not any(word in words for word in LONE):
            rotations = np.array([transform.get("rotation", quaternion.IDENTITY)], np.float64)
        elif key is not None:
            raise DeclarationError("joint: all copies would hold the same; add them one by one")
        else:
            words["transform"] = transform
        if key is not None and rotations is not None:
            made = getattr(item.words, key).copies(self.setting_of(words.get("collider"), rotations[0], group))
            if made.note:
                self.source.warn((*item.path, key), made.note)
            positions = positions + group.direction(made.positions)
            rotations = group.turned(made.rotations, rotations, len(positions))
            names = None if item.name is None else made.names(item.name)
            if names and len(max(names, key=len)) > NAME_LENGTH:
                longest = max(names, key=len)
                raise DeclarationError(f"{key}: the name {longest!r} of a copy exceeds {NAME_LENGTH} characters")
        if jitter is not None:
            reach = np.broadcast_to(jitter, 3)
            positions = positions + self.setting.draws.uniform(-reach, reach, positions.shape)
        body = words.get("body")
        weight = None
        if body is not None and "mass" not in body and item.name in self.carriers:
            weight, words["body"] = body, body | PROVISIONAL
        pointers, joint = self.connections.take_pointers(item.path, words, group), words.get("joint")
        if joint is not None:
            words["joint"] = Joint()
        bundles = None if rotations is None else self.bundles(words)
        return Some(item.path, group, words, positions, names, rotations, bundles, pointers, joint, weight)

    def bundles(self, words: dict[str, Any]) -> list[Component]:
        """Return the components that words stand for, those of the entity before where only the motion is another."""
        world, still = self.simulation.world, {key: value for key, value in words.items() if key != "motion"}
        free = world[Settings].dimensions == 3 and "locked" not in words.get("body", ("locked",))
        if free and still == self.before[0]:
            motion = words.get("motion", {})
            return [Motion(**motion) if isinstance(part, Motion) else part for part in self.before[1]]
        made = bundles_of(world, **words)
        self.before = (still, made)
        return made

    def setting_of(self, collider: dict[str, Any] | None, rotation: Floats, group: Group) -> Setting:
        """Return what copies are made in, with how large each is along the axes of the group."""
        if collider is None:
            return self.setting
        bounds = shape_of(collider).bounds()
        if not np.isfinite(bounds.half).all():
            return self.setting
        turn = group.back(rotation)
        own = collider.get("rotation", quaternion.IDENTITY)
        center = np.asarray(collider.get("position", (0.0, 0.0, 0.0))) + quaternion.rotate(own, bounds.center)
        turned = np.abs(quaternion.matrix(quaternion.multiply(turn, own)))
        half = (turned * np.asarray(bounds.half)).sum(axis=1) + bounds.radius + np.abs(quaternion.rotate(turn, center))
        reach = float(np.linalg.norm(center) + np.linalg.norm(bounds.half)) + bounds.radius
        return self.setting._replace(half=half, reach=reach)

    def spawn(self, crowd: list[Some]) -> None:
        """Add entities that are alike; where they are refused, one by one, to report whom."""
        if not crowd:
            return
        try:
            entities = add_together(self.simulation, crowd)
        except DeclarationError as fault:
            if len(crowd) == 1:
                self.report(crowd[0].path, str(fault))
            else:
                for some in crowd:
                    self.spawn([some])
            return
        ends = np.cumsum([len(some.positions) for some in crowd])
        for some, made in zip(crowd, np.split(entities, ends[:-1]), strict=True):
            self.places_in_file.update(dict.fromkeys(made.tolist(), some.path))
            self.connections.add(made, some)
            if some.weight is not None:
                self.simulation.world[StatedBodies].words.update(dict.fromkeys(made.tolist(), some.weight))
                self.unweighed += made.tolist()

    def weigh_all(self) -> None:
        """Let bodies weigh what they carry, now that it is known; report what cannot be carried by a body."""
        world = self.simulation.world
        bodies = world.slots.rows(np.array(self.unweighed, np.int64))
        joined = self.each(world.row_numbers(Parent), lambda rows: joining(world, rows))
        if joined is not None:
            self.each(np.union1d(bodies, joined), lambda rows: weigh(world, rows))

    def join_all(self) -> None:
        """Let joints and the links of chains hold each other, at the poses where all are now."""
        self.laying.join_all()
        self.connections.join_all()

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

    def path_holds(self, path: Path, words: dict[str, Any], copying: list[str]) -> bool:
        """Report everything that is wrong with keyframes."""
        if "keyframes" not in words:
            return True
        faults = list(faults_of_path(words))
        for key in copying:
            faults.append(WordFault((key,), f"all copies would go the same way; remove {key} or keyframes"))
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
                if self.source.written(place) or steps[0] in ("body", "motion", "collider", "visual", *GENERATORS):
                    self.source.report(place, found[2])
                    return
        place = (*path, "collider") if message.startswith("state exactly one shape") else path
        self.source.report(place, message)
