"""Debug: what breakpoints and comparisons of runs cost."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from carom.tools.bench import break_rows, diff_rows
from carom.tools.bench.measure import Figure


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {"break": break_rows.figures, "diff": diff_rows.figures}
