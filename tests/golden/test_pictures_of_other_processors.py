"""Pictures are the same whatever vectors the processor has: what arranges them (NumPy) and what draws them (Mesa)."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy._core._multiarray_umath import __cpu_baseline__, __cpu_features__

from carom.tools.snapshot_kit.picture import patch_difference

WORLDS = ("billiards", "bounce", "head_on", "jump", "trap")
DRAW = """
import sys
import numpy as np
from carom.tools.filming import shot_of
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.worlds import load_world

path, floors, *worlds = sys.argv[1:]
pictures = {}
with Renderer(320, 240) as renderer:
    for name in worlds:
        loaded = load_world(name)
        world = loaded.simulation.world
        batches = [batch for batch in Scene(world).batches() if floors == "floors" or batch.floor is None]
        pictures[name] = renderer.picture(batches, shot_of(loaded).camera(world))
    print(renderer.driver)
np.savez(path, **pictures)
"""
# Mesa 22.3.6 told to use vectors of 128 bits on a processor that has wider ones corrupts its memory where it clips
# the large triangles of a floor, so these are left out then.
OTHERS = {
    "numpy": ("floors", {"NPY_DISABLE_CPU_FEATURES": " ".join(
        name for name, found in __cpu_features__.items() if found and name not in __cpu_baseline__
    )}),
    "mesa": ("none", {"LP_NATIVE_VECTOR_WIDTH": "128"}),
}  # fmt: skip


def drawn(path: Path, floors: str, **environment: str) -> tuple[str, dict[str, np.ndarray]]:
    """Return the driver and the pictures of a process of its own."""
    command = [sys.executable, "-c", DRAW, str(path), floors, *WORLDS]
    run = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    with np.load(path) as pictures:
        return run.stdout.strip(), dict(pictures)


@pytest.mark.slow
@pytest.mark.parametrize("other", OTHERS)
def test_narrow_vectors_draw_the_same(other: str, tmp_path: Path) -> None:
    """To the last bit, which is far less than the picture layer lets pass."""
    floors, environment = OTHERS[other]
    driver, here = drawn(tmp_path / "here.npz", floors)
    narrow, there = drawn(tmp_path / "there.npz", floors, **environment)
    if other == "mesa" and "llvmpipe" in driver:
        assert "128 bits" in narrow
    for name, picture in here.items():
        assert patch_difference(there[name], picture).max() == 0.0, name
