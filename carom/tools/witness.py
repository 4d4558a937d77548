"""Witness: the observer that looks at pictures for what a world expects of them."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import ExitStack

from carom.ecs import Entity
from carom.systems.simulation import Simulation
from carom.tools.filming import shot_of
from carom.tools.offscreen import GraphicsError
from carom.tools.questions import Sight
from carom.worlds.builder import LoadedWorld
from carom.worlds.pictures import Pictures


class Witness:
    """Answers the questions that expectations ask of pictures; begin it before them and end it after them.

    Where no picture can be drawn, every expectation that asks for one fails and says why.
    """

    def __init__(self, loaded: LoadedWorld) -> None:
        self._loaded = loaded
        self._sights: dict[str | None, Sight] = {}
        self._closing = ExitStack()

    def begin(self, simulation: Simulation) -> None:
        """Make what draws, where anything is asked."""
        pictures = simulation.world[Pictures]
        pictures.answer = self.answer
        try:
            for camera in pictures.asked:
                shot = shot_of(self._loaded, camera)
                self._sights[camera] = self._closing.enter_context(Sight(simulation, shot))
        except GraphicsError as fault:
            for expectation in self._loaded.expectations:
                if expectation.looks:
                    expectation.fail(simulation, f"no picture: {fault}")

    def observe(self, simulation: Simulation) -> None:
        """Wait until something is asked."""

    def end(self, simulation: Simulation) -> None:
        """Free what was drawn with."""
        simulation.world[Pictures].answer = None
        self._closing.close()

    def answer(self, question: str, entities: Iterable[Entity], camera: str | None) -> float:
        """Return the answer to a question by a camera; not a number where no picture can be drawn."""
        sight = self._sights.get(camera)
        return float("nan") if sight is None else float(getattr(sight, question)(*entities))
