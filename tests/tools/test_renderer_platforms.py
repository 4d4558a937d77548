"""One scene is one picture: in other processes to the bit, by EGL where there is no OSMesa, and without a window."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from carom.tools import offscreen


def test_where_there_is_no_osmesa_egl_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """The backend falls back to EGL when only its libraries load."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: "EGL" in libraries[0])
    assert offscreen.backend() == "egl"


DRAW = """
import numpy as np
from trimesh.creation import box
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
cube = box(extents=(1.0, 1.0, 1.0))
with Renderer(64, 48) as renderer:
    Renderer(64, 48).close()
    drawn = [Batch(cube.vertices, cube.faces, np.eye(4)[None], np.ones((1, 4)), np.zeros(1, np.int64))]
    camera = Camera((0.0, 0.0, 3.0))
    print(renderer.driver.partition(":")[0], (renderer.ids(drawn, camera) == 0).sum())
    print(round(renderer.picture(drawn, camera).mean()))
"""


@pytest.mark.skipif(not offscreen.loads(("libEGL.so.1", "libEGL_mesa.so.0")), reason="no libEGL on this machine")
def test_egl_draws_the_same_scene() -> None:
    """Each backend covers the pixels that geometry demands, and all give the same mean brightness.

    That another renderer was made and closed meanwhile is nothing to the first.
    """
    drawn = {}
    for name in ("egl", "osmesa"):
        if name == "osmesa" and not any(map(offscreen.loads, offscreen.LIBRARIES[name])):
            continue
        environment = {**os.environ, offscreen.PLATFORM_VARIABLE: name}
        done = subprocess.run([sys.executable, "-c", DRAW], env=environment, capture_output=True, text=True, check=True)
        said, covered, mean = done.stdout.split()
        assert said == name
        drawn[name] = (int(covered), int(mean))
    # The near face, 2.5 m away, is 23.2 pixels high: 23 or 24 rows of as many pixel centres.
    assert all(covered in (22 * 22, 23 * 23, 24 * 24) for covered, _ in drawn.values())
    assert len({mean for _, mean in drawn.values()}) == 1


WITHOUT_OSMESA = """
from carom.tools import offscreen
offscreen.LIBRARIES["osmesa"] = (("libOSMesa-that-is-not-there.so",),)
"""


@pytest.mark.skipif(not offscreen.loads(("libEGL.so.1", "libEGL_mesa.so.0")), reason="no libEGL on this machine")
def test_where_osmesa_is_missing_egl_draws_without_being_asked() -> None:
    """In a process whose loader finds no libOSMesa the driver is EGL's, and the cube is drawn."""
    environment = {name: value for name, value in os.environ.items() if name != offscreen.PLATFORM_VARIABLE}
    command = [sys.executable, "-c", WITHOUT_OSMESA + DRAW]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    said, covered, _ = done.stdout.split()
    assert (said, int(covered)) in (("egl", 23 * 23), ("egl", 24 * 24))


def test_no_library_of_windows_is_needed() -> None:
    """Where pyglet, which looks for those of X11 as it is imported, cannot be, the cube is drawn all the same."""
    command = [sys.executable, "-c", "import sys; sys.modules['pyglet'] = None" + DRAW]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert int(done.stdout.split()[1]) in (23 * 23, 24 * 24)


def test_frames_are_bit_identical_in_other_processes() -> None:
    """Pictures, depths and ids of shadowed, translucent and curved bodies have one hash, whatever the threads."""
    hashes = {
        subprocess.run(
            [sys.executable, "-c", HASH],
            env={**os.environ, "LP_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("0", "2", "5")
    }
    assert len(hashes) == 1 and len(hashes.pop().split()) == 3


HASH = """
import hashlib
import numpy as np
from trimesh.creation import box, icosphere
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
rng = np.random.default_rng(5)
batches = []
for mesh, smooth, alpha in ((box(extents=(9, 0.1, 9)), False, 1), (box(), False, 1), (icosphere(), True, 0.5)):
    poses = np.tile(np.eye(4), (20, 1, 1))
    poses[:, :3, 3] = rng.uniform(-3, 3, (20, 3))
    colors = np.column_stack([rng.uniform(0, 1, (20, 3)), np.full(20, alpha)])
    batches.append(Batch(mesh.vertices, mesh.faces, poses, colors, np.arange(20), smooth))
with Renderer(160, 120) as renderer:
    for camera in (Camera((2.0, 5.0, 9.0)), Camera((2.0, 5.0, 9.0), height=8.0)):
        parts = renderer.picture(batches, camera), renderer.depth(batches, camera), renderer.ids(batches, camera)
        told = [hashlib.sha256(part.tobytes()).hexdigest() for part in parts]
print(*told)
"""
