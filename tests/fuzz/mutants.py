"""Mutants: files that somebody could hand in, made of good worlds by a random number generator of their case."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import odd
import yaml

from carom.worlds import library

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"```yaml\n(.*?)```", re.DOTALL)
DUMPER: Any = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
LONGEST = 200_000  # characters of a mutant
Place = tuple[Any, Any]  # a list or mapping, and the number or key of an item in it


@cache
def seeds() -> list[str]:
    """Return the texts of good worlds: the library's and those of the docs."""
    blocks = [block for page in sorted(DOCS.glob("*.md")) for block in BLOCK.findall(page.read_text(encoding="utf-8"))]
    worlds = [library.find(name).read_text(encoding="utf-8") for name in library.names()]
    return [*worlds, *(block for block in blocks if "carom: 1" in block)]


@cache
def trees() -> list[Any]:
    """Return the seeds as plain data."""
    return [yaml.load(text, getattr(yaml, "CBaseLoader", yaml.BaseLoader)) for text in seeds()]


@cache
def words() -> list[str]:
    """Return every key of the seeds, sorted."""
    return sorted({key for tree in trees() for holder, key in places(tree) if isinstance(holder, dict)})


@cache
def values() -> dict[str, list[Any]]:
    """Return what stands under each key of the seeds."""
    found: dict[str, list[Any]] = {}
    for tree in trees():
        for holder, key in places(tree):
            if isinstance(holder, dict):
                found.setdefault(key, []).append(holder[key])
    return found


def places(data: Any) -> Iterator[Place]:
    """Yield every place of plain data."""
    for key in list(data) if isinstance(data, dict) else range(len(data)) if isinstance(data, list) else ():
        yield data, key
        yield from places(data[key])


def mutant(case: int) -> dict[str, bytes]:
    """Return the files of a case, by their names; the first is the world."""
    draws = Random(case)
    kind = draws.choice((of_text, of_tree, of_tree, of_tree, of_two))
    files = {"world.yaml": kind(draws)[:LONGEST]}
    if b"part.yaml" in files["world.yaml"]:
        files["part.yaml"] = draws.choice((of_text, of_tree))(draws)[:LONGEST]
    return files


def of_text(draws: Random) -> bytes:
    """Return a seed with characters and bytes changed."""
    text = draws.choice(seeds())
    for _ in range(draws.randint(1, 4)):
        text = draws.choice(ON_TEXT)(draws, text)
    data = bytearray(text.encode("utf-8", "surrogatepass"))
    if draws.random() < 0.15:
        for _ in range(draws.randint(1, 3)):
            data[draws.randrange(len(data) or 1) : draws.randrange(len(data) or 1)] = draws.randbytes(1)
    return bytes(data)


def of_tree(draws: Random) -> bytes:
    """Return a seed with values and keys changed."""
    tree = deepcopy(draws.choice(trees()))
    for _ in range(draws.randint(1, 4)):
        if found := list(places(tree)):
            draws.choice(ON_TREE)(draws, tree, *draws.choice(found))
    if draws.random() < 0.1 and (found := list(places(tree))):  # at last, since it may make the tree endless
        _share(draws, tree, *draws.choice(found))
    return written(tree)


def of_two(draws: Random) -> bytes:
    """Return sections and entities of two seeds together."""
    first, second = (deepcopy(draws.choice(trees())) for _ in range(2))
    for key, value in second.items():
        if isinstance(value, list) and isinstance(first.get(key), list) and draws.random() < 0.5:
            first[key] += value
        elif isinstance(value, dict) and isinstance(first.get(key), dict) and draws.random() < 0.5:
            first[key] |= value
        elif draws.random() < 0.5:
            first[key] = value
    return written(first)


def written(tree: Any) -> bytes:
    """Return data as YAML, texts that seeds have without quotes without them."""
    try:
        text = yaml.dump(tree, Dumper=DUMPER, default_flow_style=None, width=120, allow_unicode=True, sort_keys=False)
    except (RecursionError, yaml.YAMLError):
        return b"carom: 1\nentities: [" + b"[" * 5000
    plain = re.sub(r"'([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|true|false|\.inf|\.nan)'", r"\1", str(text))
    return plain.encode("utf-8", "surrogatepass")


def _delete_text(draws: Random, text: str) -> str:
    start = draws.randrange(len(text) + 1)
    return text[:start] + text[start + draws.choice((1, 1, 3, 20, 500)) :]


def _insert_text(draws: Random, text: str) -> str:
    start = draws.randrange(len(text) + 1)
    return text[:start] + draws.choice(odd.TOKENS) * draws.choice((1, 1, 1, 2, 5000)) + text[start:]


def _repeat_text(draws: Random, text: str) -> str:
    start = draws.randrange(len(text) + 1)
    part = text[start : start + draws.choice((1, 10, 100, 1000))]
    return text[:start] + part * draws.choice((2, 2, 3, 50)) + text[start:]


def _swap_lines(draws: Random, text: str) -> str:
    lines = text.split("\n")
    first, second = draws.randrange(len(lines)), draws.randrange(len(lines))
    lines[first], lines[second] = lines[second], lines[first]
    return "\n".join(lines)


def _other_number(draws: Random, text: str) -> str:
    found = list(re.finditer(r"\d+(?:\.\d+)?", text))
    if not found:
        return text
    number = draws.choice(found)
    return text[: number.start()] + draws.choice(odd.NUMBERS) + text[number.end() :]


def _cut(draws: Random, text: str) -> str:
    return text[: draws.randrange(len(text) + 1)]


def _delete(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    del holder[key]


def _replace(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    holder[key] = deepcopy(draws.choice(odd.VALUES))


def _number(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    numbers = [place for place in places(tree) if re.match(r"[-+.]?\d", str(place[0][place[1]]))]
    if numbers:
        holder, key = draws.choice(numbers)
        unit = re.sub(r"^[-+.\d/e]*", "", str(holder[key])) if draws.random() < 0.5 else draws.choice(odd.UNITS)
        holder[key] = draws.choice(odd.NUMBERS) + unit


def _other_value(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    holder[key] = deepcopy(draws.choice(values().get(key) or values()[draws.choice(words())]))


def _add(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    inside = holder[key] if isinstance(holder[key], dict) else holder
    word = draws.choice(words())
    if isinstance(inside, dict):
        inside[word] = deepcopy(draws.choice(values()[word]))
    elif isinstance(inside, list):
        inside.append(deepcopy(draws.choice(values()[word])))


def _rename(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    if isinstance(holder, dict):
        holder[draws.choice((draws.choice(words()), draws.choice(odd.TEXTS)))] = holder.pop(key)


def _swap(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    other, there = draws.choice(list(places(tree)))
    holder[key], other[there] = deepcopy(other[there]), deepcopy(holder[key])


def _repeat(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    if isinstance(holder, list):
        holder += [deepcopy(holder[key])] * draws.choice((1, 2, 30))


def _nest(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    for _ in range(draws.choice((1, 1, 2, 40, 70, 200))):
        holder[key] = [holder[key]] if draws.random() < 0.5 else {draws.choice(words()): holder[key]}


def _share(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    """Let one thing stand in two places, by an alias; it may be around itself."""
    other, there = draws.choice(list(places(tree)))
    holder[key] = draws.choice((other, other[there]))


def _expression(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    holder[key] = draws.choice(odd.EXPRESSIONS)


def _section(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    if isinstance(tree, dict):
        tree |= deepcopy(draws.choice(odd.SECTIONS))


def _copies(draws: Random, tree: Any, holder: Any, key: Any) -> None:
    """State copies, particles or links on some entity."""
    entities = tree.get("entities") if isinstance(tree, dict) else None
    entity = draws.choice(entities) if isinstance(entities, list) and entities else None
    if isinstance(entity, dict):
        entity |= deepcopy(draws.choice(odd.COPIES))


TextChange = Callable[[Random, str], str]
TreeChange = Callable[[Random, Any, Any, Any], None]
ON_TEXT: list[TextChange] = [_delete_text, _insert_text, _repeat_text, _swap_lines, _other_number, _other_number, _cut]
ON_TREE: list[TreeChange] = [
    _delete, _replace, _replace, _number, _number, _number, _other_value, _other_value, _add, _add, _rename, _swap,
    _repeat, _nest, _expression, _section, _copies,
]  # fmt: skip
