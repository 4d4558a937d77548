"""Motion: who sleeps, who is fast, and what players and cameras ask of a world every frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from carom.tools.bench import motion_rows, ray_rows
from carom.tools.bench.measure import Figure


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    "rays": ray_rows.figures,
    "sleep": motion_rows.sleep,
    "fast": motion_rows.fast,
}
