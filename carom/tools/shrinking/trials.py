"""Trials: whether the same expectation fails in a changed world, in the same manner."""

from __future__ import annotations

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


class Found(NamedTuple):
    """A world in which the same fails, as data and as it was then."""

    tree: dict[str, Any]
    loaded: LoadedWorld
    failed: Expectation


class Trials:
    """Tries worlds as data, at most ``most``, each once; ``left`` is how many may still be tried."""

    def __init__(self, failed: Expectation, name: str, folder: Path, most: int, check: Callable[[], None]) -> None:
        self.failed, self.left, self.made = failed, most, 0
        self._name, self._folder, self._check = name, folder, check
        self._known: set[str] = set()

    def attempt(self, tree: dict[str, Any]) -> Found | None:
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
        judged = [
            one for one in loaded.expectations if (one.text, one.expected) == (self.failed.text, self.failed.expected)
        ]
        with suppress(NonFiniteError):  # what failed before has failed
            watch(loaded, judged, self._check)
        failed = next((one for one in judged if one.fails_like(self.failed)), None)
        if failed is None or failed.failure is None:
            return None
        if failed.worst:  # of what never came, any shorter run would tell the same
            tree = tree | {"run": {"frames": max(failed.failure[1], 1)}}
        return Found(tree, loaded, failed)

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
