"""Intake: the words of an entity held against its world, and where it is, or each copy that a generator makes of it."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.components.joint import Joint
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.shapes.stating import shape_of
from carom.systems.simulation import Simulation
from carom.worlds.connections import Connections
from carom.worlds.crowd import LONE, Some
from carom.worlds.entity_faults import faults_of
from carom.worlds.errors import Path, ReportedError
from carom.worlds.generators import GENERATORS, Setting
from carom.worlds.geometry import GEOMETRY_WORDS, GeometryReader
from carom.worlds.groups import Group
from carom.worlds.laying import Laying
from carom.worlds.source import Source
from carom.worlds.unfold import Item, generators_of

SOURCES = ("file", "image", "points", "vertices", "heights", "noise")  # words that say where a geometry comes from
PROVISIONAL = {"mass": 1.0}
SUB_PATH = re.compile(r"([a-z_]+(?:\.[a-z_]+)*): (.*)", re.DOTALL)


class Intake:
    """Reads entities, reporting what is wrong with each where the file says it."""

    def __init__(self, source: Source, simulation: Simulation, geometries: GeometryReader, setting: Setting) -> None:
        self.source, self.simulation = source, simulation
        self.geometries, self.setting = geometries, setting
        self.taken: dict[str, Path] = {}
        self.places_in_file: dict[int, Path] = {}
        self.carriers: set[str] = set()  # names of bodies whose mass depends on what they carry
        self.laying = Laying(self)
        self.connections = Connections(source, simulation)

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
        faults = list(faults_of(self.simulation.world, words, copying))
        for fault in faults:
            self.source.report_value((*path, *fault.steps), fault)
        if faults:
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
        return Some(item.path, group, words, positions, names, rotations, pointers, joint, weight)

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
        edges = 2.0 * ((turned * np.asarray(bounds.half)).sum(axis=1) + bounds.radius)
        reach = float(np.linalg.norm(center) + np.linalg.norm(bounds.half)) + bounds.radius
        return self.setting._replace(edges=edges, reach=reach)

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
                    self.source.report((*path, key, place), str(fault).removeprefix(f"{place}: "))
                    raise ReportedError from None
                for note in words[key].geometry.notes:
                    self.source.warn((*path, key, place), note)

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
