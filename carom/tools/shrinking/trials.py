"""Trials: whether the same expectation fails in a changed world, in the same manner."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.errors import CaromError, NonFiniteError
from carom.tools.look import look_of
from carom.tools.shrinking.tree import Edit, edited, owner
from carom.tools.witness import Witness
from carom.worlds.builder import LoadedWorld, load_text
from carom.worlds.emit import emit
from carom.worlds.errors import WorldError
from carom.worlds.expect import Expectation

MOST_MENDS = 8  # rounds in which those go who name who is gone
NUMBERS = re.compile(r"\[[\d,]+\]|(?<![\w.-])(?:[-+]?\d[\d.]*(?:e[-+]?\d+)?|nan|-?inf)")


class Failure(NamedTuple):
    """What fails: the words of an expectation, and the manner: what it received, but for numbers and those of copies.

    Another two that overlap, or a strike that never comes where one came at a wrong time, are another manner.
    """

    text: str
    expected: str
    manner: str

    @classmethod
    def of(cls, expectation: Expectation) -> Failure:
        """Return that of an expectation, which has failed."""
        assert expectation.failure is not None
        return cls(expectation.text, expectation.expected, NUMBERS.sub("", expectation.failure[0]))

    def expectations(self, loaded: LoadedWorld) -> list[Expectation]:
        """Return the expectations of a world that say the same."""
        return [one for one in loaded.expectations if (one.text, one.expected) == (self.text, self.expected)]


def watch(loaded: LoadedWorld, expectations: list[Expectation], check: Callable[[], None]) -> None:
    """Run a world until all of some expectations are settled, or to its end.

    Raises NonFiniteError for a number that is none; then nothing is judged that looks only in the end.
    """
    simulation = loaded.simulation
    simulation.observers = [Witness(loaded), *expectations]
    with np.errstate(all="ignore"), ExitStack() as ending:
        for observer in simulation.observers:
            ending.callback(observer.end, simulation)
            observer.begin(simulation)
        try:
            while not (all(one.settled for one in expectations) or loaded.run.finished(simulation)):
                simulation.step()
                check()
        except NonFiniteError:
            ending.pop_all()
            simulation.observers[0].end(simulation)
            raise


class Trials:
    """Tries worlds as data, at most ``most``, each once; ``left`` is how many may still be tried."""

    def __init__(self, failure: Failure, name: str, folder: Path, most: int, check: Callable[[], None]) -> None:
        self.failure, self.left, self.made = failure, most, 0
        self._name, self._folder, self._check = name, folder, check
        self._known: set[str] = set()

    def attempt(self, tree: dict[str, Any]) -> tuple[dict[str, Any], LoadedWorld] | None:
        """Return a world in which the same fails, with the shortest run in which it does; None where it does not.

        It is what was asked for without those who name who is not there.
        """
        if not self.left or emit(tree) in self._known:
            return None
        self._known.add(emit(tree))
        self.left, self.made = self.left - 1, self.made + 1
        mended = self._mended(tree)
        if mended is None:
            return None
        tree, loaded = mended
        judged = self.failure.expectations(loaded)
        with suppress(NonFiniteError):  # what failed before has failed
            watch(loaded, judged, self._check)
        failed = [one.failure for one in judged if one.failure is not None and Failure.of(one) == self.failure]
        if not failed:
            return None
        frame = min(frame for _, frame, _ in failed)
        at_the_end = not all(one.worst for one in judged)
        return (tree if at_the_end else tree | {"run": {"frames": max(frame, 1)}}), loaded

    def _mended(self, tree: dict[str, Any]) -> tuple[dict[str, Any], LoadedWorld] | None:
        for _ in range(MOST_MENDS):
            try:
                loaded = load_text(emit(tree), self._name, self._folder)
                look_of(loaded)
                return tree, loaded
            except WorldError as error:
                gone = {owner(tree, fault.path) if fault.file == self._name else None for fault in error.faults}
            except CaromError:
                return None
            edits = [Edit(path) for path in gone if path is not None]
            if len(edits) < len(gone):
                return None
            tree = edited(tree, edits)
            if emit(tree) in self._known:
                return None
        return None
