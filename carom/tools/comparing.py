"""Comparing: the words of ``--compare``, and the worlds they ask for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from carom.ecs.errors import CaromError
from carom.worlds.builder import LoadedWorld, load_world
from carom.worlds.check import check
from carom.worlds.errors import WordError, WorldError
from carom.worlds.generated.settings import setting_types
from carom.worlds.names import known
from carom.worlds.reader import read
from carom.worlds.source import Source

OPTION = "--compare"
FORM = "a setting and two or more values, such as integrator=euler,semi_implicit,verlet or dt=1/60,1/240"


def read_comparison(text: str) -> tuple[str, list[tuple[str, Any]]]:
    """Return a setting and its values, each behind the word for it; raise CaromError for all that is wrong."""
    name, sign, values = text.partition("=")
    settings = setting_types()
    try:
        if not sign:
            raise WordError("is no comparison", received=repr(text), accepted=FORM)
        known("setting", name, sorted(settings))
        stated = read(f"[{values}]", OPTION).data
        if len({str(value) for value in stated}) < max(len(stated), 2):
            raise WordError("compares fewer than two different values", received=repr(text), accepted=FORM)
    except WordError as fault:
        raise CaromError(fault.line(OPTION)) from None
    source = Source(OPTION, "")
    taken = [(f"{name}={value}", check(source, settings[name], value, (f"{name}={value}",))) for value in stated]
    if source.faults:
        raise WorldError([replace(fault, line=0, column=0) for fault in source.faults])
    return name, taken


def load_futures(world: str, text: str, **options: Any) -> list[tuple[str, LoadedWorld]]:
    """Return a world for each value of a comparison, by its name, with what else the command line sets aside."""
    name, values = read_comparison(text)
    if name in options:
        raise CaromError(f"{OPTION}: compares {name}, which --{name} states; leave one of them")
    return [(label, load_world(world, **options | {name: value})) for label, value in values]
