"""Queries: what was asked of space in every step and between two of them, as lines to what was met."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Column
from carom.systems.queries.asked import Asked, Question
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.rows import RowTrack, handle, number, text
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.happenings import PATH as LOG

ROOT = "world/queries"
COLORS = {"hits": (90, 230, 120), "misses": (150, 150, 150)}
LINE_RADIUS = -1.0  # negative: points of the screen


class Queries(RowTrack):
    """A row for all that a query met, or for one that met nobody; green lines are hits, grey ones misses.

    They are seen in the frame whose world they asked: at the end of its step, or within that; an overlap is a point.
    """

    key: ClassVar[str] = "queries"
    detail: ClassVar[str] = "full"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "queries"
    sparse: ClassVar[bool] = True
    columns: ClassVar[Mapping[str, Column]] = {
        "query": text("what was asked, such as cast_rays"),
        "system": text("the system that asked, empty for code between two steps"),
        "tag": text("what its caller calls it"),
        "origin": number("m", "from where", 3),
        "end": number("m", "where somebody was met, or else how far was looked, 100 m at most", 3),
        "entity": handle("who was met, -1 for nobody"),
    }

    def __init__(self) -> None:
        super().__init__()
        self._frame, self._drawn = -1, False
        self._stream: Stream | None = None

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Have questions kept, and write how they are drawn."""
        import rerun

        self._stream = stream
        simulation.world[Asked].listeners += 1
        for kind, color in COLORS.items():
            style = rerun.LineStrips3D.from_fields(colors=[color], radii=[LINE_RADIUS])
            stream.static(f"{ROOT}/{kind}", style)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep what was asked in the frame before, which now is over."""
        self._take(simulation, stamp.frame - 1, stream)

    def end(self, simulation: Simulation) -> None:
        """Keep what was asked in the last frame."""
        assert self._stream is not None, "begin() comes before end()"
        self._take(simulation, simulation.frame, self._stream)
        simulation.world[Asked].listeners -= 1

    def _take(self, simulation: Simulation, frame: int, stream: Stream) -> None:
        import rerun

        self._frame, stamp = frame, Stamp(frame, frame * simulation.settings.dt)
        super().sample(simulation, stamp, stream)
        if left_out := simulation.world[Asked].left_out.get(frame):
            stream.row(LOG, stamp, rerun.TextLog(f"{left_out} more answers of queries in this frame", level="DEBUG"))

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return what was asked, and no rows once after that, so that nothing is drawn any more."""
        questions = simulation.world[Asked].of(self._frame)
        shown, self._drawn = self._drawn, bool(questions)
        if not questions and not shown:
            return None
        return {
            **{name: np.array(_words(questions, name), np.str_) for name in ("query", "system", "tag")},
            "origin": np.concatenate([np.zeros((0, 3)), *(question.origin for question in questions)]),
            "end": np.concatenate([np.zeros((0, 3)), *(question.end for question in questions)]),
            "entity": np.concatenate([np.zeros(0, np.int64), *(question.entity for question in questions)]),
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Write hits and misses as lines, labelled by what they are called."""
        import rerun

        columns, frames = block.columns, np.repeat(np.arange(len(block.counts)), block.counts)
        lines = np.stack([columns["origin"], columns["end"]], axis=1)
        named = np.where(columns["tag"] == "", columns["query"], columns["tag"])
        hit = columns["entity"] >= 0
        for kind, chosen in (("hits", hit), ("misses", ~hit)):
            counts = np.bincount(frames[chosen], minlength=len(block.counts))
            strips = rerun.LineStrips3D.columns(strips=lines[chosen], labels=named[chosen].tolist())
            stream.rows(f"{ROOT}/{kind}", block.stamps, strips.partition(counts))
        return ()


def _words(questions: list[Question], name: str) -> list[str]:
    return [getattr(question, name) for question in questions for _ in question.entity]
