"""On a machine without any OpenGL: libraries that cannot be loaded stand before the real ones in the loader's path."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from carom.tools.offscreen import PLATFORM_VARIABLE

LIBRARIES = (
    "libOSMesa.so", "libOSMesa.so.6", "libOSMesa.so.8", "libEGL.so", "libEGL.so.1", "libEGL_mesa.so.0", "libGL.so",
    "libGL.so.1", "libGLX.so.0", "libGLdispatch.so.0", "libOpenGL.so.0", "libGLESv2.so.2",
)  # fmt: skip
COMMANDS = """
import ctypes, sys
from contextlib import suppress
from carom.tools.cli import main
with suppress(OSError):
    sys.exit(f"there is OpenGL: {ctypes.CDLL('libGL.so.1')}")
for words in sys.argv[1:]:
    print(main(words.split()), flush=True)
"""
NEEDS = (
    "pictures need software OpenGL, and neither libOSMesa.so nor libEGL.so.1 was found; accepted: either of them; "
    "run: sudo apt-get install -y libosmesa6 (or, where that package does not exist, libegl1 libgl1-mesa-dri); "
    "simulating, checking and recording work without it"
)


@pytest.mark.skipif(sys.platform != "linux", reason="hides libraries as the loader of Linux finds them")
def test_a_machine_without_opengl_simulates_checks_and_records_and_says_what_pictures_need(tmp_path: Path) -> None:
    """Exit 0 for all that takes no picture, 2 for what does, before anything runs or is written."""
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    for name in LIBRARIES:
        (hidden / name).touch()
    environment = {name: value for name, value in os.environ.items() if name != PLATFORM_VARIABLE}
    environment["LD_LIBRARY_PATH"] = os.pathsep.join([str(hidden), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])])
    does = ("check falling_ball", "test falling_ball", "run falling_ball --record fall.rrd", "query fall.rrd energy")
    needs = ("run falling_ball --record again.rrd --picture fall.png", "render falling_ball --out fall.png")
    done = subprocess.run(
        [sys.executable, "-c", COMMANDS, *does, *needs], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert [line for line in done.stdout.splitlines() if line in ("0", "1", "2")] == ["0"] * len(does) + ["2"] * 2
    assert done.stderr.splitlines() == [NEEDS] * len(needs)
    assert "7 of 7 expectations held" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} == {"hidden", "fall.rrd"}
