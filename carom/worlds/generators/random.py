"""Random: copies scattered over a region, none in another."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from pydantic import Field, model_validator

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.worlds.errors import WordError
from carom.worlds.generators.generator import Copies, Generator, Setting, numbered, turns
from carom.worlds.generators.words import Edge, Edges, Gap
from carom.worlds.values import Count, Flag

TRIES = 50  # places drawn for each copy before those left are given up


class Random(Generator):
    """Copies of an entity scattered over a region about where it is, called like ``leaf[3]``; no two overlap."""

    key: ClassVar[str] = "random"
    sized: ClassVar[bool] = True
    count: Count = Field(description="how many; those that find no room are left out, and told")
    box: Edges | None = Field(None, description="edges of the box they lie in (m)")
    sphere: Edge | None = Field(None, description="radius of the ball they lie in (m)")
    gap: Gap = Field(0.0, description="left free between neighbours at least (m)")
    turned: Flag = Field(False, description="whether each is turned at random")

    @model_validator(mode="after")
    def check(self) -> Random:
        """Refuse both regions and neither."""
        if (self.box is None) is (self.sphere is None):
            received = "neither" if self.box is None else "both"
            raise WordError("must state one region", received=received, accepted="box or sphere")
        return self

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return self.count

    def lay(self, setting: Setting) -> Copies:
        """Return the copies in the order in which they found room."""
        radius = setting.radius(self.key)
        apart, found = 2.0 * radius + self.gap, np.zeros((0, 3))
        room = self._room(radius)
        for _ in range(TRIES):
            drawn = setting.draws.uniform(-1.0, 1.0, (self.count, 3)) * room
            if self.sphere is not None:
                drawn = drawn[(drawn**2).sum(axis=1) <= room[0] ** 2]
            found = np.concatenate([found, fitting(found, drawn, apart)])[: self.count]
            if len(found) == self.count:
                break
        missing = self.count - len(found)
        note = f"{missing} of {self.count} copies found no room; take fewer, or a larger region" if missing else ""
        rotations = turns(setting.draws, len(found)) if self.turned else None
        return Copies(found, numbered(len(found)), rotations, note)

    def _room(self, radius: float) -> Floats:
        """Return how far (3,) an origin may be from the middle of the region, m."""
        half = np.full(3, self.sphere) if self.box is None else 0.5 * np.asarray(self.box)
        if (half < radius).any():
            region = "sphere" if self.box is None else "box"
            raise DeclarationError(f"random.{region}: is too small for a copy, which lies within {radius:.3g} m")
        return half - radius


def fitting(there: Floats, drawn: Floats, apart: float) -> Floats:
    """Return those places of ``drawn`` (n, 3) that are ``apart`` (m) from all ``there`` and from those kept before."""
    from scipy.spatial import cKDTree

    if len(there):
        near, _ = cKDTree(there).query(drawn, distance_upper_bound=apart)
        drawn = drawn[~np.isfinite(near)]
    kept = np.ones(len(drawn), np.bool_)
    pairs = cKDTree(drawn).query_pairs(apart, output_type="ndarray") if len(drawn) else np.zeros((0, 2), np.int64)
    for first, second in pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].tolist():
        if kept[first]:
            kept[second] = False
    return drawn[kept]
