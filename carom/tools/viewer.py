"""Viewer: Rerun's own program, which comes with its package: where it is, whether one runs, and how one is started."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path
from socket import create_connection, socket
from urllib.parse import urlsplit

from carom.ecs.errors import CaromError

PORT = 9876  # Rerun's own
PORTS = {"rerun+http": 80, "rerun+https": 443, "rerun": 443}  # by scheme, of an address that states none
DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
PATIENCE = 60.0  # s until a viewer must listen, on a busy machine


def viewer_binary() -> Path:
    """Return the viewer itself: the ``rerun`` script starts it as a child, which outlives a signal to the script."""
    package = find_spec("rerun_cli")
    for folder in package.submodule_search_locations or () if package else ():
        for name in ("rerun", "rerun.exe"):
            if (Path(folder) / name).is_file():
                return Path(folder) / name
    raise CaromError("the Rerun viewer is missing from this installation; run: pip install --force-reinstall rerun-sdk")


def address(port: int) -> str:
    """Return the address of a viewer on this machine."""
    return f"rerun+http://127.0.0.1:{port}/proxy"


def free_port() -> int:
    """Return a port of this machine that nobody listens on."""
    with socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def has_display() -> bool:
    """Tell whether a window can be opened."""
    return sys.platform != "linux" or any(map(os.environ.get, DISPLAYS))


def listens(url: str) -> bool:
    """Tell whether a viewer listens at an address; raise CaromError for what is none."""
    try:
        parts = urlsplit(url)
        place = parts.hostname, parts.port or PORTS.get(parts.scheme)
    except ValueError:  # a port that is no number
        parts, place = urlsplit(""), (None, None)
    host, port = place
    if parts.scheme not in PORTS or parts.path != "/proxy" or host is None or port is None:
        raise CaromError(f"{url!r} is no address of a viewer; accepted: rerun+http://HOST:PORT/proxy")
    return answers(host, port)


def answers(host: str, port: int) -> bool:
    """Tell whether anybody listens on a port of a machine."""
    try:
        with create_connection((host, port), timeout=2.0):
            return True
    except OSError:
        return False


def start_viewer(port: int, *options: str) -> subprocess.Popen[bytes]:
    """Open a window that listens on a port and outlives this process; raise CaromError when none comes."""
    words = [str(viewer_binary()), "--port", str(port), "--hide-welcome-screen", *options]
    quiet = {"RUST_LOG": "error", **os.environ}
    process = subprocess.Popen(words, env=quiet, start_new_session=True)
    deadline = time.monotonic() + PATIENCE
    while not listens(address(port)):
        if process.poll() is not None or time.monotonic() > deadline:
            process.kill()
            raise CaromError("the Rerun viewer did not start; what it says is above; `carom doctor` tells what works")
        time.sleep(0.05)
    return process


def running_viewer(stated: str | None) -> str:
    """Return the address of a running viewer: the stated one, else this machine's own, started where none runs.

    Raises CaromError where there is none.
    """
    url = stated or address(PORT)
    if listens(url):
        return url
    if stated is not None:
        raise CaromError(f"no viewer listens at {url}; start one there with: rerun")
    if not has_display():
        raise CaromError(
            f"no viewer listens at {url}, and there is no display to open one on; "
            "serve one to a browser: rerun --serve-web"
        )
    start_viewer(PORT)
    return url
