"""Goldens: what a world was when somebody accepted it, in two layers: its physical state and its picture."""

from __future__ import annotations

import hashlib
import json
import platform
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Component, Motion, Transform, World
from carom.ecs.column import Integers
from carom.ecs.slots import as_numbers
from carom.ecs.snapshot import held_columns

LOOKS = ("visual.", "material.color")  # columns that change a picture but no motion
KEY_COLUMNS: tuple[tuple[type[Component], str], ...] = (
    (Transform, "position"),
    (Transform, "rotation"),
    (Motion, "linear"),
    (Motion, "angular"),
)
Keys = dict[str, dict[str, list[float]]]
Picture = npt.NDArray[np.uint8]

NOTICED = 16  # a pixel counts as different beyond this difference of its worst channel, of 255
LIMIT = 2e-4  # fraction of such pixels on the driver that drew the golden: catches a body moved by 1 cm in a 3 m scene
LIMIT_ELSEWHERE = 2e-2  # and on others, whose edges differ


@dataclass(frozen=True)
class Machine:
    """What the last bit of a state may depend on."""

    processor: str
    numpy: str
    numba: str


@dataclass(frozen=True)
class StateGolden:
    """Digests of every physical state column, and poses and velocities by name for where their bits need not agree."""

    machine: Machine
    frame: int
    digests: dict[str, str]
    keys: Keys
    driver: str | None = None

    def text(self) -> str:
        """Return the golden as JSON, readable in a diff."""
        return json.dumps(asdict(self), indent=1) + "\n"

    @classmethod
    def read(cls, text: str) -> StateGolden:
        """Return what `text` wrote."""
        values = json.loads(text)
        return cls(**values | {"machine": Machine(**values["machine"])})


def this_machine() -> Machine:
    """Return what this process computes with."""
    config: Any = np.show_config(mode="dicts")
    features = ",".join(config.get("SIMD Extensions", {}).get("found", []))
    processor = f"{platform.machine()} {hashlib.blake2b(features.encode(), digest_size=4).hexdigest()}"
    return Machine(processor, np.__version__, version("numba"))


def state_golden(world: World, driver: str | None = None) -> StateGolden:
    """Return the physical state of a world now."""
    digests = {}
    for kind, rows, names in held_columns(world):
        for name in names:
            if not f"{kind.key}.{name}".startswith(LOOKS):
                digests[f"{kind.key}.{name}"] = _digest(as_numbers(rows), world.table(kind).read(name, rows))
    return StateGolden(this_machine(), world.frame, digests, _keys(world), driver)


def _digest(rows: Integers, values: npt.NDArray[Any]) -> str:
    return hashlib.blake2b(rows.tobytes() + values.tobytes(), digest_size=8).hexdigest()


def _keys(world: World) -> Keys:
    found: Keys = {}
    for kind, name in KEY_COLUMNS:
        values = world.table(kind).arrays[name]
        for row in world.row_numbers(kind):
            found.setdefault(world.name(world.entity(row)), {})[f"{kind.key}.{name}"] = values[row].tolist()
    return found


def state_fault(actual: StateGolden, golden: StateGolden, tolerance: float) -> str | None:
    """Return what differs in the physical state, or None.

    Where the machine is the one that wrote the golden every bit counts; elsewhere poses and velocities may differ by
    ``tolerance`` (m, m/s, rad/s).
    """
    if actual.frame != golden.frame:
        return f"the world is in frame {actual.frame}, the golden in {golden.frame}"
    exact = actual.machine == golden.machine
    for entity in sorted(golden.keys.keys() | actual.keys.keys()):
        if entity not in actual.keys or entity not in golden.keys:
            return f"entity '{entity}' is only in the {'golden' if entity in golden.keys else 'world'}"
        for column, expected in golden.keys[entity].items():
            received = actual.keys[entity].get(column)
            if received is None:
                return f"entity '{entity}' has no {column} any more"
            if not _agree(received, expected, 0.0 if exact else tolerance):
                allowed = "exactly" if exact else f"within {tolerance:g}"
                return f"{column} of entity '{entity}' is {received}, expected {allowed} {expected}"
    if exact and actual.digests != golden.digests:
        names = sorted(k for k in actual.digests | golden.digests if actual.digests.get(k) != golden.digests.get(k))
        return f"poses and velocities agree, but not {', '.join(names)}"
    return None


def _agree(received: list[float], expected: list[float], tolerance: float) -> bool:
    return bool(np.allclose(received, expected, rtol=0.0, atol=tolerance, equal_nan=True))


def picture_fault(actual: Picture, golden: Picture, *, same_driver: bool) -> str | None:
    """Return by how much two pictures differ when that is too much, or None."""
    if actual.shape != golden.shape:
        return (
            f"the picture is {actual.shape[1]} x {actual.shape[0]} px, the golden {golden.shape[1]} x {golden.shape[0]}"
        )
    share = float((difference(actual, golden) > NOTICED).mean())
    limit = LIMIT if same_driver else LIMIT_ELSEWHERE
    if share <= limit:
        return None
    where = "the driver that drew the golden" if same_driver else "another driver than the golden's"
    return f"{share:.3%} of the pixels differ by more than {NOTICED} of 255, at most {limit:.2%} may on {where}"


def difference(actual: Picture, golden: Picture) -> Picture:
    """Return the difference (height, width) of the worst channel."""
    worst: Picture = np.abs(actual.astype(np.int16) - golden).max(axis=2).astype(np.uint8)
    return worst


def read_picture(path: Path) -> Picture:
    """Return a PNG as (height, width, 3)."""
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


def write_picture(path: Path, picture: Picture) -> None:
    """Write a picture (height, width) or (height, width, 3) as PNG."""
    from PIL import Image

    Image.fromarray(picture).save(path)
