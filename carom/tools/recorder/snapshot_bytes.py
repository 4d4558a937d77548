"""Snapshot bytes: a snapshot as one canonical block of bytes, equal for equal states, and back."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Snapshot, World
from carom.ecs.component import Record
from carom.ecs.errors import SnapshotError
from carom.ecs.slots import Rows, as_rows
from carom.ecs.snapshot import Arrays

MAGIC = b"carom snapshot 1\n"


def bytes_from_snapshot(snapshot: Snapshot) -> bytes:
    """Return one line of JSON that lists the parts in order, then the parts, little-endian and C-contiguous."""
    parts: dict[str, npt.NDArray[Any] | bytes] = {f"slots/{name}": values for name, values in snapshot.slots.items()}
    for kind, (rows, arrays) in snapshot.tables.items():
        parts[f"{kind.key}#"] = np.arange(rows.start, rows.stop) if isinstance(rows, slice) else rows
        parts |= {f"{kind.key}.{name}": values for name, values in arrays.items()}
    for resource, state in sorted(snapshot.resources.items(), key=lambda item: item[0].__name__):
        parts[f"{resource.__name__}!"] = state
    listed: list[list[Any]] = []
    blocks: list[bytes] = []
    for name, part in parts.items():
        if isinstance(part, bytes):
            listed.append([name, None, len(part)])
            blocks.append(part)
        else:
            little = np.ascontiguousarray(part, part.dtype.newbyteorder("<"))
            listed.append([name, little.dtype.str, list(part.shape)])
            blocks.append(little.tobytes())
    header = json.dumps({"frame": snapshot.frame, "parts": listed}, separators=(",", ":"))
    return b"".join([MAGIC, header.encode(), b"\n", *blocks])


def snapshot_from_bytes(data: bytes, world: World) -> Snapshot:
    """Return the snapshot in ``data``; ``world`` tells which classes its resources are of.

    Raises SnapshotError when it holds a component that nothing declares here.
    """
    line, _, rest = data.removeprefix(MAGIC).partition(b"\n")
    header = json.loads(line)
    resources = {kind.__name__: kind for kind in world.resources}
    arrays: dict[str, npt.NDArray[Any]] = {}
    states = {}
    at = 0
    for name, dtype, shape in header["parts"]:
        if dtype is None:
            states[resources[name[:-1]]] = rest[at : at + shape]
            at += shape
            continue
        count = int(np.prod(shape))
        arrays[name] = np.frombuffer(rest, dtype, count, at).reshape(shape)
        at += arrays[name].nbytes
    tables: dict[type[Record], tuple[Rows, Arrays]] = {}
    keys = [name[:-1] for name in arrays if name.endswith("#")]
    unknown = ", ".join(key for key in keys if key not in Record.registry)
    if unknown:
        message = f"the snapshot holds {unknown}, which nothing here declares; install the extension it is of"
        raise SnapshotError(message)
    for key in keys:
        columns = {name.partition(".")[2]: values for name, values in arrays.items() if name.startswith(f"{key}.")}
        tables[Record.registry[key]] = (as_rows(arrays[f"{key}#"]), columns)
    slots = {name.removeprefix("slots/"): values for name, values in arrays.items() if name.startswith("slots/")}
    return Snapshot(header["frame"], slots, tables, states)
