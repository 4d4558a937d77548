"""What a breakpoint costs in each step of a world of 1,000 bodies that lie in heaps."""

from __future__ import annotations

from collections.abc import Iterator

from carom.systems.breakpoints import look
from carom.tools.bench.measure import Figure, figure, timed
from carom.worlds.breaks import break_when
from carom.worlds.builder import load_text

HEAPS = """
carom: 1
entities:
  - {name: floor, collider: {plane: {}}}
  - name: crate
    grid: {count: [16, 4, 16], spacing: [2, 1, 2], origin: [0, 0.5, 0]}
    collider: {box: {size: [1, 1, 1]}}
    body: {}
"""
CONDITIONS = {  # us each may take
    "speed(crate[0,0,0]) > 20": 20.0,
    "distance(crate[0,0,0], floor) > 3 m and speed(crate[1,0,0]) > 3 m/s": 20.0,
    "crate[*].position.y < -1 m": 20.0,
    "overlap > 1 m": 20.0,
    "not finite": 20.0,
    "energy rises 5 %": 20.0,
}
CALLS = 100


def figures() -> Iterator[Figure]:
    """Yield what it takes to ask each condition once."""
    for text, bound in CONDITIONS.items():
        simulation = load_text(HEAPS, "heaps.yaml").simulation
        simulation.step(5)
        breakpoints = break_when(simulation, text)

        def ask() -> None:
            for _ in range(CALLS):
                look(breakpoints, simulation)  # noqa: B023, it is called in this turn of the loop

        yield figure(f"break on {text}", "us", timed(ask, 51), bound, 1e6 / CALLS)
