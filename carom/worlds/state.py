"""State: what a world in mid-run holds beyond its words, at the end of a file that carom wrote."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import Field

from carom.ecs import World, restore_snapshot, snapshot_from_bytes, state_hash, take_snapshot
from carom.ecs.column import Integers
from carom.ecs.errors import DeclarationError, SnapshotError
from carom.ecs.snapshot_bytes import bytes_from_snapshot
from carom.systems.compound import StatedBodies
from carom.systems.forces import Forces
from carom.systems.shapes.geometry import Geometries, Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.model_files import triangles
from carom.worlds.geometry import Corner, MeshWords
from carom.worlds.source import Source
from carom.worlds.values import Words

SNAPSHOT, GEOMETRIES = ("state", "snapshot"), ("state", "geometries")
LINE = 120  # characters of a line of the snapshot
MOST_BYTES = 1 << 30  # of a snapshot: a short text of zeros would unfold without end
LEFT_OUT = (
    "is of other words than those above, so it is left out and the world begins with these; "
    "state is for files as carom wrote them: remove it, or undo what was changed"
)


class StateWords(Words):
    """What words cannot say of a world that was written in mid-run; not for people to write."""

    of: str = Field(description="hash of the state that the words above give")
    geometries: list[Corner | MeshWords] | None = Field(
        None, description="by number, those of the words above, and those of nobody any more"
    )
    snapshot: str = Field(description="the whole state: a snapshot, compressed by zlib, in base64")


def state_words(world: World, of: World) -> dict[str, Any]:
    """Return the section that makes of the world ``of``, which words give, this one."""
    packed = base64.b64encode(zlib.compress(bytes_from_snapshot(take_snapshot(world)), 9)).decode()
    lines = [packed[first : first + LINE] for first in range(0, len(packed), LINE)]
    numbers = {_triangles(geometry): number for number, geometry in enumerate(of[Geometries].items)}
    needed: list[Any] = [numbers.get(_triangles(geometry)) for geometry in world[Geometries].items]
    for number, geometry in enumerate(world[Geometries].items):
        if needed[number] is None:
            needed[number] = Mesh(geometry).words()
    listed = {"geometries": needed} if needed != [*range(len(numbers))] else {}
    return {"of": state_hash(of), **listed, "snapshot": "\n".join([*lines, ""])}


def _triangles(geometry: Geometry) -> bytes:
    return geometry.vertices.tobytes() + b"/" + geometry.faces.tobytes()


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
        _take_geometries(world[Geometries], state.geometries)
        restore_snapshot(world, snapshot_from_bytes(_unpacked(state.snapshot), world, "it"))
    except IndexError:
        source.report(GEOMETRIES, "names a geometry that the words above do not make; write the world anew")
    except DeclarationError as fault:
        source.report(GEOMETRIES, str(fault))
    except SnapshotError as fault:
        source.report(SNAPSHOT, "; ".join(str(fault).split("\n  ")))
    after = _living(world)
    if not np.array_equal(before, after):
        _renumber(world, dict(zip(before.tolist(), after.tolist(), strict=False)))


def _take_geometries(held: Geometries, numbered: list[Any] | None) -> None:
    """Let geometries have the numbers that the snapshot calls them by; raise IndexError for one that is not there."""
    if numbered is None:
        return
    held.items = [held.items[one] if isinstance(one, int) else _made(one) for one in numbered]
    held.numbers = {}
    for number, geometry in enumerate(held.items):
        held.numbers.setdefault(geometry.content(), number)


def _made(words: MeshWords) -> Geometry:
    """Return the triangles of nobody, as they are stated."""
    return Geometry(*triangles("state.geometries", words.vertices or (), words.faces))


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
