"""Answered: how many pairs were measured, and by whom."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from carom.ecs import World
from carom.ecs.component import Resource


@dataclass
class Answered(Resource):
    """Counts since the start: pairs by FCL, by array kernels and recycled, impossible points, detections, looks, cuts.

    Looks are those after somebody fast on the way. Cut are looks beyond the limit of a substep, and impacts beyond that
    of a step.
    """

    fcl: int = 0
    kernels: int = 0
    recycled: int = 0
    refused: int = 0
    detections: int = 0
    looks: int = 0
    impacts_cut: int = 0
    looks_cut: int = 0


@contextmanager
def uncounted(world: World) -> Iterator[None]:
    """Measure pairs within this context without a trace in the counts: looking on must not show in the summary."""
    counts = vars(world[Answered]).copy()
    try:
        yield
    finally:
        vars(world[Answered]).update(counts)
