"""Explain: the schedule as a table of systems with what they read, write and add."""

from __future__ import annotations

from carom.ecs.schedule import Schedule
from carom.ecs.system import Kind


def explain(schedule: Schedule) -> str:
    """Return the frame as text: one line per system under its phase, in order of execution."""
    rows = [("phase", "system", "reads", "writes", "adds")]
    for phase, system in schedule:
        label = phase.name + (" (repeated)" if phase.repeat else "")
        label = "" if any(row[0] == label for row in rows) else label
        rows.append((label, system.name, _names(system.reads), _names(system.writes), _names(system.adds)))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(lines) + "\n"


def _names(kinds: tuple[Kind, ...]) -> str:
    return " ".join(kind.__name__ for kind in kinds)
