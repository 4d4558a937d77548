"""Refusals: what of a world no file can hold."""

from __future__ import annotations

from collections.abc import Iterator

from carom.ecs.component import Component
from carom.ecs.tags import Tag
from carom.systems.own_components import components_of_files, is_own
from carom.systems.places import extended
from carom.systems.simulation import Simulation
from carom.systems.step import STEP

PACKAGE = "a package of your own, as the README tells, would be there for whoever loads the file"


def refusals(simulation: Simulation) -> list[str]:
    """Return in words what of a world no file can hold, each with what to do about it."""
    return [*_of_systems(simulation), *_of_components(simulation), *_of_resources(simulation)]


def _of_systems(simulation: Simulation) -> Iterator[str]:
    known = {system for _, system in extended(STEP)}
    here = {system for _, system in simulation.schedule}
    for system in sorted(here - known, key=lambda system: system.name):
        yield f"system '{system.name}' was put into the step by Python; {PACKAGE}"
    for system in sorted(known - here, key=lambda system: system.name):
        yield f"system '{system.name}' was taken out of the step by Python; put it back"


def _of_components(simulation: Simulation) -> Iterator[str]:
    world, known = simulation.world, set(components_of_files().values())
    for kind in sorted(world.tables, key=lambda kind: kind.key):
        told = not is_own(kind) or issubclass(kind, Tag) or kind in known
        if not told and issubclass(kind, Component) and world.count(kind):
            yield f"component {kind.__name__} is declared in {kind.__module__}, which no file loads; {PACKAGE}"


def _of_resources(simulation: Simulation) -> Iterator[str]:
    known = Simulation().world.resources
    for kind, resource in simulation.world.resources.items():
        if kind not in known and resource.state() is not None:
            yield f"resource {kind.__name__} holds state, and no file loads one; {PACKAGE}"
