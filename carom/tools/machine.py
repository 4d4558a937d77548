"""Machine: what the last bit of a state may depend on."""

from __future__ import annotations

import hashlib
import platform
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Machine:
    """What the last bit of a state may depend on."""

    processor: str
    numpy: str
    numba: str


def this_machine() -> Machine:
    """Return what this process computes with."""
    config: Any = np.show_config(mode="dicts")
    features = ",".join(config.get("SIMD Extensions", {}).get("found", []))
    processor = f"{platform.machine()} {hashlib.blake2b(features.encode(), digest_size=4).hexdigest()}"
    return Machine(processor, np.__version__, version("numba"))
