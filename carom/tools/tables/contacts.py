"""Contacts: where colliders touched, with both of them and the numbers."""

from __future__ import annotations

from carom.ecs.dataframe import Flat
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.tools.recorder.tracks.contacts import POINTS
from carom.tools.tables.source import Source, flats

PATH = f"/{POINTS}"
COMPONENTS = {"a": "a", "b": "b", "depth": "depth", "speed": "speed", "impulse": "impulse"} | {
    "point": "Points3D:positions",
    "normal": "normal",
}
SPEED = Impact.columns["speed"]


def has_contacts(source: Source) -> bool:
    """Tell whether a recording holds contacts, if only that there were none."""
    return (PATH, "a") in source.series


def contacts(source: Source) -> list[Flat]:
    """Return a row per frame and contact."""
    rows = source.rows(PATH, COMPONENTS)
    columns = list(source.keys(rows.frame))
    for name, values in rows.columns.items():
        declared = SPEED if name == "speed" else Contact.columns[name]
        if declared.holds == "entities":
            columns += source.entities(name, f"{name}.name", declared.doc, values)
        else:
            columns += flats(name, declared, values)
    return columns
