"""Python in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys


def run(*words: str, **variables: str) -> tuple[str, str]:
    """Return what Python says on stdout and stderr, given these words."""
    environment = {**os.environ, "CAROM_CHECK": "", "PYTHONPATH": os.pathsep.join(sys.path), **variables}
    done = subprocess.run([sys.executable, *words], env=environment, capture_output=True, text=True, check=True)
    return done.stdout, done.stderr
