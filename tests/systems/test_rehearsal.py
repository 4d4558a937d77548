"""What most steps need is loaded before the first one."""

from __future__ import annotations

import numpy as np
import pytest
from processes import run

from carom.ecs.relations.contact import Contact
from carom.systems.detection import meshes
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

FALLING = """
from carom.systems.kernels.stored import Stored
from carom.systems.simulation import Simulation

loaded, load = [], Stored.load_overload

def note(stored, *arguments):
    loaded.append(stored._function.__qualname__)
    return load(stored, *arguments)

Stored.load_overload = note
simulation = Simulation(checked=False)
simulation.add(collider={"plane": {}})
for k, shape in enumerate(({"sphere": {"radius": 0.5}}, {"box": {"size": (1.0, 1.0, 1.0)}})):
    for height in (1.0, 2.5):
        simulation.add(collider=shape, body={}, transform={"position": (4.0 * k, height, 0.0)})
small = {"box": {"size": (0.4, 0.4, 0.4)}}
for k in range(60):
    place = {"position": (8.0 + 0.45 * (k % 5), 0.5 + 0.9 * (k // 25), 0.45 * (k // 5 % 5))}
    simulation.add(collider=small, body={}, transform=place)
simulation.add(collider={"box": {"size": (0.1, 9.0, 9.0)}}, transform={"position": (30.0, 4.0, 0.0)})
flies = {"linear": (60.0, 3.0, 0.0), "angular": (9.0, 20.0, 5.0)}
simulation.add(collider=small, body={}, transform={"position": (20.0, 2.0, 0.0)}, motion=flies)
simulation.step()
at_first = len(loaded)
simulation.step(180)
print(at_first > 50, loaded[at_first:])
"""


COMPILING = """
from contextlib import nullcontext
from carom.systems import rehearsal

rehearsal.only_stored = nullcontext
"""


def test_little_is_loaded_where_bodies_meet() -> None:
    """Only what measures their shapes, of which there are many; a process before that compiles what is not stored."""
    run("-c", COMPILING + FALLING, NUMBA_DISABLE_JIT="0")
    said, _ = run("-c", FALLING, NUMBA_DISABLE_JIT="0")
    assert said == "True ['measure_boxes_on_planes']\n"


def test_meshes_are_packed_before_anybody_meets_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the first step: a tree over 20,000 triangles takes 30 ms."""
    packed: list[Geometry] = []
    tree_of = meshes.tree_of
    monkeypatch.setattr(meshes, "tree_of", lambda geometry: packed.append(geometry) or tree_of(geometry))
    ground = hull_of(np.array([(x, y, z) for x in (-4.0, 4.0) for y in (-1.0, 0.0) for z in (-4.0, 4.0)]))
    simulation = Simulation()
    simulation.add(collider={"shape": Mesh(ground)})
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 2.0, 0.0)})
    simulation.step()
    assert packed == [ground]
    simulation.step(60)
    assert simulation.world.count(Contact) > 0
    assert packed == [ground]
