"""Picture size: how large a picture can be, by the driver and by the memory that is free."""

from __future__ import annotations

import math
from pathlib import Path

from carom.ecs.errors import CaromError

SAMPLES = 4
BYTES = (SAMPLES + 1) * (4 + 4)  # a pixel: colour and depth, of every sample and of the picture they become


def refuse_size(width: int, height: int, most: int) -> None:
    """Raise CaromError for a picture (px) without area, beyond the driver's ``most`` each way, or beyond memory."""
    received = f"received {width} x {height}"
    if width < 1 or height < 1:
        raise CaromError(f"renderer: width and height must be at least 1 px, {received}")
    if max(width, height) > most:
        raise CaromError(f"renderer: width and height must be at most {most} px for this driver, {received}")
    needed, free = width * height * BYTES, free_memory()
    if needed > free:
        raise CaromError(
            f"renderer: a picture of {width} x {height} px needs {needed / 1e9:.2f} GB of memory, "
            f"and {free / 1e9:.2f} GB are free; ask for a smaller one"
        )


def free_memory() -> float:
    """Return the memory (bytes) that programs can still have; infinite where the system does not tell."""
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    except OSError:
        return math.inf
    told = {name: words.split() for name, _, words in (line.partition(":") for line in lines)}
    return 1024.0 * float(told["MemAvailable"][0]) if "MemAvailable" in told else math.inf
