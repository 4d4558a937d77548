"""Check data against the schema, item by item, so that one wrong entity hides nothing about the others."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, get_args, get_origin

from pydantic import TypeAdapter, ValidationError

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import Path, WordError, shown
from carom.worlds.schema import document
from carom.worlds.source import Source

ENTITIES = {"entities", "prefabs", "spawn"}  # below which there are words of entities
WORDING = {
    "model_type": ("must be a mapping", "keys with values"),
    "model_attributes_type": ("must be a mapping", "keys with values"),
    "dict_type": ("must be a mapping", "keys with values"),
    "list_type": ("must be a list", "[...], or lines that begin with -"),
    "tuple_type": ("must be a list", "[...]"),
    "string_type": ("must be text", "text"),
}


@cache
def _adapter(section: str, item: bool) -> TypeAdapter[Any]:
    field = document().model_fields[section]
    return TypeAdapter(get_args(field.annotation)[-1] if item else field.rebuild_annotation())


@cache
def collection(section: str) -> type[Any] | None:
    """Return dict or list for a section of many items, None for others."""
    origin = get_origin(document().model_fields[section].annotation)
    return origin if origin in (dict, list) else None


def check_section(source: Source, section: str, value: Any, *, partial: bool = False) -> Any:
    """Return the section checked and in SI; a list or mapping has None for each item that was reported as faulty.

    ``partial`` allows required keys of items to be missing.
    """
    kind = collection(section)
    if kind is None:
        return check(source, _adapter(section, False), value, (section,))
    if not isinstance(value, kind):
        refuse_form(source, (section,), value, kind)
        return kind()
    adapter = _adapter(section, True)
    if kind is list:
        return [check(source, adapter, item, (section, index)) for index, item in enumerate(value)]
    return {
        key: check(source, adapter, item, (section, key), partial=partial)
        for key, item in value.items()
        if well_named(source, section, key)
    }


def check_item(source: Source, section: str, path: Path, value: Any, *, partial: bool = False) -> Any:
    """Return an item of a section checked and in SI, or None when it is faulty, wherever it stands."""
    return check(source, _adapter(section, True), value, path, partial=partial)


def refuse_form(source: Source, path: Path, value: Any, kind: type[Any]) -> None:
    """Report what is not the list or mapping it must be."""
    what, accepted = WORDING["list_type" if kind is list else "dict_type"]
    source.report(path, what, received=shown(value), accepted=accepted)


def well_named(source: Source, section: str, key: str) -> bool:
    """Tell whether a key of a section is a name, having reported it where not."""
    names = TypeAdapter(get_args(document().model_fields[section].annotation)[0])
    return check(source, names, key, (section, key)) is not None


def check(source: Source, adapter: TypeAdapter[Any], value: Any, path: Path, *, partial: bool = False) -> Any:
    """Return ``value`` read by a type, or None when it is faulty; ``partial`` allows required keys to be missing."""
    try:
        return adapter.validate_python(value)
    except ValidationError as fault:
        for place, error in _flat(fault, path):
            if not (partial and error["type"] == "missing"):
                _report(source, adapter, path, place, error)
        return None


def _flat(fault: ValidationError, path: Path) -> Iterator[tuple[Path, Any]]:
    """Yield each error with its whole path, those of models chosen by a validator included."""
    for error in fault.errors(include_url=False):
        place = (*path, *(step for step in error["loc"] if step != "[key]"))
        inner = error.get("ctx", {}).get("error")
        if isinstance(inner, ValidationError):
            yield from _flat(inner, place)
        else:
            yield place, error


def _report(source: Source, adapter: TypeAdapter[Any], path: Path, place: Path, error: Any) -> None:
    inner = error.get("ctx", {}).get("error")
    received = shown(error["input"])
    if isinstance(inner, WordError):
        source.report(place, inner.what, received=inner.received, accepted=inner.accepted, hint=inner.hint)
    elif error["type"] == "extra_forbidden":
        known = keys_at(adapter, place[len(path) : -1])
        word = str(place[-1])
        hint = (_elsewhere(word) if ENTITIES & {*place} else "") or did_you_mean(word, known)
        source.report(place, "unknown key", received=repr(word), accepted=", ".join(known), hint=hint)
    elif error["type"] == "missing":
        source.report(place, "is missing", accepted=_meaning(adapter, place[len(path) :]))
    elif error["type"] in WORDING:
        what, accepted = WORDING[error["type"]]
        accepted = _form(_nodes(adapter, place[len(path) :]), error["input"]) or accepted
        source.report(place, what, received=received, accepted=accepted)
    else:
        source.report(place, error["msg"][0].lower() + error["msg"][1:], received=received)


def _elsewhere(word: str) -> str:
    """Return which parts of an entity have a word, nothing where none has."""
    having = [part for part, words in _parts_of_entities().items() if word in words]
    last = having.pop() if having else ""
    return f"{', '.join(having)} and {last} have it" if having else f"{last} has it" if last else ""


@cache
def _parts_of_entities() -> dict[str, list[str]]:
    """Return the words of each part of an entity, such as those of ``body``."""
    adapter = _adapter("entities", True)
    return {part: keys_at(adapter, (part,)) for part in keys_at(adapter, ())}


def _form(nodes: list[dict[str, Any]], received: Any) -> str:
    """Return the keys of the mapping, or the form of the list, that a type takes where it received something else."""
    for node in nodes:
        if node.get("properties"):
            return ", ".join(node["properties"])
        if "minItems" in node:
            return f"a list of {node['minItems']}"
        if isinstance(received, str) and node.get("items", {}).get("type") == "string":
            return f"[{shown(received)}]"
    return ""


def keys_at(adapter: TypeAdapter[Any], steps: Path) -> list[str]:
    """Return the keys a mapping may have that stands ``steps`` below a type."""
    return [key for node in _nodes(adapter, steps) for key in node.get("properties", {})]


def _meaning(adapter: TypeAdapter[Any], steps: Path) -> str:
    parents = _nodes(adapter, steps[:-1])
    found = [node["properties"][steps[-1]] for node in parents if steps[-1] in node.get("properties", {})]
    return found[0].get("description", "") if found else ""


@cache
def _schema(adapter: TypeAdapter[Any]) -> dict[str, Any]:
    return adapter.json_schema()


def _nodes(adapter: TypeAdapter[Any], steps: Path) -> list[dict[str, Any]]:
    """Return the nodes of the JSON Schema that describe what stands ``steps`` below a type, unions opened."""
    whole = _schema(adapter)
    nodes = _opened(whole, [whole])
    for step in steps:
        under = [
            node.get("properties", {}).get(step) or node.get("items") or node.get("additionalProperties")
            for node in nodes
        ]
        nodes = _opened(whole, [node for node in under if isinstance(node, dict)])
    return nodes


def _opened(whole: dict[str, Any], nodes: list[dict[str, Any]]) -> list[dict[str, Any]]:
    opened: list[dict[str, Any]] = []
    for node in nodes:
        if "$ref" in node:
            node = whole["$defs"][node["$ref"].rpartition("/")[2]]
        opened += _opened(whole, node["anyOf"]) if "anyOf" in node else [node]
    return opened
