"""Fields: what forces between very many cost, and how near they are."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from carom.tools.bench import gravity_rows, particle_rows
from carom.tools.bench.measure import Figure


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    "particles": particle_rows.figures,
    "gravity": gravity_rows.figures,
}
