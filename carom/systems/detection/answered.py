"""Answered: how many pairs were measured, and by whom."""

from __future__ import annotations

from dataclasses import dataclass

from carom.ecs.component import Resource


@dataclass
class Answered(Resource):
    """Counts since the start: pairs by FCL and by array kernels, points no contact can be, detections, impacts cut."""

    fcl: int = 0
    kernels: int = 0
    refused: int = 0
    detections: int = 0
    impacts_cut: int = 0
