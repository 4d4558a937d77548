"""A viewer for tests where there is no display: what carom starts is Rerun's own, without its window."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from carom.tools import showing, viewer


@contextmanager
def windowless(folder: Path, patch: pytest.MonkeyPatch) -> Iterator[str]:
    """Let carom take this machine for one with a display; lend the address where what it starts will listen."""
    script, port = folder / "rerun", viewer.free_port()
    number = folder / "rerun.pid"
    script.write_text(f'#!/bin/sh\necho $$ > {number}\nexec {viewer.viewer_binary()} --headless "$@" 2>/dev/null\n')
    script.chmod(0o755)
    patch.setattr(viewer, "viewer_binary", lambda: script)
    patch.setattr(viewer, "has_display", lambda: True)
    patch.setattr(viewer, "PORT", port)
    patch.setattr(showing, "free_port", lambda: port)
    try:
        yield viewer.address(port)
    finally:
        if number.exists():
            with suppress(ProcessLookupError):  # it was closed already
                os.kill(int(number.read_text()), signal.SIGKILL)
