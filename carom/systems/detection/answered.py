"""Answered: how many pairs were measured, and by whom."""

from __future__ import annotations

from dataclasses import dataclass

from carom.ecs.component import Resource


@dataclass
class Answered(Resource):
    """Counts since the start: pairs answered by FCL and by array kernels, detections, impacts beyond the cap."""

    fcl: int = 0
    kernels: int = 0
    detections: int = 0
    impacts_cut: int = 0
