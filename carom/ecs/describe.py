"""Describe: entities, tables, queries and worlds in words, from what their columns declare."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.ecs.column import Column

if TYPE_CHECKING:
    from carom.ecs.component import Component, Record
    from carom.ecs.query import Query
    from carom.ecs.world import World

MOST = 8  # numbers of a vector, or names in a list, after which only the count of the others is told
WIDTH = 100  # characters after which a list goes on in the next line


class Part(NamedTuple):
    """One component of an entity: (column, value with unit, meaning) of each, and those at their default in short."""

    key: str
    told: list[tuple[str, str, str]]
    defaults: list[str]


def describe(world: World, entity: int) -> str:
    """Return an entity in words; raise EntityError for a stale handle."""
    parts, lists = describe_parts(world, entity), describe_lists(world, entity)
    lines = [describe_heading(world, entity)]
    for part in parts:
        if part.told:
            widths = [max(len(line[i]) for line in part.told) for i in range(2)]
            lines.append(f"  {part.key}")
            lines += [f"    {name:{widths[0]}}  {value:{widths[1]}}  {doc}" for name, value, doc in part.told]
        if part.defaults:
            lines += _wrapped("    default: " if part.told else f"  {part.key}, default: ", part.defaults)
    for word, names in lists.items():
        lines += _wrapped(f"  {word}: ", names)
    return "\n".join(lines)


def describe_heading(world: World, entity: int) -> str:
    """Return the name, if there is one, and the handle."""
    name = str(world.names_of(np.array([entity]))[0])
    return f"{name}, entity {int(entity)}" if name else f"entity {int(entity)}"


def describe_parts(world: World, entity: int) -> list[Part]:
    """Return what the components of an entity hold, without its name, tags, caches and what every step derives."""
    kinds = world.components(entity)
    return [_part(world, entity, kind) for kind in kinds if kind.columns and kind.key != "name" and not kind.derived()]


def describe_lists(world: World, entity: int) -> dict[str, list[str]]:
    """Return tags, those it carries and derived components, where there are any."""
    kinds = world.components(entity)
    lists = {
        "tags": [kind.key for kind in kinds if not kind.columns],
        "carries": shortened(world.name(child) for child in world.children(entity).tolist()),
        "derived": [kind.key for kind in kinds if kind.columns and kind.derived()],
    }
    return {word: names for word, names in lists.items() if names}


def describe_component(world: World, entity: int, kind: type[Component]) -> str:
    """Return one component of an entity in a line."""
    row, arrays = world.row(entity), world.table(kind).arrays
    values = [f"{name} {value_text(world, column, arrays[name][row])}" for name, column in kind.columns.items()]
    return f"{kind.key}: {', '.join(values)}" if values else kind.key


def describe_table(world: World, kind: type[Record]) -> str:
    """Return how many rows a kind has, and its notable columns with their units."""
    notable = notable_columns(kind)
    columns = [f"{name}{shape_text(column)}" for name, column in notable.items()]
    if others := len(kind.columns) - len(notable):
        columns.append(f"and {others} derived")
    return f"{kind.__name__}, {counted(world.count(kind), 'row')}" + (f": {', '.join(columns)}" if columns else "")


def describe_bundle(bundle: Record) -> str:
    """Return the call that makes a bundle."""
    values = ", ".join(f"{name}={_text(value.tolist(), None)}" for name, value in vars(bundle).items())
    return f"{type(bundle).__name__}({values})"


def describe_query(query: Query) -> str:
    """Return what a query asks for, and how many entities it finds."""
    asked = {"with": query.kinds, "without": query.without, "any of": query.any_of, "optional": query.optional}
    words = [f"{word} {', '.join(kind.key for kind in kinds)}" for word, kinds in asked.items() if kinds]
    return "; ".join([counted(len(query), "entity", "entities"), *words])


def describe_world(world: World) -> str:
    """Return the frame and how many rows each kind has."""
    counts = sorted(f"{kind.key} {world.count(kind)}" for kind in world.tables if world.count(kind))
    return describe_size(world) + (f": {', '.join(counts)}" if counts else "")


def describe_size(world: World) -> str:
    """Return the frame and how many entities live."""
    living = int(np.count_nonzero(world.slots.alive))
    return f"World in frame {world.frame}, {counted(living, 'entity', 'entities')}"


def value_text(world: World, column: Column, value: Any) -> str:
    """Return the value of one row with its unit: ``(0, 1.5, 0) m``, and entities by their names."""
    text = _text(np.asarray(value).tolist(), world if column.holds == "entities" else None)
    return text if column.unit == "1" else f"{text} {column.unit}"


def notable_columns(kind: type[Record]) -> dict[str, Column]:
    """Return the columns worth a glance: those that are derived only where there are no others."""
    if kind.derived():
        return kind.columns
    return {name: column for name, column in kind.columns.items() if column.role in ("state", "input")}


def shape_text(column: Column) -> str:
    """Return how many numbers a row of a column holds and their unit, to stand behind its name: `` (3) m``."""
    shape = f" ({' x '.join(map(str, column.shape))})" if column.shape else ""
    return shape if column.unit == "1" else f"{shape} {column.unit}"


def counted(count: int, one: str, several: str = "") -> str:
    """Return a count with its noun."""
    return f"{count} {one if count == 1 else several or one + 's'}"


def shortened(texts: Iterable[str]) -> list[str]:
    """Return the first texts of a list, and how many more there are."""
    every = list(texts)
    return every if len(every) <= MOST else [*every[:MOST], f"... {len(every) - MOST} more"]


def _part(world: World, entity: int, kind: type[Component]) -> Part:
    row, part = world.row(entity), Part(kind.key, [], [])
    for name, column in kind.columns.items():
        if column.role == "cache":
            continue
        value = world.table(kind).arrays[name][row]
        text = value_text(world, column, value)
        if np.array_equal(value, np.broadcast_to(column.default, column.shape)):
            part.defaults.append(f"{name} {text}")
        else:
            part.told.append((name, text, column.doc))
    return part


def _text(value: Any, world: World | None) -> str:
    if isinstance(value, list):
        return f"({', '.join(shortened(_text(item, world) for item in value))})"
    if world is not None:
        return _who(world, value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value + 0.0:.6g}"  # + 0.0 takes the sign from -0
    return repr(value)


def _who(world: World, entity: int) -> str:
    if entity < 0:
        return "none"
    return world.name(entity) if entity in world else f"none ({world.slots.fate(entity)})"


def _wrapped(start: str, items: list[str]) -> list[str]:
    indent = " " * (len(start) - len(start.lstrip()) + 2)
    joined = ", ".join(item.replace(" ", "\xa0") for item in items)  # so that no line ends within a vector
    wrap = textwrap.TextWrapper(WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return [line.replace("\xa0", " ") for line in wrap.wrap(start + joined)]
