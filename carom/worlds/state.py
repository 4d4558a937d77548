"""State: what a world in mid-run holds beyond its words, at the end of a file that carom wrote."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from pydantic import Field

from carom.ecs import World, restore_snapshot, snapshot_from_bytes, state_hash, take_snapshot
from carom.ecs.column import Integers
from carom.ecs.errors import SnapshotError
from carom.ecs.snapshot_bytes import bytes_from_snapshot
from carom.systems.compound import StatedBodies
from carom.systems.forces import Forces
from carom.worlds.source import Source
from carom.worlds.values import Words

SNAPSHOT = ("state", "snapshot")
LINE = 120  # characters of a line of the snapshot
MOST_BYTES = 1 << 30  # of a snapshot: a short text of zeros would unfold without end
LEFT_OUT = (
    "is of other words than those above, so it is left out and the world begins with these; "
    "state is for files as carom wrote them: remove it, or undo what was changed"
)


class StateWords(Words):
    """What words cannot say of a world that was written in mid-run; not for people to write."""

    of: str = Field(description="hash of the state that the words above give")
    snapshot: str = Field(description="the whole state: a snapshot, compressed by zlib, in base64")


def state_words(world: World, of: World) -> dict[str, str]:
    """Return the section that makes of the world ``of``, which words give, this one."""
    packed = base64.b64encode(zlib.compress(bytes_from_snapshot(take_snapshot(world)), 9)).decode()
    lines = [packed[first : first + LINE] for first in range(0, len(packed), LINE)]
    return {"of": state_hash(of), "snapshot": "\n".join([*lines, ""])}


def take_state(source: Source, world: World, state: StateWords | None) -> None:
    """Give a world the state its file ends with, and report one that cannot be.

    It is left out, with a warning, where the words do not give the state it was written beside: whoever has changed
    them since wants to see the change, which a snapshot would undo.
    """
    if state is None or source.faults:
        return
    if state_hash(world) != state.of:
        source.warn(("state",), LEFT_OUT)
        return
    before = _living(world)
    try:
        restore_snapshot(world, snapshot_from_bytes(_unpacked(state.snapshot), world, "it"))
    except SnapshotError as fault:
        source.report(SNAPSHOT, "; ".join(str(fault).split("\n  ")))
        return
    after = _living(world)
    if not np.array_equal(before, after):
        _renumber(world, dict(zip(before.tolist(), after.tolist(), strict=False)))


def _unpacked(text: str) -> bytes:
    """Return the bytes of a snapshot; raise SnapshotError for a text that holds none."""
    unpacking = zlib.decompressobj()
    try:
        data = unpacking.decompress(base64.b64decode("".join(text.split()), validate=True), MOST_BYTES)
    except (ValueError, zlib.error) as fault:
        raise SnapshotError(f"it is damaged: {fault}; write the world anew") from None
    if not unpacking.eof:
        cut = "is cut off" if len(data) < MOST_BYTES else f"is larger than {MOST_BYTES:,} bytes"
        raise SnapshotError(f"it {cut}; write the world anew")
    return data


def _living(world: World) -> Integers:
    """Return the handles of all who live, in order of rows: that of the words of entities."""
    return np.asarray(world.handles()[world.slots.alive[: world.used()]])


def _renumber(world: World, handles: Mapping[int, int]) -> None:
    """Let what was stated of entities be of those who have the same places now, whatever their handles."""
    bodies, forces, anew = world[StatedBodies], world[Forces], Forces()
    bodies.words = {handles.get(entity, entity): words for entity, words in bodies.words.items()}
    for entries in forces.entries.values():
        for law, reach in entries:
            whom = reach.entities
            entities = None if whom is None else tuple(handles.get(entity, entity) for entity in whom)
            anew.add(law, replace(reach, entities=entities))
    forces.entries, forces.limits = anew.entries, anew.limits
