"""Shrink: delta debugging of a world file.

A. Zeller and R. Hildebrandt, Simplifying and Isolating Failure-Inducing Input, IEEE Transactions on Software
Engineering 28, 183 (2002), level by level of the tree: G. Misherghi and Z. Su, HDD, ICSE 2006.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from carom.ecs.errors import CaromError, NonFiniteError
from carom.tools.interrupt import deferred_interrupt
from carom.tools.session import progress_bar
from carom.tools.shrinking.tree import Edit, edited, leaves, lower_counts, nodes, shorter_numbers
from carom.tools.shrinking.trials import Trials, watch
from carom.worlds import library
from carom.worlds.builder import LoadedWorld, load_world
from carom.worlds.emit import emit
from carom.worlds.header import VERSION
from carom.worlds.reader import read

DEEPEST = 12  # levels of a file that are looked at
DIGITS = (0, 1, 2, 3)  # that numbers are tried with
Propose = Callable[[dict[str, Any]], list[Edit]]


@dataclass
class Size:
    """How large a world is: what exists in it, values in its file, and frames of its run."""

    entities: int
    words: int
    frames: int


@dataclass
class Shrunk:
    """A world made smaller: the ``outcome`` of its expectation, which is number ``expectation`` of the whole one."""

    world: str
    out: str
    expectation: int
    outcome: str
    before: Size
    after: Size
    trials: int
    complete: bool
    text: str
    others: int

    @property
    def command(self) -> str:
        """The command that shows the failure."""
        return f"carom test {self.out}"

    def told(self) -> str:
        """Return it in words."""
        lines = [f"{self.world}: expectation {self.expectation} fails in {self.out} as it does there"]
        lines.append(f"  {self.outcome}")
        for what in ("entities", "words", "frames"):
            lines.append(f"  {what:<9} {getattr(self.before, what)} -> {getattr(self.after, what)}")
        end = "nothing more can go" if self.complete else "stopped before nothing more could go"
        lines.append(f"  trials    {self.trials}, {end}")
        if self.others:
            others = "another expectation" if self.others == 1 else f"{self.others} other expectations"
            lines.append(f"  note      {others} failed as well; choose by --expect")
        return "\n".join([*lines, f"show it with: {self.command}"])


def shrink(world: str, out: Path, *, expect: int | None = None, trials: int = 1000) -> Shrunk:
    """Return the smallest world in which the same expectation fails; nothing is written.

    ``expect`` is the number of the expectation, from 1, by default of the one that fails first; ``trials`` bounds how
    many worlds are simulated, and Ctrl-C ends it with the smallest so far. Raises CaromError where it holds, and
    NonFiniteError where a number is none before any fails.
    """
    loaded = load_world(world)
    _refuse_files(loaded, world, out)
    with deferred_interrupt() as check, progress_bar(trials, "trial") as bar:
        try:
            watch(loaded, loaded.expectations, check)
        except NonFiniteError:
            if all(one.held for one in loaded.expectations):
                raise
        number = _number(loaded, world, expect)
        chosen = loaded.expectations[number - 1]
        made = Trials(chosen, str(out), library.find(world).parent, trials, check)
        stated = loaded.source.data  # of all its files together
        whole = {"carom": VERSION} | {key: value for key, value in stated.items() if key != "include"}
        shrinking = _Shrinking(made, [whole, read(loaded.source_text, world).data], bar)
        complete = shrinking.all()
    before = _size(whole, loaded, loaded.run.frames)
    small = shrinking.found
    after = _size(small.tree, small.loaded, small.loaded.simulation.frame)
    others = sum(not one.held for one in loaded.expectations) - 1
    text = emit(small.tree)
    outcome = str(small.failed.outcome())
    return Shrunk(world, str(out), number, outcome, before, after, made.made, complete, text, others)


def _number(loaded: LoadedWorld, world: str, expect: int | None) -> int:
    """Return the number of the expectation that is meant; raise CaromError where there is none that fails."""
    count = len(loaded.expectations)
    if not count:
        raise CaromError(f"{world} expects nothing, so that nothing fails; state under 'expect' what goes wrong")
    if expect is not None and not 1 <= expect <= count:
        raise CaromError(f"--expect: {world} has {count} expectations; received {expect}, accepted: 1 to {count}")
    if expect is not None and loaded.expectations[expect - 1].held:
        held = loaded.expectations[expect - 1].text
        raise CaromError(f"--expect: expectation {expect} of {world} holds, '{held}'; choose one that fails")
    failed = [(one.failure[1], number) for number, one in enumerate(loaded.expectations, 1) if one.failure is not None]
    if not failed:
        raise CaromError(
            f"{world}: all of its expectations hold, so that there is no failure to keep; "
            "state under 'expect' what goes wrong"
        )
    return expect or min(failed)[1]


def _refuse_files(loaded: LoadedWorld, world: str, out: Path) -> None:
    """Raise CaromError where a world names files that its smaller one would not find."""
    named = sorted(word for word, path in loaded.files.items() if path.suffix not in library.SUFFIXES)
    home = library.find(world).parent
    if named and out.resolve().parent != home.resolve():
        raise CaromError(f"{out}: {world} names files such as {named[0]}, which are found from {home}; write it there")


def _size(tree: dict[str, Any], loaded: LoadedWorld, frames: int) -> Size:
    return Size(int(loaded.simulation.world.slots.alive.sum()), sum(1 for _ in leaves(tree)), frames)


class _Shrinking:
    """A tree that becomes smaller, with the world that it was when it last failed."""

    def __init__(self, trials: Trials, trees: list[dict[str, Any]], bar: Any) -> None:
        """Begin with the first of some trees that fails as the world does."""
        self.trials, self.bar = trials, bar
        found = next((found for tree in trees if (found := trials.attempt(tree)) is not None), None)
        if found is None:
            raise CaromError("written anew the world does not fail in the same manner, so that it cannot be shrunk")
        self.found = found

    def all(self) -> bool:
        """Do everything until nothing changes; tell whether that came before the last trial."""
        passes: list[Propose] = [partial(_removals, depth=depth) for depth in range(1, DEEPEST + 1)]
        passes += [partial(lower_counts, lower=lambda count: count // 2)]
        passes += [partial(lower_counts, lower=lambda count: count - 1)]
        passes += [partial(shorter_numbers, digits=digits) for digits in DIGITS]
        try:
            while sum(self._reduce(propose) for propose in passes):
                pass
        except KeyboardInterrupt:
            return False
        return self.trials.left > 0

    def _reduce(self, propose: Propose) -> bool:
        """Make as many of the proposed edits as can be made, in chunks that become smaller; tell whether any could."""
        edits, changed = propose(self.found.tree), False
        size = len(edits)
        while size:
            start = 0
            while start < len(edits):
                found = self.trials.attempt(edited(self.found.tree, edits[start : start + size]))
                if found is None:
                    start += size
                else:
                    self.found = found
                    edits, changed = propose(self.found.tree), True
                    self.bar.set_postfix(entities=len(found.loaded.places))
                self.bar.update(self.trials.made - self.bar.n)
            size = min(size, len(edits)) // 2
        return changed


def _removals(tree: dict[str, Any], depth: int) -> list[Edit]:
    return [Edit(path) for path in nodes(tree, depth)]
