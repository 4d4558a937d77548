"""Case: a folder that says all about one check that did not pass, and holds what accepting it needs.

``case.json`` is what this module reads and writes; beside it lie ``actual.json`` and ``actual.png``, what there was to
compare with as ``expected.json`` and ``expected.png``, ``difference.png``, and ``recording.rrd`` of the last frames.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from carom.tools.snapshot_kit.golden import Actual, Golden, Verdict
from carom.tools.snapshot_kit.ledger import PICTURE, STATE
from carom.tools.snapshot_kit.picture import difference_picture, write_picture

CASES = "carom-cases"  # the folder of the cases in a report
ABOUT = "case.json"
RECORDING = "recording.rrd"


@dataclass(frozen=True)
class Case:
    """What did not pass: ``golden`` is a path from the project's root, ``held`` the digests of its files then."""

    test: str
    golden: str
    kind: str
    what: str
    frame: int
    held: dict[str, str]
    entity: str = ""
    column: str = ""
    expected: str = ""
    actual: str = ""

    def __str__(self) -> str:
        """Return the line that a failure begins with."""
        return self.what if self.kind == "new" else f"{self.kind}: {self.what}"

    @property
    def again(self) -> str:
        """The command that runs the check again."""
        return f'pytest "{self.test}"'

    @property
    def accept(self) -> str:
        """The command that makes what is now the golden."""
        return f"{self.again} --carom-update"

    @property
    def folder(self) -> str:
        """The name of its folder: the golden's, and a few digits of the whole path and the test."""
        digits = hashlib.blake2b(f"{self.golden} {self.test}".encode(), digest_size=4).hexdigest()
        return f"{re.sub(r'[^A-Za-z0-9_.-]', '_', Path(self.golden).name)}-{digits}"

    @classmethod
    def read(cls, text: str) -> Case:
        """Return what `leave` wrote; raise ValueError or TypeError for anything else."""
        case = cls(**json.loads(text))
        for name in ("test", "golden", "kind", "what"):
            if not isinstance(getattr(case, name), str):
                raise TypeError(f"its {name} is no text")
        return case


def leave(report: Path, root: Path, test: str, golden: Golden, actual: Actual, verdict: Verdict) -> tuple[Case, Path]:
    """Write the case of a check into a report; return it with its folder."""
    fault = verdict.fault
    parts = {"entity": fault.entity, "column": fault.column, "expected": fault.expected, "actual": fault.actual}
    place = golden.path.relative_to(root).as_posix()
    case = Case(test, place, verdict.kind, fault.what, actual.state.frame, golden.digests(), **parts)
    folder = report / CASES / case.folder
    folder.mkdir(parents=True, exist_ok=True)
    (report / ".gitignore").write_text("*\n", encoding="utf-8")
    for ending in case.held:
        shutil.copyfile(golden.file(ending), folder / f"expected{ending}")
    (folder / f"actual{STATE}").write_text(actual.state.text(), encoding="utf-8")
    if actual.picture is not None:
        write_picture(folder / f"actual{PICTURE}", actual.picture)
        if PICTURE in case.held and (expected := golden.picture()).shape == actual.picture.shape:
            write_picture(folder / "difference.png", difference_picture(actual.picture, expected))
    (folder / ABOUT).write_text(json.dumps(asdict(case), indent=1) + "\n", encoding="utf-8")
    return case, folder


def cases(report: Path) -> Iterator[tuple[Case, Path]]:
    """Yield the cases of a report with their folders, in order of test."""
    found = [(Case.read(path.read_text(encoding="utf-8")), path.parent) for path in _abouts(report)]
    yield from sorted(found, key=lambda item: (item[0].test, item[0].golden))


def forget_cases(report: Path) -> None:
    """Remove the cases of an earlier run."""
    for path in _abouts(report):
        shutil.rmtree(path.parent)


def _abouts(report: Path) -> list[Path]:
    return sorted(report.glob(f"{CASES}/*/{ABOUT}"))
