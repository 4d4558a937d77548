"""Snapshot files: a snapshot saved and loaded."""

from __future__ import annotations

from pathlib import Path

from carom.ecs.errors import SnapshotError
from carom.ecs.snapshot import Snapshot
from carom.ecs.snapshot_bytes import bytes_from_snapshot, snapshot_from_bytes
from carom.ecs.world import World


def save_snapshot(path: str | Path, snapshot: Snapshot) -> None:
    """Write a snapshot to a file; a file that was there before stays whole until this one is."""
    path = Path(path)
    unfinished = path.with_name(f"{path.name}.unfinished")
    unfinished.write_bytes(bytes_from_snapshot(snapshot))
    unfinished.replace(path)


def load_snapshot(path: str | Path, world: World) -> Snapshot:
    """Return the snapshot in a file, which fits ``world``; it is restored by `restore_snapshot`.

    Raises SnapshotError, naming the file, when it cannot be read or is none that fits; the world is left as it is.
    """
    try:
        data = Path(path).read_bytes()
    except OSError as fault:
        raise SnapshotError(f"{path} cannot be read: {fault.strerror}") from fault
    return snapshot_from_bytes(data, world, str(path))
