"""A jump does not depend on how fast pictures are drawn: its steps are the same to the last bit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from carom.ecs import Transform
from carom.ecs.column import Floats
from carom.systems.simulation import Simulation
from carom.worlds import load_world

FIGURES = ("hopper", "runner", "climber", "laggard")
STEPS = 180  # 1.5 s
DT = 1 / 120


class Arc:
    """Notes the position of every figure after every step."""

    def __init__(self) -> None:
        self.positions: list[bytes] = []

    def begin(self, simulation: Simulation) -> None:
        """Nothing is to be done."""

    def observe(self, simulation: Simulation) -> None:
        """Note the bits."""
        self.positions.append(figures(simulation, simulation[Transform]).tobytes())

    def end(self, simulation: Simulation) -> None:
        """Nothing is to be done."""


def figures(simulation: Simulation, transform: Transform) -> Floats:
    """Return the positions of the figures in a table of poses."""
    rows = simulation.world.slots.rows(np.array([simulation.world.find(name) for name in FIGURES]))
    return np.asarray(transform.position[rows])


def jump() -> tuple[Simulation, Arc]:
    """Return the world `jump`, watched."""
    simulation, arc = load_world("jump").simulation, Arc()
    simulation.observers.append(arc)
    return simulation, arc


@pytest.fixture(scope="module")
def plain() -> list[bytes]:
    """Return the arc of plain steps."""
    simulation, arc = jump()
    simulation.step(STEPS)
    return arc.positions


def jittered(rate: int, seed: int, seconds: float) -> Iterator[float]:
    """Yield frames of ``rate`` a second, each up to 40 % early or late, that last ``seconds`` together."""
    generator, left = np.random.default_rng(seed), seconds
    while (frame := float(generator.uniform(0.6, 1.4)) / rate) < left:
        yield frame
        left -= frame
    yield left


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("rate", [30, 60, 144])
def test_the_arc_does_not_depend_on_the_frame_rate(rate: int, seed: int, plain: list[bytes]) -> None:
    """Every step of the arc is bit-equal, the steps are as many, and each picture lies between two of them."""
    simulation, arc = jump()
    passed = 0.0
    for seconds in jittered(rate, seed, STEPS * DT):
        part = simulation.advance(seconds)
        passed += seconds
        assert (simulation.frame + part) * DT == pytest.approx(passed, abs=1e-9)
        if simulation.frame < 2:
            continue
        shown = figures(simulation, simulation.between(part))
        last, now = (np.frombuffer(plain[simulation.frame - k]).reshape(-1, 3) for k in (2, 1))
        assert (shown >= np.minimum(last, now) - 1e-15).all()
        assert (shown <= np.maximum(last, now) + 1e-15).all()
        assert shown == pytest.approx(last + part * (now - last), abs=1e-15)
    assert simulation.frame == STEPS
    assert simulation.clock.dropped == 0.0
    assert arc.positions == plain


def test_a_hitch_takes_time_but_leaves_the_arc(plain: list[bytes]) -> None:
    """Frames of up to a second amid others: no step is different, and what was dropped is told to 1e-12 s."""
    simulation, arc = jump()
    frames = [*jittered(60, 4, 0.4), 1.0, *jittered(144, 5, 0.3), 0.7, 0.2501]
    part = [simulation.advance(seconds) for seconds in frames][-1]
    clock = simulation.clock
    assert clock.dropped > 1.0
    assert clock.dropped / DT == pytest.approx(round(clock.dropped / DT), abs=1e-9)
    assert (simulation.frame + part) * DT + clock.dropped == pytest.approx(sum(frames), abs=1e-12)
    assert arc.positions == plain[: simulation.frame]
