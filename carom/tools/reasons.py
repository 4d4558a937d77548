"""Reasons: why a body moved in a frame, as a table of causes and the chain that led there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.errors import CaromError
from carom.systems.causes import Causes, take_step
from carom.tools.origin import Link, trace_back
from carom.tools.side import Side

ROUNDING = 1e-9  # m/s: what causes may leave over


@dataclass
class Reasons:
    """What changed the velocity of a body in a frame, and the chain back to where it began."""

    name: str
    world: World
    causes: Causes
    chain: list[Link]

    def text(self) -> str:
        """Return it in words."""
        found = self.causes
        rows = [("source", "from", "change in m/s", "N s")]
        rows += [(source, whom, _vector(change), f"{size:.4g}") for source, whom, change, size in self._rows()]
        rows.append(("in all", "", _vector(found.after - found.before), ""))
        widths = [max(len(row[column]) for row in rows) for column in range(4)]
        lines = [f"'{self.name}' in frame {found.frame}: from {_vector(found.before)} to {_vector(found.after)} m/s"]
        lines += ["  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
        if np.abs(found.rest).max() > ROUNDING:
            lines.append(f"  not told apart: {_vector(found.rest)} m/s")
        lines += ["back to where it began:", *(f"  {link.text}" for link in self.chain)]
        return "\n".join(line.rstrip() for line in lines)

    def values(self) -> dict[str, Any]:
        """Return it for programs."""
        names = ("source", "from", "change", "impulse")
        found = self.causes
        return {
            "entity": self.name,
            "frame": found.frame,
            "before": found.before.tolist(),
            "after": found.after.tolist(),
            "causes": [dict(zip(names, (s, w, c.tolist(), i), strict=True)) for s, w, c, i in self._rows()],
            "rest": found.rest.tolist(),
            "chain": [{"frame": link.frame, "entity": link.entity, "by": link.by} for link in self.chain],
        }

    def _rows(self) -> Iterable[tuple[str, str, Any, float]]:
        for source, other, change in self.causes.causes:
            whom = self.world.name(other) if other >= 0 else ""
            yield source, whom, change, self.causes.mass * float(np.linalg.norm(change))


def motion(side: Side, name: str, frame: int) -> Reasons:
    """Return why a body moved as it did in a frame; raise CaromError for one that nothing led to."""
    if frame <= side.first:
        raise CaromError(f"--frame: nothing led to frame {frame}; accepted: {side.first + 1} to {side.last}")
    simulation = side.simulation_at(frame - 1)
    side.redo(simulation)
    found = take_step(simulation, name)
    return Reasons(name, simulation.world, found, trace_back(side, found.entity, frame))


def _vector(values: Iterable[float]) -> str:
    return f"[{', '.join(f'{value:+.4g}' for value in values)}]"
