"""Accept: what a run left in its report becomes the goldens, here or from the report of another machine.

A report may come from anywhere: nothing of it is unpacked, and it names only goldens of this project.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from carom.ecs.errors import CaromError
from carom.tools.snapshot_kit.case import ABOUT, Case
from carom.tools.snapshot_kit.golden import Golden, digest
from carom.tools.snapshot_kit.ledger import ENDINGS, FOLDER, PICTURE, STATE
from carom.tools.snapshot_kit.state import StateGolden

LARGEST = 2**26  # bytes of one file
ENCRYPTED = 1  # the flag of a file in a zip


@dataclass(frozen=True)
class Sent:
    """A case as a report holds it, with the files of what there was then, by ending."""

    case: Case
    files: dict[str, bytes]


@dataclass(frozen=True)
class Change:
    """A golden that is about to be written."""

    case: Case
    golden: Golden
    files: dict[str, bytes]

    @property
    def overtaken(self) -> bool:
        """Whether the golden has changed since the run."""
        return self.golden.digests() != self.case.held

    def __str__(self) -> str:
        """Return what changes, in one line."""
        if self.golden.digests() == {ending: digest(content) for ending, content in self.files.items()}:
            return f"  {self.case.golden}: is so already"
        what = "new" if self.case.kind == "new" else str(self.case)
        return f"  {self.case.golden}: {what}{'; IT HAS CHANGED SINCE THAT RUN' if self.overtaken else ''}"


def read_report(path: Path) -> list[Sent]:
    """Return the cases of a report, a folder or a zip of one; raise CaromError where there are none."""
    accepted = "accepted: the folder carom-report of a run, or a zip of it"
    if path.is_dir():
        files = {one.relative_to(path).as_posix(): one.read_bytes() for one in path.rglob("*") if _wanted(one.name)}
    else:
        try:
            with zipfile.ZipFile(path) as archive:
                infos = [info for info in archive.infolist() if _wanted(PurePosixPath(info.filename).name)]
                if too_large := [info.filename for info in infos if info.file_size > LARGEST]:
                    raise CaromError(f"{path}: {', '.join(too_large)} is larger than {LARGEST >> 20} MiB")
                if locked := [info.filename for info in infos if info.flag_bits & ENCRYPTED]:
                    raise CaromError(f"{path}: {', '.join(locked)} is encrypted; send the report without a password")
                files = {info.filename: archive.read(info) for info in infos}
        except (OSError, EOFError, NotImplementedError, zipfile.BadZipFile, zlib.error) as fault:
            raise CaromError(f"cannot read {path}: {getattr(fault, 'strerror', None) or fault}; {accepted}") from None
    sent = []
    for name in sorted(files):
        if PurePosixPath(name).name == ABOUT:
            beside = {ending: PurePosixPath(name).with_name(f"actual{ending}").as_posix() for ending in ENDINGS}
            try:
                case = Case.read(files[name].decode())
            except (ValueError, TypeError) as fault:
                raise CaromError(f"{path}: {name} is no case of this version of carom: {fault}") from None
            sent.append(Sent(case, {ending: files[one] for ending, one in beside.items() if one in files}))
    if not sent:
        raise CaromError(f"{path} holds no check that did not pass; {accepted}")
    return sent


def _wanted(name: str) -> bool:
    return name in (ABOUT, *(f"actual{ending}" for ending in ENDINGS))


def changes(sent: list[Sent], root: Path) -> list[Change]:
    """Return what accepting would write into the project at ``root``; raise CaromError with all that is refused."""
    faults = []
    made: dict[str, Change] = {}
    for one in sent:
        fault = _refused(one, root)
        other = made.setdefault(one.case.golden, Change(one.case, Golden(root / one.case.golden), one.files))
        if fault is None and other.files != one.files:
            fault = f"{other.case.test} and {one.case.test} share it and differ; give each a name of its own"
        if fault is not None:
            faults.append(f"{one.case.golden}: {fault}")
    if faults:
        raise CaromError("\n".join(faults))
    return list(made.values())


def _refused(sent: Sent, root: Path) -> str | None:
    place = PurePosixPath(sent.case.golden)
    golden = Golden(root / place)
    inside = golden.path.parent.resolve().is_relative_to(root.resolve())
    named = place.parts[-3:-2] == (FOLDER,) and not place.name.startswith(".") and not set(str(place)) & set("\\:")
    if place.is_absolute() or ".." in place.parts or not inside or not named:
        return f"is no golden of this project; accepted: paths such as tests/{FOLDER}/test_balls/falling"
    if any(golden.file(ending).is_symlink() for ending in ENDINGS):
        return "is a link"
    if not golden.path.parents[2].is_dir():
        return f"there is no folder {place.parents[2]} in {root}; run this where the tests were run"
    return _unreadable(sent.files)


def _unreadable(files: dict[str, bytes]) -> str | None:
    from PIL import Image

    try:
        StateGolden.read(files[STATE].decode())
    except (KeyError, ValueError, TypeError, AttributeError):
        return f"its actual{STATE} is missing or is no state"
    if PICTURE in files:
        try:
            with Image.open(io.BytesIO(files[PICTURE]), formats=["PNG"]) as image:
                image.load()
        except (OSError, SyntaxError, ValueError, Image.DecompressionBombError):
            return f"its actual{PICTURE} is no picture"
    return None


def accept(made: list[Change]) -> None:
    """Write the goldens."""
    for change in made:
        change.golden.path.parent.mkdir(parents=True, exist_ok=True)
        for ending, content in change.files.items():
            change.golden.file(ending).write_bytes(content)
