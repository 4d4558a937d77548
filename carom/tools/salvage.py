"""Salvage: a recording cut in the middle of a message, made whole again."""

from __future__ import annotations

import os
import struct
import subprocess
import tempfile
from contextlib import suppress
from pathlib import Path
from shutil import copyfile
from typing import BinaryIO, NamedTuple

from carom.ecs.errors import CaromError
from carom.tools.recording import Recording
from carom.tools.viewer import viewer_binary

START, START_LENGTH = b"RRF2", 12  # of a file: these letters, the version of Rerun, and how messages are encoded
MESSAGE = struct.Struct("<QQ")  # before every message: its kind, and how many bytes follow
KINDS = (1, 2, 3)  # about the recording, data, its blueprint; 0 ends the file with a table of what is where
FINISHED, FINISHED_LENGTH = b"RRF2FOOT", 12  # a finished file ends in these letters and a number
BLOCK = 1 << 20


class Salvaged(NamedTuple):
    """What was kept: frames, the simulated time (s) of the last, bytes; the bytes cut off; whether it was whole."""

    frames: int
    seconds: float
    kept: int
    dropped: int
    whole: bool


def salvage(broken: Path, out: Path) -> Salvaged:
    """Write all whole messages of a recording to ``out`` and finish it; one that is whole already is copied.

    Raises CaromError, having written nothing, for what is no recording or holds no whole message of data.
    """
    if out.exists() and out.samefile(broken):
        raise CaromError(f"cannot write {out}: it is the broken recording itself; name another file")
    with broken.open("rb") as file, tempfile.TemporaryDirectory(dir=out.parent) as folder:
        if fault := _fault(file):
            raise CaromError(f"cannot salvage {broken}: {fault}")
        mended = Path(folder) / out.name
        size = os.fstat(file.fileno()).st_size
        whole = _finished(file)
        kept = size if whole else whole_length(file)
        if whole:
            copyfile(broken, mended)
        else:
            _finish(file, kept, mended)
        try:
            recording = Recording(mended)
        except CaromError:
            raise CaromError(f"cannot salvage {broken}: its {kept:,} whole bytes hold no data") from None
        mended.replace(out)
    seconds = recording.times[recording.frames[-1]] if recording.frames else 0.0
    return Salvaged(len(recording.frames), seconds, kept, size - kept, whole)


def whole_length(file: BinaryIO) -> int:
    """Return how many bytes the start of a recording and all whole messages after it take."""
    size = file.seek(0, os.SEEK_END)
    at = START_LENGTH
    while at + MESSAGE.size <= size:
        file.seek(at)
        kind, length = MESSAGE.unpack(file.read(MESSAGE.size))
        if kind not in KINDS or at + MESSAGE.size + length > size:
            break
        at += MESSAGE.size + length
    return at


def _fault(file: BinaryIO) -> str:
    start = file.read(START_LENGTH)
    if not start:
        return "it is empty"
    if not start.startswith(START):
        return f"it is no recording, which would start with {START.decode()}"
    return "" if len(start) == START_LENGTH else "it was cut before its first message"


def _finished(file: BinaryIO) -> bool:
    file.seek(-FINISHED_LENGTH, os.SEEK_END)
    return file.read(len(FINISHED)) == FINISHED


def _finish(file: BinaryIO, kept: int, mended: Path) -> None:
    """Hand the whole messages to Rerun, which writes them as they are and the table of what is where after them."""
    file.seek(0)
    with tempfile.TemporaryFile() as told:
        command = [str(viewer_binary()), "rrd", "filter", "-o", str(mended)]
        with (
            suppress(BrokenPipeError),  # it gave up, and tells why
            subprocess.Popen(command, stdin=subprocess.PIPE, stdout=told, stderr=told) as process,
        ):
            assert process.stdin is not None
            while kept > 0 and (block := file.read(min(BLOCK, kept))):
                process.stdin.write(block)
                kept -= len(block)
        if process.returncode:
            told.seek(0)
            reason = told.read().decode(errors="replace").strip().rpartition("\n")[2]
            raise CaromError(f"cannot salvage {file.name}: Rerun could not finish it: {reason}")
