"""The ``expect`` section of a world file to expectations."""

from __future__ import annotations

from typing import Any

from carom.systems.simulation import Simulation
from carom.worlds.condition import read_condition
from carom.worlds.errors import Path, WordError
from carom.worlds.expect_bounds import Bounds
from carom.worlds.expect_course import Eventually, Order, Settled
from carom.worlds.expect_laws import QUANTITIES, Conserved, Penetration, Throughout
from carom.worlds.expect_moment import frame_of, read_event
from carom.worlds.expect_pictures import Visible
from carom.worlds.expect_values import read_values
from carom.worlds.expectation import Expectation, Outcome
from carom.worlds.source import Source

__all__ = ["Expectation", "Outcome", "read_expectations"]
RUN = (*QUANTITIES, "penetration", "bounds", "never", "always", "eventually", "settles_by", "order")  # of all of it


def read_expectations(source: Source, simulation: Simulation, items: list[Any]) -> list[Expectation]:
    """Return the expectations of checked words (None: already reported); report names of nobody."""
    found: list[Expectation] = []
    for index, words in enumerate(items):
        if words is not None:
            path = ("expect", index)
            read = _read(source, simulation, path, words)
            for expectation in read:
                expectation.path, expectation.file = path, source.written_at(path)
            found += read
    return found


def _read(source: Source, simulation: Simulation, path: Path, words: Any) -> list[Expectation]:
    values = dict(words.__pydantic_extra__ or {})
    moments = [key for key in ("at", "when") if getattr(words, key) is not None]
    laws = [key for key in RUN if getattr(words, key) is not None]
    asked = bool(values) or words.visible is not None
    if len(moments) > 1 or (moments and not asked) or (values and not moments) or not (laws or asked):
        accepted = f"{', '.join(RUN)}, visible; or at or when, with values such as ball.position: {{is, within}}"
        received = ", ".join((*moments, *values)) or "none"
        source.report(path, "must state a law, or a moment with values", received=received, accepted=accepted)
        return []
    found: list[Expectation] = []
    for key in laws:
        try:
            found.append(_of_run(simulation, key, getattr(words, key)))
        except WordError as fault:
            source.report_value((*path, key), fault)
    moment: dict[str, Any] = {}
    for key in moments:
        try:
            moment = _moment(simulation, key, getattr(words, key))
        except WordError as fault:
            source.report_value((*path, key), fault)
            return found
    if words.visible is not None:
        try:
            found.append(Visible(words.visible, simulation.world, **moment))
        except WordError as fault:
            source.report_value((*path, "visible"), fault)
    for name, item in read_values(values, simulation.world, **moment):
        if isinstance(item, WordError):
            source.report_value((*path, name), item)
        else:
            found.append(item)
    return found


def _of_run(simulation: Simulation, key: str, stated: Any) -> Expectation:
    world = simulation.world
    match key:
        case "penetration":
            return Penetration(stated)
        case "bounds":
            return Bounds(stated, world)
        case "never" | "always":
            return Throughout(key, read_condition(stated, world))
        case "eventually":
            return Eventually(read_condition(stated, world))
        case "settles_by":
            return Settled(stated, simulation)
        case "order":
            return Order(stated, world)
        case _:
            return Conserved(key, stated)


def _moment(simulation: Simulation, key: str, value: Any) -> dict[str, Any]:
    if key == "at":
        return {"frame": frame_of(value, simulation.settings.dt)}
    return {"when": read_event(value, simulation.world)}
