"""Filling: the data of a world with its expressions computed, and its sections checked."""

from __future__ import annotations

from typing import Any

from carom.ecs.errors import did_you_mean
from carom.worlds.check import check_item, check_section, refuse_form, well_named
from carom.worlds.generators import Setting
from carom.worlds.prefab import MEMBERS, Prefabs
from carom.worlds.schema import document
from carom.worlds.source import Source
from carom.worlds.unfold import Item, Measure, Unfolding
from carom.worlds.variables import Variables

APART = ("variables", "prefabs", "entities")  # sections whose expressions are computed item by item


def filled(source: Source, data: dict[str, Any]) -> tuple[dict[str, Any], Prefabs]:
    """Return the data of a world, computed but for prefabs and entities, and its prefabs, with which these are."""
    variables = Variables(source, ("variables",), data.get("variables"))
    variables.settle_all()
    if source.computes:
        data = {key: value if key in APART else variables.fill(value, (key,)) for key, value in data.items()}
    return data, Prefabs(source, data.get("prefabs"), variables)


def checked_sections(source: Source, data: dict[str, Any]) -> dict[str, Any]:
    """Return every section but prefabs and entities in SI, absent ones with their default, faulty items as None."""
    sections = document().model_fields
    for key in data:
        if key not in sections:
            hint = did_you_mean(key, sections)
            source.report((key,), "unknown key", received=repr(key), accepted=", ".join(sections), hint=hint)
    values: dict[str, Any] = {}
    for key, section in sections.items():
        if key in ("prefabs", "entities"):
            continue
        values[key] = check_section(source, key, data[key]) if key in data else None
        if values[key] is None:
            values[key] = section.get_default(call_default_factory=True)
    return values


def unfolded(source: Source, prefabs: Prefabs, entities: Any, setting: Setting, measure: Measure) -> list[Item]:
    """Return the entities of a world and of its groups, with the words of their prefabs; report what is wrong there."""
    check_prefabs(source, prefabs)
    if not isinstance(entities, list):
        refuse_form(source, ("entities",), entities, list)
        return []
    unfolding = Unfolding(source, prefabs, setting, measure)
    for index, words in enumerate(entities):
        unfolding.unfold(("entities", index), words)
    return unfolding.items


def check_prefabs(source: Source, prefabs: Prefabs) -> None:
    """Report what is wrong with prefabs as they stand, used or not."""
    if not isinstance(prefabs.stated, dict):
        refuse_form(source, ("prefabs",), prefabs.stated, dict)
    for name in prefabs.prefabs:
        if not well_named(source, "prefabs", name):
            continue
        path = ("prefabs", name)
        words, parameters = prefabs.extended(path, prefabs.prefabs[name])
        members = words.get(MEMBERS) if isinstance(words, dict) else None
        check_item(source, "prefabs", path, words, partial=True)
        for number, member in enumerate(members if isinstance(members, list) else ()):
            place = (*source.locate((*path, MEMBERS)), number)
            own, _ = prefabs.extended(place, member, parameters)
            if not (isinstance(own, dict) and MEMBERS in own):
                check_item(source, "entities", place, own)
