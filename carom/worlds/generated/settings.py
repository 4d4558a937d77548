"""Settings in files: their fields under ``step`` and at the top, and what reads each by its name."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, get_args, get_type_hints

from pydantic import Field, TypeAdapter

from carom.systems.settings import MOST_SUBSTEPS, MOST_THREADS, Settings
from carom.worlds.generated.fields import Fields, description, hinted

SETTING_UNITS = {"dt": "s", "gravity": "m/s2", "hit_speed": "m/s"}
SETTING_BOUNDS: dict[str, dict[str, float]] = {"dt": {"above": 0.0}, "hit_speed": {"above": 0.0}}
SETTING_WHOLE: dict[str, tuple[int, int | None]] = {
    "substeps": (1, MOST_SUBSTEPS),
    "dimensions": (2, 3),
    "threads": (1, MOST_THREADS),
}
STEP_WORDS = ("dt", "substeps", "integrator", "threads", "sleeping")


def setting_fields(*, in_step: bool) -> Fields:
    """Return the fields of `Settings` that stand under ``step``, or those at the top of a file."""
    hints = get_type_hints(Settings)
    fields: Fields = {}
    for field in dataclasses.fields(Settings):
        if (field.name in STEP_WORDS) is in_step:
            unit, bounds = SETTING_UNITS.get(field.name, "1"), SETTING_BOUNDS.get(field.name, {})
            width, whole = len(get_args(hints[field.name])) or 1, SETTING_WHOLE.get(field.name, (0, None))
            kind = hinted(hints[field.name], unit, width=width, whole=whole, **bounds)
            fields[field.name] = (kind, Field(field.default, description=description(field.metadata["doc"], unit)))
    return fields


def setting_types() -> dict[str, TypeAdapter[Any]]:
    """Return what reads the value of each setting by its name, wherever it stands in a file."""
    fields = setting_fields(in_step=True) | setting_fields(in_step=False)
    declared: dict[str, Any] = {name: Annotated[kind, field] for name, (kind, field) in fields.items()}
    return {name: TypeAdapter(kind) for name, kind in declared.items()}
