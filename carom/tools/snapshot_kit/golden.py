"""Golden: the two files that hold what somebody accepted, and the verdict on what is there now."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from carom.tools.snapshot_kit.ledger import ENDINGS, PICTURE, STATE
from carom.tools.snapshot_kit.picture import Picture, picture_fault, read_picture
from carom.tools.snapshot_kit.state import StateFault, StateGolden, state_fault


@dataclass(frozen=True)
class Actual:
    """What a world is now; no picture where none was asked for."""

    state: StateGolden
    picture: Picture | None = None


@dataclass(frozen=True)
class Verdict:
    """Why a world does not pass: ``kind`` is physics, rendering, or new where there is no golden."""

    kind: str
    fault: StateFault


@dataclass(frozen=True)
class Golden:
    """A golden by its path without an ending."""

    path: Path

    def file(self, ending: str) -> Path:
        """Return the file of a layer."""
        return self.path.with_name(self.path.name + ending)

    def digests(self) -> dict[str, str]:
        """Return a digest of each file there is, by its ending."""
        files = {ending: self.file(ending) for ending in ENDINGS}
        return {ending: digest(file.read_bytes()) for ending, file in files.items() if file.is_file()}

    def state(self) -> StateGolden:
        """Return the state."""
        return StateGolden.read(self.file(STATE).read_text(encoding="utf-8"))

    def picture(self) -> Picture:
        """Return the picture."""
        return read_picture(self.file(PICTURE))

    def verdict(self, actual: Actual, tolerance: float) -> Verdict | None:
        """Return why ``actual`` does not pass, or None; physics comes before rendering, which follows from it."""
        wanted = [self.file(STATE), *([] if actual.picture is None else [self.file(PICTURE)])]
        missing = [file.name for file in wanted if not file.is_file()]
        if missing:
            folder = "/".join(self.path.parts[-3:-1])
            return Verdict("new", StateFault(f"no golden {', '.join(missing)} in {folder}"))
        golden = self.state()
        if physics := state_fault(actual.state, golden, tolerance):
            return Verdict("physics", physics)
        if actual.picture is not None:
            same = golden.driver == actual.state.driver
            if rendering := picture_fault(actual.picture, self.picture(), same_driver=same):
                return Verdict("rendering", StateFault(f"{rendering}; the state agrees"))
        return None


def digest(content: bytes) -> str:
    """Return 16 hexadecimal digits of a file."""
    return hashlib.blake2b(content, digest_size=8).hexdigest()
