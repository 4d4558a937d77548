"""Track: one kind of thing a recording holds, from some level of detail on."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import World
from carom.systems.registry import Keyed
from carom.systems.simulation import Simulation
from carom.tools.recorder.choice import Choice
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream

TRACKS: dict[str, type[Track]] = {}


class Track(Keyed, ABC, registry=TRACKS, kinds="tracks"):
    """What samples the world cheaply in recorded frames, and writes its samples in blocks about once a second.

    ``key`` is its name and ``detail`` the least level that has it. One with ``every_step`` sees every step, recorded
    frame or not. An instance belongs to one recording, and tells of ``only`` these entities where some are chosen. One
    that keeps much counts how many bytes are ``kept``, and writes when these make a block.
    """

    detail: ClassVar[str] = "light"
    every_step: ClassVar[bool] = False
    only: Choice | None = None
    kept: int = 0

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write what holds at all times, before the first frame; ``tracks`` are all of the recording, by key."""

    def silent(self, simulation: Simulation) -> bool:
        """Tell at the beginning whether it will never have anything to say, so that it is not asked in each frame."""
        return False

    def lay_out(self, world: World, layout: Layout) -> None:
        """Add what is seen of it when the recording is opened; most need nothing but the view of the world."""

    def watch(self, simulation: Simulation) -> None:
        """See the world at the start and after every step; most tracks only look when a frame is recorded."""

    def end(self, simulation: Simulation) -> None:
        """Let go of the simulation; most tracks hold nothing of it."""

    @abstractmethod
    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep what the recording needs of this frame."""

    @abstractmethod
    def write(self, stream: Stream) -> None:
        """Write what was kept since the last call."""
