"""The same world leads to the same bits: in another process, on a simpler processor, and without the JIT."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from crews import parts_taken

from carom.ecs import state_hash
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation
from carom.systems.threads import Threads

TESTS = Path(__file__).parents[1]
FRAMES = 240
WORLDS = ("billiards", "stack", "cannon", "fireworks", "heap")  # heap: solids stirred in shallow water
HASHES = """
import itertools
import sys
import numpy as np
from heaps import stirred_heap as heap
from carom.ecs import state_hash
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation
from carom.worlds import load_world

def stack():
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    for k in range(3):
        box = {"box": {"size": (1.0, 1.0, 1.0)}}
        simulation.add(collider=box, body={}, transform={"position": (0.1 * k, 0.55 + 1.1 * k, 0.0)})
    return simulation

def shapes():
    cube = hull_of(np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]))
    kinds = (
        {"sphere": {"radius": 0.5}},
        {"capsule": {"radius": 0.3, "length": 0.4}},
        {"box": {"size": (1.0, 1.0, 1.0)}},
        {"convex": {"points": cube.vertices}},
        {"shape": Mesh(cube)},
    )
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    for k, (a, b) in enumerate(itertools.combinations_with_replacement(kinds[::-1], 2)):
        for height, kind in ((0.5, a), (1.5, b)):
            body = {} if "shape" in kind else {"body": {}}
            simulation.add(collider=kind, transform={"position": (3.0 * k, height, 0.0)}, **body)
    return simulation

def column():
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    for k in range(4):
        box, place = {"box": {"size": (1.0, 1.0, 1.0)}}, {"position": (0.01 * k, 0.52 + k, 0.0)}
        simulation.add(collider=box, body={}, transform=place, motion={"linear": (0.0, -6.0, 0.0)})
    return simulation

frames, worlds = int(sys.argv[1]), sys.argv[2:]
for name in worlds:
    simulation = globals()[name]() if name in ("stack", "shapes", "heap", "column") else load_world(name).simulation
    for _ in range(frames):
        simulation.step()
        print(name, simulation.frame, state_hash(simulation.world))
"""


def hashes(frames: int, *worlds: str, **environment: str) -> list[str]:
    """Return a line per frame with the state hash, from a process of its own."""
    command = [sys.executable, "-W", "error::RuntimeWarning", "-c", HASHES, str(frames), *worlds]
    environment["PYTHONPATH"] = os.pathsep.join(filter(None, (str(TESTS), os.environ.get("PYTHONPATH"))))
    run = subprocess.run(
        command, env=os.environ | environment, capture_output=True, text=True, check=False, timeout=500
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


def wide_features() -> str:
    """Return the features of this processor, beyond numpy's baseline, that use 256 or 512 bits or fuse operations."""
    from numpy._core._multiarray_umath import __cpu_baseline__, __cpu_features__

    wide = [name for name, found in __cpu_features__.items() if found and ("AVX" in name or "FMA" in name)]
    return " ".join(name for name in wide if name not in __cpu_baseline__)


@pytest.fixture(scope="module")
def here() -> list[str]:
    """Return the hashes of a process with all that this machine has."""
    return hashes(FRAMES, *WORLDS)


def test_another_process_gives_the_same_bits(here: list[str]) -> None:
    """Two processes agree in every frame."""
    assert hashes(FRAMES, *WORLDS) == here


@pytest.mark.slow
def test_a_processor_without_wide_vectors_gives_the_same_bits(here: list[str], tmp_path: Path) -> None:
    """AVX, AVX2, AVX-512 and fused operations turned off for NumPy and Numba change no bit of any frame."""
    assert hashes(
        FRAMES, *WORLDS,
        NPY_DISABLE_CPU_FEATURES=wide_features(),
        NUMBA_CPU_NAME="generic",
        NUMBA_CPU_FEATURES="",
        NUMBA_CACHE_DIR=str(tmp_path),
    ) == here  # fmt: skip


def test_kernels_do_the_same_without_the_jit(here: list[str]) -> None:
    """Every kernel runs as plain Python under NUMBA_DISABLE_JIT=1, gives the same bits and makes no warning.

    A column that lands is swept on.
    """
    frames, further = 3, ("shapes", "column")
    plain = hashes(frames, *WORLDS, *further, NUMBA_DISABLE_JIT="1")
    assert plain == [line for line in here if int(line.split()[1]) <= frames] + hashes(frames, *further)


FEWEST = 64  # bodies, pairs or contacts that are shared here, fewer than pays


def crowd(threads: int, *, come: bool = True) -> list[str]:
    """Return the hashes of 8 steps of 343 cubes and balls that fall on each other, shared by so many threads.

    ``come`` says whether others than the first ever do.
    """
    simulation = Simulation(threads=threads)
    simulation.add(collider={"plane": {}})
    for k in range(343):
        collider = {"box": {"size": (1.0, 1.0, 1.0)}} if k % 5 else {"sphere": {"radius": 0.5}}
        place = (1.02 * (k % 7) + 0.03 * (k // 49), 0.52 + 1.03 * (k // 49), 1.02 * (k // 7 % 7) - 0.02 * (k // 49))
        simulation.add(collider=collider, body={}, transform={"position": place})
    found = []
    for _ in range(8):
        simulation.step()
        found.append(state_hash(simulation.world))
        if threads == 4 and simulation.frame == 4:  # a world may ask for more of them at any time
            simulation.settings = replace(simulation.settings, threads=5)
    assert simulation.world[Resting].count >= FEWEST
    if threads > 1:
        assert (sum(parts_taken(simulation.world[Threads].crew)) > 0) == come
    return found


def test_threads_share_the_work_and_not_a_bit_changes(monkeypatch: pytest.MonkeyPatch) -> None:
    """One and two threads, four, and five from the fourth step on, lead a crowd the same way, whoever comes."""
    monkeypatch.setattr("carom.systems.threads.processors", lambda: 8)
    monkeypatch.setattr("carom.systems.threads.FEWEST", FEWEST)
    alone = crowd(1)
    assert crowd(2) == alone
    assert crowd(4) == alone
    monkeypatch.setattr("carom.systems.threads.ring", lambda bells: None)
    assert crowd(3, come=False) == alone
