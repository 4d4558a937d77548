"""Explain: the schedule as a table of systems with what they read, write and add."""

from __future__ import annotations

import textwrap
from itertools import zip_longest

from carom.ecs.access import Kind
from carom.ecs.schedule import Schedule
from carom.ecs.system import Condition, named

CELL = 40  # characters after which a list of components goes on in the next line


def explain(schedule: Schedule) -> str:
    """Return the frame as text: its systems under their phases in order of execution, then what each does."""
    rows: list[tuple[str, ...]] = [("phase", "system", "reads", "writes", "adds")]
    last, known = None, set()
    for phase, system in schedule:
        label = "" if phase is last else phase.name
        if phase not in known:
            label += (" (repeated)" if phase.repeat else "") + _if(phase.when)
        last = phase
        known.add(phase)
        lists = [textwrap.wrap(_names(kinds), CELL) for kinds in (system.reads, system.writes, system.adds)]
        rows += zip_longest([label], [system.name + _if(system.when)], *lists, fillvalue="")
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    lines.insert(1, "  ".join("-" * width for width in widths))
    lines += ["", *(f"{system.name.ljust(widths[1])}  {system.purpose}" for _, system in schedule)]
    return "\n".join(lines) + "\n"


def _names(kinds: tuple[Kind, ...]) -> str:
    return " ".join(kind.__name__ for kind in kinds)


def _if(condition: Condition | None) -> str:
    return "" if condition is None else f" (if {named(condition)})"
