"""Display: worlds, tables, queries and entities as small HTML tables, the way notebooks show what a cell returns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

from carom.ecs.column import Column
from carom.ecs.describe import (
    counted,
    describe_heading,
    describe_lists,
    describe_parts,
    describe_query,
    describe_size,
    notable_columns,
    shape_text,
    value_text,
)

if TYPE_CHECKING:
    from carom.ecs.component import Record
    from carom.ecs.query import Query
    from carom.ecs.world import World

ROWS = 20


def query_html(query: Query) -> str:
    """Return the first entities of a query with the values of their components."""
    world, rows = query.world, query.numbers[:ROWS]
    handles = query.entities[:ROWS]
    columns = {"entity": [str(handle) for handle in handles.tolist()], "name": world.names_of(handles).tolist()}
    for kind in dict.fromkeys((*query.kinds, *query.optional)):
        held = query.has(kind)[:ROWS]
        if not kind.columns:
            columns[kind.key] = ["true" if has else "false" for has in held]
        for name, column in {} if kind.key == "name" else notable_columns(kind).items():
            values = zip(world.table(kind).arrays[name][rows], held, strict=True)
            texts = [_cell(world, column, value) if has else "" for value, has in values]
            columns[_header(f"{kind.key}.{name}", column)] = texts
    return _html(describe_query(query), columns, len(query))


def relation_html(world: World, kind: type[Record]) -> str:
    """Return the first rows of a relation."""
    count, arrays = world.count(kind), world.table(kind).arrays
    columns = {
        _header(name, column): [_cell(world, column, value) for value in arrays[name][: min(count, ROWS)]]
        for name, column in notable_columns(kind).items()
    }
    return _html(f"{kind.__name__}, {counted(count, 'row')}", columns, count)


def entity_html(world: World, entity: int) -> str:
    """Return the components of an entity, column by column."""
    lines = []
    for part in describe_parts(world, entity):
        lines += [(part.key, *line) for line in part.told]
        if part.defaults:
            lines.append((part.key, "default", ", ".join(part.defaults), ""))
    lines += [(word, "", ", ".join(names), "") for word, names in describe_lists(world, entity).items()]
    columns = _transposed(("component", "column", "value", "meaning"), lines)
    return _html(describe_heading(world, entity), columns, len(lines))


def world_html(world: World) -> str:
    """Return the kinds a world has rows of, with their columns."""
    kinds = sorted((kind for kind in world.tables if world.count(kind)), key=lambda kind: kind.key)
    lines = [
        (kind.key, str(world.count(kind)), ", ".join(name + shape_text(c) for name, c in notable_columns(kind).items()))
        for kind in kinds
    ]
    return _html(describe_size(world), _transposed(("table", "rows", "columns"), lines), len(lines))


def _header(path: str, column: Column) -> str:
    return path if column.unit == "1" else f"{path} ({column.unit})"


def _cell(world: World, column: Column, value: object) -> str:
    text = value_text(world, column, value)
    return text if column.unit == "1" else text.removesuffix(f" {column.unit}")


def _transposed(headers: tuple[str, ...], lines: Sequence[tuple[str, ...]]) -> dict[str, list[str]]:
    return {header: [line[i] for line in lines] for i, header in enumerate(headers)}


def _html(title: str, columns: dict[str, list[str]], total: int) -> str:
    """Return a table of texts, of which the first rows are given; everything is escaped."""
    lines = [_line("th", columns), *(_line("td", cells) for cells in zip(*columns.values(), strict=True))]
    if total > ROWS:
        lines[ROWS + 1 :] = [f'<tr><td colspan="{len(columns)}">... {total - ROWS} more</td></tr>']
    return f"<table><caption>{escape(title)}</caption>{''.join(lines)}</table>"


def _line(tag: str, cells: Iterable[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"
