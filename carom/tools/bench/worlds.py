"""Bench of world files: from a text to a world that is ready to step, from a world to a text, and anew when saved."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

from carom.tools.bench.measure import Figure, figure, timed
from carom.tools.watching import Watching
from carom.worlds import library, load_text, load_world, world_text

ENTITIES = 10_000
HEAD = """carom: 1
materials: {ivory: {restitution: 0.9}}
prefabs: {ball: {collider: {sphere: {radius: 0.1}}, body: {mass: 1}, material: ivory}}
entities:
"""


def alike() -> str:
    """Return a world whose entities are written one by one, differing in where they are and how fast."""
    place = "transform: {{position: [{0}, 1, 0]}}, motion: {{linear: [0, {0} mm/s, 0]}}"
    return HEAD + "".join(f"  - {{name: ball_{n}, prefab: ball, {place.format(n)}}}\n" for n in range(ENTITIES))


def different() -> str:
    """Return a world whose entities are written one by one, each of its own size and mass."""
    words = "collider: {{box: {{size: [1, {0} mm, 1]}}}}, body: {{mass: {0} g}}, transform: {{position: [0, {0}, 0]}}"
    return HEAD + "".join(f"  - {{name: box_{n}, {words.format(n + 1)}}}\n" for n in range(ENTITIES))


def computed() -> str:
    """Return a world whose entities are written one by one, each with expressions and a parameter."""
    text = HEAD.replace("prefabs: {", 'variables: {step: 0.3 m}\nprefabs: {stone: {parameters: {size: 1 m}, '
                        'collider: {sphere: {radius: "${size / 2}"}}}, ')  # fmt: skip
    words = 'parameters: {{size: {1} mm}}, transform: {{position: ["${{step * {0}}}", 0, 0]}}'
    return text + "".join(
        f"  - {{name: s_{n}, prefab: stone, {words.format(n, n % 90 + 10)}}}\n" for n in range(ENTITIES)
    )


def generated(words: str) -> str:
    """Return a world whose entities a generator makes."""
    return HEAD + f"  - {{name: rain, prefab: ball, {words}}}\n"


CASES = {  # what is loaded, its text, the bound in s
    "10,000 entities, alike but for pose": (alike, 2.0),
    "10,000 entities, all different": (different, 2.0),
    "10,000 entities with expressions": (computed, float("inf")),
    "10,000 on a grid": (lambda: generated("grid: {count: [100, 10, 10], spacing: 0.3}"), 0.3),
    "10,000 at random, none in another": (lambda: generated("random: {count: 10000, box: [20, 20, 20]}"), 0.3),
    "10,000 in a heap": (lambda: generated("heap: {count: 10000, area: [8, 8]}"), 0.3),
}


def figures() -> Iterator[Figure]:
    """Yield seconds from text to world, the first of which, that also builds the schema, does not count."""
    load_text(HEAD + "  - {name: one, prefab: ball}\n")
    for name, (text, bound) in CASES.items():
        words = text()
        yield figure(name, "s", timed(lambda words=words: load_text(words), 5), bound)  # type: ignore[misc]
    world = load_text(generated("grid: {count: [100, 10, 10], spacing: 0.3}"))
    yield figure("10,000 entities written and read again", "s", timed(lambda: world_text(world), 3), float("inf"))
    with TemporaryDirectory() as folder:
        yield replace(figure("saved and loaded anew by --watch", "s", timed(saving(Path(folder)), 5), 0.5), by="wall")


def saving(folder: Path) -> Callable[[], object]:
    """Return what saves a world of the library and waits until it is loaded anew."""
    path, text, saves = folder / "w.yaml", library.find("billiards").read_text(encoding="utf-8"), count(1)
    path.write_text(text, encoding="utf-8")
    watching = Watching(path, lambda: load_world(path))
    watching.wait()

    def save() -> object:
        path.write_text(text + "#" * next(saves), encoding="utf-8")
        return watching.wait()

    return save
