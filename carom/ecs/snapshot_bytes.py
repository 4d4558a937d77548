"""Snapshot bytes: a snapshot as one canonical block of bytes, equal for equal states, in a file or elsewhere."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt
from xxhash import xxh3_128, xxh3_128_hexdigest

from carom.ecs.component import Record
from carom.ecs.errors import SnapshotError
from carom.ecs.slots import Rows, as_rows
from carom.ecs.snapshot import Snapshot
from carom.ecs.snapshot_faults import Arrays, faults_of, missing_resource
from carom.ecs.world import World

MAGIC = b"carom snapshot "
VERSION = 2  # of the layout: 2 has a checksum, and the module each component is declared in
SOURCE = "the snapshot"


def bytes_from_snapshot(snapshot: Snapshot) -> bytes:
    """Return the bytes of a snapshot, equal for equal states whatever their tables and resources came to be in.

    A line with magic, version, length and checksum of all that follows; a line of JSON that lists the parts in order;
    then the parts, little-endian and C-contiguous.
    """
    parts: dict[str, npt.NDArray[Any] | bytes] = {f"slots/{n}": array for n, array in sorted(snapshot.slots.items())}
    kinds = sorted(snapshot.tables, key=lambda kind: kind.key)
    for kind in kinds:
        parts[f"{kind.key}#"] = snapshot.numbers(kind)
        parts |= {f"{kind.key}.{name}": array for name, array in sorted(snapshot.tables[kind][1].items())}
    for resource, state in sorted(snapshot.resources.items(), key=lambda item: item[0].__name__):
        parts[f"{resource.__name__}!"] = state
    listed: list[list[Any]] = []
    blocks: list[Any] = []
    for name, part in parts.items():
        if isinstance(part, bytes):
            listed.append([name, None, len(part)])
            blocks.append(part)
        else:
            little = np.ascontiguousarray(part, part.dtype.newbyteorder("<"))
            listed.append([name, little.dtype.str, list(part.shape)])
            blocks.append(little.data)
    header = {"frame": snapshot.frame, "modules": {kind.key: kind.__module__ for kind in kinds}, "parts": listed}
    if edited := sorted(kind.key for kind in snapshot.edited):
        header["edited"] = edited
    blocks.insert(0, json.dumps(header, separators=(",", ":")).encode() + b"\n")
    digest, length = xxh3_128(), 0
    for block in blocks:
        digest.update(block)
        length += memoryview(block).nbytes
    return b"".join([b"%s%d %d %s\n" % (MAGIC, VERSION, length, digest.hexdigest().encode()), *blocks])


def snapshot_from_bytes(data: bytes, world: World, source: str = SOURCE) -> Snapshot:
    """Return the snapshot in ``data``, which fits ``world``; it is restored by `restore_snapshot`.

    Raises SnapshotError, calling the data ``source``, for what is no snapshot, is of another version, cut off or
    damaged, and for one that does not fit the world, with all that does not.
    """
    header, parts = _parts(data, _start(data, source))
    arrays = {name: part for name, part in parts.items() if not isinstance(part, bytes)}
    resources = {kind.__name__: kind for kind in world.resources}
    states, faults = {}, []
    for name in [name for name, part in parts.items() if isinstance(part, bytes)]:
        if (resource := resources.get(name[:-1])) is None:
            faults.append(missing_resource(name[:-1]))
        else:
            states[resource] = parts[name]
    tables: dict[type[Record], tuple[Rows, Arrays]] = {}
    for key, module in header["modules"].items():
        if key not in Record.registry:
            package = module.partition(".")[0]
            mend = "run it from there" if package == "__main__" else f"import it, or install the package {package}"
            faults.append(f"it holds component '{key}', which nothing here declares; {module} did: {mend}")
            continue
        columns = {name.partition(".")[2]: array for name, array in arrays.items() if name.startswith(f"{key}.")}
        tables[Record.registry[key]] = (as_rows(arrays[f"{key}#"]), columns)
    slots = {name.removeprefix("slots/"): array for name, array in arrays.items() if name.startswith("slots/")}
    edited = frozenset(Record.registry[key] for key in header.get("edited", ()) if key in Record.registry)
    snapshot = Snapshot(header["frame"], slots, tables, states, edited)
    if faults := [*faults, *faults_of(snapshot, world)]:
        raise SnapshotError("\n  ".join([f"{source} does not fit this world:", *faults]))
    return snapshot


def _start(data: bytes, source: str) -> int:
    """Return where what follows the first line begins, which says that it is whole."""
    if not data.startswith(MAGIC):
        raise SnapshotError(f"{source} is no snapshot of carom: it begins with {data[:16]!r}")
    end = data.find(b"\n")
    version, *rest = data[len(MAGIC) : max(end, 0)].decode(errors="replace").split(" ")
    if version.isdecimal() and int(version) != VERSION:
        mend = "update carom" if int(version) > VERSION else "save it anew"
        raise SnapshotError(f"{source} is of version {version}, this carom reads version {VERSION}; {mend}")
    body = memoryview(data)[end + 1 :]
    length = int(rest[0]) if len(rest) == 2 and rest[0].isdecimal() else -1
    if end < 0 or length > len(body):
        missing = "the rest of its first line is" if end < 0 else f"{length - len(body)} of {length} bytes are"
        raise SnapshotError(f"{source} is cut off: {missing} missing; save it anew")
    if length != len(body) or rest[1] != xxh3_128_hexdigest(body):
        raise SnapshotError(f"{source} is damaged: its bytes are not those that were saved; save it anew")
    return end + 1


def _parts(data: bytes, start: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the header, and every part as an array or, of a resource, as bytes."""
    at = data.index(b"\n", start) + 1
    header: dict[str, Any] = json.loads(data[start:at])
    parts: dict[str, Any] = {}
    for name, dtype, shape in header["parts"]:
        if dtype is None:
            parts[name] = data[at : at + shape]
            at += shape
        else:
            array = np.frombuffer(data, dtype, int(np.prod(shape)), at).reshape(shape)
            parts[name] = array.astype(array.dtype.newbyteorder("="), copy=False)
            at += array.nbytes
    return header, parts
