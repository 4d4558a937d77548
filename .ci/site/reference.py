"""Reference: commands, words of world files and defaults, as the code itself states them."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Iterator
from typing import Any

from carom.tools.cli import parser
from carom.worlds.schema import json_schema

EMPTY = (None, "", [], {})
WIDTH = "110"  # characters of a line of help


def commands() -> str:
    """Return the page of the command line: the help of every command."""
    os.environ["COLUMNS"] = WIDTH
    whole = parser()
    (group,) = (one for one in whole._actions if isinstance(one, argparse._SubParsersAction))
    parts = [f"# Commands\n\n{shown(whole)}"]
    parts += [f"## carom {name}\n\n{shown(single)}" for name, single in group.choices.items()]
    return "\n".join(parts)


def shown(of: argparse.ArgumentParser) -> str:
    """Return the help of a parser as a block."""
    return f"```text\n{of.format_help()}```\n"


def defaults() -> str:
    """Return the table of what holds where nobody states anything else."""
    schema = json_schema()
    parts = {"": schema, **{f"{name.lower()}.": schema["$defs"][name] for name in ("Step", "Body", "Material")}}
    rows = (
        (f"`{prefix}{name}`", said(one["default"]), one.get("description", ""))
        for prefix, part in parts.items()
        for name, one in part["properties"].items()
        if one.get("default") not in EMPTY
    )
    return table(("word", "by default", "meaning"), rows)


def words() -> str:
    """Return the page of the words of world files: the sections of a file, then whatever they hold, by name."""
    schema = json_schema()
    parts = ["# World files\n", f"{schema['description']} `carom schema` prints all of it for editors.\n"]
    parts.append("## Sections\n\n" + properties(schema))
    for name, part in sorted(schema["$defs"].items(), key=lambda item: title(item[0])):
        about = part.get("description", "").replace("\n", " ")
        parts.append(f"## {title(name)} {{#{name}}}\n\n{about}\n\n{properties(part)}")
    return "\n".join(parts)


def title(name: str) -> str:
    """Return what a definition is called on the page: two of one name are told apart by where they are from."""
    return name.rpartition("__")[2].removesuffix("Words")


def properties(part: dict[str, Any]) -> str:
    """Return the table of the words of a part."""
    needed = part.get("required", ())

    def rows() -> Iterator[tuple[str, str, str, str]]:
        for name, one in part.get("properties", {}).items():
            default = "must be stated" if name in needed else ""
            default = default if one.get("default") in EMPTY else said(one["default"])
            yield f"`{name}`", kinds(one), default, one.get("description", "")

    return table(("word", "is", "by default", "meaning"), rows())


def said(value: Any) -> str:
    """Return a value as a file says it."""
    return f"`{value:.4g}`" if isinstance(value, float) else f"`{json.dumps(value)}`".replace('"', "")


def kinds(one: dict[str, Any]) -> str:
    """Return what a value may be, with links to its parts."""
    if "$ref" in one:
        name = one["$ref"].rpartition("/")[2]
        return f"[{title(name)}](#{name})"
    if "anyOf" in one:
        told = (kinds(each) for each in one["anyOf"] if "pattern" not in each)  # of units and expressions
        return " or ".join(dict.fromkeys(filter(None, told)))
    if "const" in one:
        return f"`{one['const']}`"
    if "enum" in one:
        return ", ".join(f"`{each}`" for each in one["enum"])
    if one.get("type") == "array" and isinstance(one.get("items"), dict):
        return f"list of {kinds(one['items'])}"
    if one.get("type") == "object" and isinstance(one.get("additionalProperties"), dict):
        return f"names with {kinds(one['additionalProperties'])}"
    kind = one.get("type", "anything")
    return "" if kind == "null" else " or ".join(kind) if isinstance(kind, list) else str(kind)


def table(head: tuple[str, ...], rows: Any) -> str:
    """Return a table in Markdown."""
    lines = [head, ("---",) * len(head), *rows]
    return "".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |\n" for line in lines)
