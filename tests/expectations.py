"""A small world, and what becomes of what it is made to expect."""

from __future__ import annotations

from lessons import run

from carom.worlds import load_text
from carom.worlds.expectation import Outcome

# A ball falls 1.22625 m in 0.5 s and comes back to its height at 1 s; a disc rests on the ground; a sensor waits.
WORLD = """carom: 1
step: {dt: 1/120}
run: {duration: 1 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: ball
    collider: {sphere: {radius: 0.05}}
    body: {mass: 2}
    material: {restitution: 1}
    transform: {position: [0, 1.27625, 0]}
  - {name: gate, collider: {box: {size: [1, 0.1, 1]}, sensor: true}, transform: {position: [0, 0.5, 0]}}
  - {name: stone, collider: {sphere: {radius: 0.1}}, body: {mass: 1}, transform: {position: [3, 0.1, 0]}}
expect:
  - """


def outcomes(expectation: str, world: str = WORLD) -> list[Outcome]:
    """Run the world to its end and return what became of the expectation."""
    return run(load_text(world + expectation))
