"""Auditing: the observer that lets FCL measure what kernels answered, and what it has to tell."""

from __future__ import annotations

import dataclasses
from typing import Any

from carom.systems.constants import AUDITED_DEPTH, AUDITED_TURN
from carom.systems.detection.audit import Compared, Disagreement, audit
from carom.systems.simulation import Simulation


class Auditing:
    """Audits the contacts of every step."""

    def __init__(self) -> None:
        self.found: dict[tuple[str, str], Compared] = {}

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step, when nothing was detected yet."""

    def observe(self, simulation: Simulation) -> None:
        """Measure the contacts of the step both ways, at the poses at which they were found."""
        audit(simulation.world, self.found)

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""

    @property
    def failed(self) -> bool:
        """Whether a kernel disagrees with FCL."""
        return any(compared.beyond for compared in self.found.values())

    def rows(self) -> list[dict[str, Any]]:
        """Return what was found, by pair of shapes, for programs; a way that saw no contact has no depth."""
        rows = [{"shapes": list(shapes), **dataclasses.asdict(found)} for shapes, found in sorted(self.found.items())]
        for listed in (one for row in rows for one in row["listed"]):
            for way in ("depth_by_kernel", "depth_by_fcl"):
                listed[way] = listed[way] if listed[way] > -float("inf") else None
        return rows

    def text(self) -> str:
        """Return what was found for people."""
        if not self.found:
            return "  audit         no contact that a kernel answers"
        limits = f"{AUDITED_TURN} degrees and {AUDITED_DEPTH:g} of the smaller size"
        lines = [f"  audit         kernels against FCL at the deepest point of each contact, limits {limits}"]
        for shapes, found in sorted(self.found.items()):
            lines.append(f"    {', '.join(shapes):<18}{_told(found)}")
            lines += [f"      {_listed(one)}" for one in found.listed]
        return "\n".join(lines)


def _told(found: Compared) -> str:
    verdict = f"{found.beyond} DISAGREE" if found.beyond else "agree"
    told = (
        f"{verdict}: {found.pairs} compared, at worst {found.worst_degrees:.2g} degrees and {found.worst_depth:.2g} m"
    )
    if found.ties:
        told += f"; {found.ties} parted equally well by two directions"
    return told


def _listed(one: Disagreement) -> str:
    ways = ((one.depth_by_kernel, "the kernel"), (one.depth_by_fcl, "FCL"))
    seen = [f"{depth:.9g} m by {who}" if depth > -float("inf") else f"none by {who}" for depth, who in ways]
    return (
        f"frame {one.frame}, '{one.a}' and '{one.b}': depth {', '.join(seen)}; normals {one.degrees:.3g} degrees apart"
    )
