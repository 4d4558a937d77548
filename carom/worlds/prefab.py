"""Prefabs: words an entity extends, its own words winning."""

from __future__ import annotations

from typing import Any

from carom.systems.joints import JOINTS
from carom.systems.shapes import SHAPES
from carom.worlds.errors import Path, WordError
from carom.worlds.names import known
from carom.worlds.source import Source


def extended(source: Source, path: Path, words: Any, prefabs: dict[str, Any]) -> Any:
    """Return an entity's words laid over those of its prefab and of the prefab's own; report an unknown one."""
    chain = [path]
    while isinstance(words, dict) and isinstance(words.get("prefab"), str):
        name, here = words["prefab"], chain[-1]
        base: Path = ("prefabs", name)
        if name not in prefabs:
            try:
                known("prefab", name, prefabs)
            except WordError as fault:
                source.report_value((*here, "prefab"), fault)
            return _without_prefab(words)
        if base in chain:
            source.report((*here, "prefab"), "extends itself", received=repr(name))
            return _without_prefab(words)
        source.inherits[here] = base
        words = merged(prefabs[name], _without_prefab(words))
        chain.append(base)
    return words


def _without_prefab(words: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in words.items() if key != "prefab"}


def merged(under: Any, over: Any) -> Any:
    """Return mappings merged to the depth; a rotation is taken whole, a shape or joint takes the place of another."""
    if not (isinstance(under, dict) and isinstance(over, dict)):
        return over
    result = dict(under)
    for kinds in (SHAPES, JOINTS):
        if any(key in kinds for key in over):
            result = {key: value for key, value in result.items() if key not in kinds or key in over}
    for key, value in over.items():
        result[key] = merged(result[key], value) if key in result and key != "rotation" else value
    return result
