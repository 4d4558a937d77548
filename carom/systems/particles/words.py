"""Words of emitters: what files and Python state, and the component it is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from carom.ecs.components.emitter import Collide, Drawn, Emitter, Source, Within
from carom.systems.constants import MOST_BORN
from carom.systems.declared import Stated, Steps, choice, direction, part, read_words, span, tint
from carom.systems.forces.region import BoxRegion, Region, SphereRegion
from carom.systems.parameters import WordFault, parameter, refusal, vector

COLLIDE = tuple(kind.name.lower() for kind in Collide)
DRAWN = tuple(kind.name.lower() for kind in Drawn)
WHITE = (1.0, 1.0, 1.0, 1.0)
Pair = tuple[float, float]
PLAIN = (
    "rate", "burst", "every", "start", "duration", "cone", "speed", "inherit", "life", "size", "color", "mass",
    "gravity_scale", "most",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Round(Stated):
    """A sphere or a disc."""

    radius: float = parameter(unit="m", doc="radius", above=0.0)


@dataclass(frozen=True, kw_only=True)
class Edges(Stated):
    """A box along the axes of the entity."""

    size: tuple[float, float, float] = vector(unit="m", doc="full edge lengths along x, y, z")


@dataclass(frozen=True, kw_only=True)
class SourceWords(Stated):
    """Where particles are born: anywhere in exactly one shape, frame of the entity."""

    sphere: Round | None = part(Round, doc="a sphere about the origin")
    box: Edges | None = part(Edges, doc="a box about the origin")
    disc: Round | None = part(Round, doc="a disc about the origin, across the direction")

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Refuse none and several."""
        if sum(shape is not None for shape in (self.sphere, self.box, self.disc)) != 1:
            yield (), "must state exactly one shape, sphere, box or disc"


@dataclass(frozen=True, kw_only=True)
class EmitterWords(Stated):
    """A source of particles at the origin of an entity; a pair is the least and the greatest of what they differ in."""

    rate: float = parameter(unit="1/s", doc="particles born in a second", default=0.0, least=0.0)
    burst: int = parameter(unit="1", doc="particles born at once, when it begins", default=0, least=0, most=MOST_BORN)
    every: float = parameter(unit="s", doc="time between bursts, 0 for a single one", default=0.0, least=0.0)
    start: float = parameter(
        unit="s", doc="simulated time at which it begins, not before it is added", default=0.0, least=0.0
    )
    duration: float = parameter(unit="s", doc="for how long it emits, for good by default", default=math.inf, above=0.0)
    source: Any = part(SourceWords, words=("point",), doc="where they are born, in a point by default", default="point")
    direction: tuple[float, float, float] | None = direction(doc="mean direction, frame of the entity; y by default")
    cone: float = parameter(unit="rad", doc="greatest angle from it", default=0.0, least=0.0, most=math.pi)
    speed: Pair = span(unit="m/s", doc="speed against the emitter, or [least, greatest]", default=(0.0, 0.0), least=0.0)
    inherit: float = parameter(unit="1", doc="share of the emitter's velocity that they have too", default=1.0)
    life: Pair = span(unit="s", doc="how long they live, or [shortest, longest]", default=(1.0, 1.0), above=0.0)
    size: float = parameter(unit="m", doc="diameter at birth", default=0.05, above=0.0)
    end_size: float | None = parameter(
        unit="m", doc="diameter at the end, the same by default", default=None, least=0.0
    )
    color: Any = tint(doc="colour at birth, white by default", default=WHITE)
    end_color: Any = tint(doc="colour at the end, the same by default")
    draw: str = choice(DRAWN, doc="what they are drawn as", default="sprites")
    mass: float = parameter(unit="kg", doc="mass of one", default=0.001, above=0.0)
    gravity_scale: float = parameter(unit="1", doc="factor on the world's gravity", default=1.0)
    most: int = parameter(
        unit="1", doc="alive at most, the oldest die first; any number by default", default=0, least=0, most=2**53
    )
    collide: str = choice(COLLIDE, doc="what they bounce off", default="planes")
    within: Region | None = part(Region, doc="part of space where they may be; elsewhere they die")

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Refuse counts that are not whole, and emitters of nothing."""
        for word in ("burst", "most"):
            if getattr(self, word) != int(getattr(self, word)):
                yield (word,), f"must be a whole number, received {getattr(self, word):g}"
        if not (self.rate or self.burst):
            yield (), "emits nothing; state rate or burst"
        if self.every and not self.burst:
            yield ("every",), "repeats no burst; state burst"

    def component(self) -> Emitter:
        """Return the component."""
        values = {name: getattr(self, name) for name in PLAIN}
        values["direction"] = self.direction or (0.0, 1.0, 0.0)
        values["end_size"] = self.size if self.end_size is None else self.end_size
        values["end_color"] = self.color if self.end_color is None else self.end_color
        values |= {"collide": COLLIDE.index(self.collide), "drawn": DRAWN.index(self.draw)}
        if self.source != "point":
            values |= _source(self.source)
        if self.within is not None:
            values |= _within(self.within)
        return Emitter(**values)

    @classmethod
    def of(cls, emitter: Emitter) -> Self:
        """Return what states an emitter of one row; the inverse of `component`."""
        held = {name: getattr(emitter, name).tolist() for name in Emitter.columns if hasattr(emitter, name)}
        values: dict[str, Any] = {name: tuple(v) if isinstance(v := held[name], list) else v for name in PLAIN}
        if held["direction"] != [0.0, 1.0, 0.0]:
            values["direction"] = tuple(held["direction"])
        for name in ("size", "color"):
            if held[f"end_{name}"] != held[name]:
                values[f"end_{name}"] = held[f"end_{name}"]
        values |= {"collide": COLLIDE[held["collide"]], "draw": DRAWN[held["drawn"]]}
        extent, source = tuple(held["extent"]), Source(held["source"])
        if source is Source.BOX:
            values["source"] = SourceWords(box=Edges(size=extent))
        elif source is not Source.POINT:
            words: dict[str, Any] = {source.name.lower(): Round(radius=extent[0])}
            values["source"] = SourceWords(**words)
        within, middle = tuple(held["within_extent"]), tuple(held["within_position"])
        if held["within"] == Within.BOX:
            values["within"] = Region(box=BoxRegion(within, middle))
        elif held["within"] == Within.SPHERE:
            values["within"] = Region(sphere=SphereRegion(within[0], middle))
        return cls(**values)


def _source(words: SourceWords) -> dict[str, Any]:
    if words.box is not None:
        return {"source": Source.BOX.value, "extent": words.box.size}
    shape, kind = (words.sphere, Source.SPHERE) if words.sphere is not None else (words.disc, Source.DISC)
    assert shape is not None, "faults() finds sources without a shape"
    return {"source": kind.value, "extent": (shape.radius, 0.0, 0.0)}


def _within(region: Region) -> dict[str, Any]:
    if region.box is not None:
        kind, extent, shape = Within.BOX, region.box.size, region.box
        return {"within": kind.value, "within_extent": extent, "within_position": shape.position}
    assert region.sphere is not None, "faults() finds regions without a shape"
    extent = (region.sphere.radius, 0.0, 0.0)
    return {"within": Within.SPHERE.value, "within_extent": extent, "within_position": region.sphere.position}


def read_emitter(words: Any, faults: list[WordFault]) -> Emitter | None:
    """Return the component that words state; None where anything is wrong, all of which is added to ``faults``."""
    stated = read_words(EmitterWords, words, ("emitter",), faults)
    return None if stated is None else stated.component()


def emitter_of(words: Any, now: float) -> Emitter:
    """Return the component that words state, which begins at the earliest ``now`` (s).

    Raises DeclarationError naming everything that is wrong with them.
    """
    faults: list[WordFault] = []
    made = read_emitter(words, faults)
    if made is None:
        raise refusal(faults)
    made.start = np.maximum(made.start, now)
    return made
