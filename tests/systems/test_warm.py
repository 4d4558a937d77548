"""Warming the cache compiles every kernel there is."""

from __future__ import annotations

from pathlib import Path

import pytest
from processes import run

WITHOUT_JIT = """
import sys
from carom.systems.kernels.kernel import Kernel
from carom.systems.kernels.warm import PARTS

called = set()
run = Kernel.__call__
Kernel.__call__ = lambda kernel, *arguments: called.add(kernel.name) or run(kernel, *arguments)
for part in PARTS:
    part()
modules = [vars(module) for name, module in sys.modules.items() if name.startswith("carom.")]
there = {value.name for module in modules for value in module.values() if isinstance(value, Kernel)}
print(len(there) > 50, sorted(there - called))
"""
RICH = """
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

corners = [(x, y, z) for x in (-4.0, 4.0) for y in (-1.0, 0.0) for z in (-4.0, 4.0)]
convex = {"convex": {"points": [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]}}
round_ones = [{key: {"radius": 0.5, "length": 1.0}} for key in ("capsule", "cylinder", "cone")]
shapes = [{"sphere": {"radius": 0.5}}, {"box": {"size": (1.0, 1.0, 1.0)}}, convex, *round_ones]
for ground in ({"plane": {}}, {"shape": Mesh(hull_of(corners))}):
    simulation = Simulation()
    simulation.add(collider=ground)
    for k in range(24):
        place = {"position": (0.4 * (k % 3), 0.6 + 0.9 * (k // 3), 0.3 * (k % 2))}
        simulation.add(collider=shapes[k % len(shapes)], body={}, transform=place)
    simulation.force("linear_drag", coefficient=1.0)
    simulation.step(60)
"""


def test_every_kernel_is_called() -> None:
    """Each has one specialisation, so one call compiles it; without the JIT, where indices are checked as well."""
    said, _ = run("-W", "ignore", "-c", WITHOUT_JIT, NUMBA_DISABLE_JIT="1")
    assert said == "True []\n"


def test_the_key_is_the_same_in_every_process() -> None:
    """And names Numba and the processor."""
    (key, _), again = (run("-m", "carom.tools.cli", "warm", "--key") for _ in range(2))
    assert again == (key, "")
    assert key.startswith("carom-kernels-numba-") and key.count("\n") == 1


@pytest.mark.slow
def test_after_warming_nothing_is_compiled(tmp_path: Path) -> None:
    """A heap of every shape, on a plane and on a mesh, finds all it needs."""
    run("-m", "carom.tools.cli", "warm", NUMBA_CACHE_DIR=str(tmp_path))
    before = sorted(tmp_path.rglob("*"))
    assert run("-c", RICH, NUMBA_CACHE_DIR=str(tmp_path)) == ("", "")
    assert sorted(tmp_path.rglob("*")) == before
