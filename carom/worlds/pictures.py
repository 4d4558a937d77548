"""Pictures: what expectations can ask of what a camera shows. Whoever can draw answers; here nothing is drawn."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Protocol

from carom.ecs import Entity, Visual, World
from carom.ecs.component import Resource
from carom.ecs.errors import CaromError
from carom.systems.compound import bodies_of
from carom.worlds.comers import comers, kinds_of
from carom.worlds.errors import WordError
from carom.worlds.names import known


class Question(NamedTuple):
    """What a question is about: so many entities; the unit of its answer."""

    entities: int
    unit: str


QUESTIONS = {
    "visible": Question(1, "px"),
    "visible_share": Question(1, "1"),
    "overlap": Question(2, "px"),
    "left_of": Question(2, "1"),
    "above": Question(2, "1"),
}


class Answer(Protocol):
    """Answers a question on entities by a camera, None for the world's own choice."""

    def __call__(self, question: str, entities: Iterable[Entity], camera: str | None) -> float:
        """Return the answer in the question's unit."""


class Pictures(Resource):
    """The cameras of a world, those that expectations ask for, and who answers."""

    def __init__(self, cameras: Iterable[str] = ()) -> None:
        self.cameras = tuple(cameras)
        self.asked: list[str | None] = []
        self.answer: Answer | None = None

    def ask(self, question: str, entities: Iterable[Entity], camera: str | None) -> float:
        """Return an answer; raise CaromError where nobody draws."""
        if self.answer is None:
            raise CaromError(
                f"{question}(...) is asked of a picture, and nobody draws here; run the world by carom test or carom "
                "run, or let a carom.tools.witness.Witness observe it before its expectations do"
            )
        return self.answer(question, entities, camera)


def read_camera(world: World, name: str | None) -> None:
    """Note that expectations ask for pictures by a camera; raise WordError for one the world does not have."""
    if Pictures not in world:
        world.add(Pictures())
    pictures = world[Pictures]
    if name is not None:
        known("camera", name, pictures.cameras)
    if name not in pictures.asked:
        pictures.asked.append(name)


def check_drawn(world: World, names: Iterable[str]) -> None:
    """Raise WordError for an entity of which nothing is drawn, now or once it comes."""
    coming, rows = comers(world), world.row_numbers(Visual)
    seen = {*rows.tolist(), *bodies_of(world)[rows].tolist()}
    for name in names:
        entity = world.names_now().entities.get(name)
        if not (Visual in kinds_of(name, world, coming) or (entity is not None and world.row(entity) in seen)):
            raise WordError(f"nothing is drawn of {name}", accepted="an entity with a collider or a visual")
