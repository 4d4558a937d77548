"""State: the layer of a golden that holds what physics made of a world."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Component, Motion, Transform, World
from carom.ecs.column import Integers
from carom.ecs.slots import as_numbers
from carom.ecs.snapshot import held_columns
from carom.tools.machine import Machine, this_machine

LOOKS = ("visual.", "material.color")  # columns that change a picture but no motion
KEY_COLUMNS: tuple[tuple[type[Component], str], ...] = (
    (Transform, "position"),
    (Transform, "rotation"),
    (Motion, "linear"),
    (Motion, "angular"),
)
Keys = dict[str, dict[str, Any]]


@dataclass(frozen=True)
class StateGolden:
    """Digests of every physical state column, and by entity and name what is compared where bits need not agree.

    That is poses, velocities, and whatever the components of a game hold.
    """

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
    for kind, name in (*KEY_COLUMNS, *_columns_of_games(world)):
        values, entities = world.table(kind).arrays[name], kind.columns[name].holds == "entities"
        for row in world.row_numbers(kind):
            value = world.name(int(values[row])) if entities else values[row].tolist()
            found.setdefault(world.name(world.entity(row)), {})[f"{kind.key}.{name}"] = value
    return found


def _columns_of_games(world: World) -> Iterator[tuple[type[Component], str]]:
    """Yield the state columns of components that carom does not declare."""
    for kind, _, names in held_columns(world):
        if issubclass(kind, Component) and not kind.__module__.startswith("carom."):
            yield from ((kind, name) for name in names)


@dataclass(frozen=True)
class StateFault:
    """What differs first in the physical state, as a sentence and, where one entity has it, in parts."""

    what: str
    entity: str = ""
    column: str = ""
    expected: str = ""
    actual: str = ""


def state_fault(actual: StateGolden, golden: StateGolden, tolerance: float) -> StateFault | None:
    """Return what differs in the physical state, or None.

    Where the machine is the one that wrote the golden every bit counts; elsewhere poses, velocities and floats of games
    may differ by ``tolerance`` (m, m/s, rad/s, or what their unit is). With none, every bit counts there too.
    """
    if actual.frame != golden.frame:
        return StateFault(f"the world is in frame {actual.frame}, the golden in {golden.frame}")
    exact = not tolerance or actual.machine == golden.machine
    found = list(_differing(actual.keys, golden.keys, 0.0 if exact else tolerance))
    if found:
        others = len({fault.entity for fault in found}) - 1
        more = f"; {others} {'entity differs' if others == 1 else 'entities differ'} as well" if others else ""
        return replace(found[0], what=found[0].what + more)
    if exact and actual.digests != golden.digests:
        names = sorted(k for k in actual.digests | golden.digests if actual.digests.get(k) != golden.digests.get(k))
        return StateFault(f"poses and velocities agree, but not {', '.join(names)}", column=names[0])
    return None


def _differing(actual: Keys, golden: Keys, tolerance: float) -> Iterator[StateFault]:
    """Yield what differs column by column, entities in order of their names."""
    allowed = f"within {tolerance:g}" if tolerance else "exactly"
    for entity in sorted(golden.keys() | actual.keys()):
        if entity not in actual or entity not in golden:
            yield StateFault(f"entity '{entity}' is only in the {'golden' if entity in golden else 'world'}", entity)
            continue
        for column, expected in golden[entity].items():
            received = actual[entity].get(column)
            if received is None:
                yield StateFault(f"entity '{entity}' has no {column} any more", entity, column, str(expected))
            elif not _agree(received, expected, tolerance):
                what = f"{column} of entity '{entity}' is {received}, expected {allowed} {expected}"
                yield StateFault(what, entity, column, str(expected), str(received))


def _agree(received: Any, expected: Any, tolerance: float) -> bool:
    if received == expected:
        return True
    values, wanted = np.asarray(received), np.asarray(expected)
    numbers = values.dtype.kind == wanted.dtype.kind == "f" and values.shape == wanted.shape
    return numbers and np.allclose(values, wanted, rtol=0.0, atol=tolerance, equal_nan=True)
