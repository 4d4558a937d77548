"""A model in carom's axes as the words of a world file."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.components.name import NAME_LENGTH
from carom.worlds.importing.elements import Element
from carom.worlds.importing.jointing import joint_words
from carom.worlds.importing.looks import Looks, inside, pose_words
from carom.worlds.importing.masses import LIGHTEST, SMALLEST, body_words, joined, placed
from carom.worlds.importing.meshes import Meshes
from carom.worlds.importing.model import Connection, Inertia, Link, Model, Piece

UNNAMED = re.compile(r"[^\w-]+")
NEXT_TO_NOTHING = Inertia(LIGHTEST, np.zeros(3), np.eye(3) * LIGHTEST * SMALLEST**2)
STEP_OF_CHAIN = 0.01  # share of a body's mass that links between the joints it has beside each other get


class Document:
    """The world of a model: ``words`` are its sections, ``origins`` says of each entity where the file states it."""

    def __init__(
        self, model: Model, meshes: Meshes, touching: str, cut: Callable[[Path], list[Path]] | None = None
    ) -> None:
        self.model, self.looks = model, Looks(meshes, touching, model.report, cut)
        self.report = model.report
        self.links = {link.name: link for link in model.links if not link.lone}
        self.taken: set[str] = set()
        self.entities: list[dict[str, Any]] = []
        self.origins: list[Element] = []
        self.names = {name: self.name(name, link.element) for name, link in self.links.items()}
        self.masses = self.weighed()
        for link in model.links:
            self.add_link(link)
        for connection in model.connections:
            self.connect(connection)

    @property
    def words(self) -> dict[str, Any]:
        """Return the sections of the world but for its header."""
        model = self.model
        words: dict[str, Any] = {"name": model.title} if model.title else {}
        words |= {} if model.gravity is None else {"gravity": model.gravity}
        words |= {} if model.timestep is None else {"step": {"dt": model.timestep}}
        words |= {"layers": model.layers} if model.layers else {}
        words["entities"] = self.entities
        cameras = {worded(name): camera for name, camera in model.cameras.items()}
        return words | ({"cameras": cameras} if cameras else {})

    def name(self, stated: str, element: Element, ending: str = "") -> str:
        """Return a name that world files take and that nothing else has, with an ending or a number where it must."""
        name = worded(stated)
        name = f"{name}{ending}" if name in self.taken else name
        free, number = name, 1
        while free in self.taken:
            number += 1
            free = f"{name}-{number}"
        self.taken.add(free)
        if free != stated:
            self.report.approximate(element, f"a name, now {free}", stated)
        return free

    def weighed(self) -> dict[str, Inertia]:
        """Return the inertia of each body, with all that it carries."""
        parts: dict[str, list[Inertia]] = {}
        for link in self.model.links:
            carrier = link
            while carrier.carried is not None:
                carrier = self.links[carrier.carried]
            if link.inertia is not None and not carrier.static:
                parts.setdefault(carrier.name, []).append(placed(link.inertia, inside(carrier.pose, link.pose)))
        return {name: joined(found) for name, found in parts.items()}

    def add(self, element: Element, **words: Any) -> None:
        """Add an entity with the words that say something."""
        self.entities.append({key: value for key, value in words.items() if value is not None})
        self.origins.append(element)

    def add_link(self, link: Link) -> None:
        """Add a link: as one entity where it has a shape to touch and one to be seen, else with a part for each."""
        name = self.name(link.name, link.element) if link.lone else self.names[link.name]
        pieces = self.looks.pieces(link.pieces)
        touching = [piece for piece in pieces if piece.touches]
        seen = [piece for piece in pieces if piece.seen and not piece.touches]
        whole = len(touching) <= 1 and len(seen) <= 1
        words: dict[str, Any] = {"name": name}
        if link.carried is None or link.static:
            words["transform"] = pose_words(link.pose) or None
        else:
            place = pose_words(inside(self.links[link.carried].pose, link.pose))
            words["parent"] = {"entity": self.names[link.carried], **place}
        if link.carried is None and not link.static:
            words["body"] = self.body(link)
        moves = not link.static
        if whole:
            self.add(link.element, **words, **self.looks.words([*touching, *seen], moves))
            return
        self.add(link.element, **words)
        for piece in [*touching, *seen]:
            shape = self.looks.words([piece], moves)
            pose = pose_words(piece.pose) if piece.kind != "plane" else {}
            for key in ("collider", "visual"):
                if isinstance(shape.get(key), dict):
                    shape[key] = {k: v for k, v in shape[key].items() if k not in ("position", "rotation")} or None
            if shape:
                part = self.name_of_part(name, piece)
                self.add(piece.element, name=part, parent={"entity": name, **pose}, **shape)

    def name_of_part(self, link: str, piece: Piece) -> str:
        """Return a name for a shape of a link: its own, or the link's with a number."""
        stated, number = piece.element.attributes.get("name", ""), 0
        free = worded(stated)
        while not stated or free in self.taken:
            number += 1
            stated = free = f"{link[: NAME_LENGTH - 4]}-{number}"
        self.taken.add(free)
        return free

    def body(self, link: Link) -> dict[str, Any]:
        """Return the words of a body; one without mass gets the least that lets it move."""
        inertia = self.masses.get(link.name)
        if inertia is None:
            inertia = NEXT_TO_NOTHING
            self.report.approximate(link.element, f"a body without mass, now {LIGHTEST:g} kg", link.name)
        words, raised = body_words(inertia)
        if raised:
            self.report.approximate(link.element, "moments of inertia of almost nothing, now of 1 mm", link.name)
        self.report.keep("body")
        return words | ({"gravity_scale": link.gravity_scale} if link.gravity_scale != 1.0 else {})

    def connect(self, connection: Connection) -> None:
        """Add a joint, or several in a row where none has all its freedoms."""
        words, element = joint_words(connection), connection.element
        if words is None:
            self.connect_in_a_row(connection)
            return
        ends = {key: self.names[name] for key, name in (("a", connection.a), ("b", connection.b)) if name}
        ((kind, stated),) = words.items()
        self.add(element, name=self.name(connection.name, element, "-joint"), joint={kind: ends | stated})

    def connect_in_a_row(self, connection: Connection) -> None:
        """Add a joint for each freedom, with light links between; the first and the last still do not touch."""
        link, element = self.links[connection.b], connection.element
        self.report.approximate(element, "joints beside each other, now with light links between", connection.name)
        if connection.a is not None:
            at, name = link.pose.position, f"{connection.name}-apart"
            self.connect(Connection(element, name, connection.a, connection.b, at=at, apart=True))
        whole = self.masses.get(link.name, NEXT_TO_NOTHING)
        light = Inertia(STEP_OF_CHAIN * whole.mass, np.zeros(3), STEP_OF_CHAIN * whole.tensor)
        ahead = None if connection.a is None else self.names[connection.a]
        for number, freedom in enumerate(connection.freedoms, 1):
            behind, name = self.names[link.name], connection.name
            if number < len(connection.freedoms):
                behind, name = self.name(f"{behind}-{number}", element), f"{name}-{number}"
                self.add(element, name=behind, transform=pose_words(link.pose), body=body_words(light)[0])
            single = joint_words(Connection(element, name, None, "", [freedom])) or {}
            ((kind, stated),) = single.items()
            ends = {key: end for key, end in (("a", ahead), ("b", behind)) if end is not None}
            self.add(element, name=self.name(name, element, "-joint"), joint={kind: ends | stated})
            ahead = behind


def worded(stated: str) -> str:
    """Return a name in the letters that names have, with room for an ending."""
    name = UNNAMED.sub("_", stated)
    return (name if name[:1].isalpha() or name[:1] == "_" else f"_{name}")[: NAME_LENGTH - 10]
