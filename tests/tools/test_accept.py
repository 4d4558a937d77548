"""``carom accept`` makes what a failed run left the goldens, and nothing else of this machine."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
from unlike import PLACE, leave_unlike

from carom.tools.cli import main
from carom.tools.snapshot_kit.case import ABOUT
from carom.tools.snapshot_kit.picture import read_picture, write_picture


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project, in it a golden whose picture is white where the report of a run has a black one."""
    monkeypatch.chdir(tmp_path)
    black = np.zeros((8, 8, 3), np.uint8)
    leave_unlike(tmp_path, "report", "tests/test_game.py::test_start", black + 255, black)
    return tmp_path


def picture(project: Path) -> int:
    """Return how bright the golden is now."""
    return int(read_picture(project / f"{PLACE}.png").max())


def zipped(project: Path, folder: str = "") -> Path:
    """Return the report as a zip, as CI hands it out, in it perhaps in a folder."""
    path = project / "failed-run.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for file in (project / "report").rglob("*"):
            archive.write(file, Path(folder) / file.relative_to(project / "report"))
    return path


def edit(project: Path, **values: object) -> None:
    """Change what the case says of itself."""
    (path,) = (project / "report").rglob("case.json")
    path.write_text(json.dumps(json.loads(path.read_text()) | values))


WHAT = (
    f"  {PLACE}: rendering: 4 x 4 px from (0, 0) on differ by 255.0 of 255, at most 2.5 may on the driver "
    "that drew the golden; the state agrees"
)


@pytest.mark.parametrize("folder", [None, "", "artifacts/carom-report"])
def test_a_report_becomes_the_goldens(project: Path, folder: str | None, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder, a zip of it, and a zip with the folder somewhere in it."""
    assert main(["accept", str(project / "report" if folder is None else zipped(project, folder)), "--yes"]) == 0
    assert capsys.readouterr().out == f"goldens to change:\n{WHAT}\n"
    assert picture(project) == 0
    assert main(["accept", str(project / "report"), "--yes"]) == 0
    assert capsys.readouterr().out == f"goldens to change:\n  {PLACE}: is so already\n"


def test_nothing_is_written_unasked(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Where nobody can be asked, it takes --yes."""
    assert main(["accept", str(project / "report")]) == 1
    assert capsys.readouterr().out.endswith("nothing was written; --yes writes without asking\n")
    assert picture(project) == 255


@pytest.mark.parametrize(("answer", "written"), [("y", True), ("n", False), ("", False)])
def test_people_are_asked(project: Path, monkeypatch: pytest.MonkeyPatch, answer: str, written: bool) -> None:
    """Whatever is not yes is no."""
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)
    monkeypatch.setattr("builtins.input", lambda question: answer)
    assert main(["accept", str(project / "report")]) == (0 if written else 1)
    assert picture(project) == (0 if written else 255)


def test_a_golden_that_changed_since_the_run_is_told(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What CI compared with is no longer there."""
    write_picture(project / f"{PLACE}.png", np.full((8, 8, 3), 128, np.uint8))
    assert main(["accept", str(project / "report"), "--json"]) == 1
    told = capsys.readouterr()
    assert told.err == f"goldens to change:\n{WHAT}; IT HAS CHANGED SINCE THAT RUN\n"
    row = {"golden": PLACE, "kind": "rendering", "overtaken": True}
    assert json.loads(told.out) == {"written": False, "goldens": [row]}


@pytest.mark.parametrize(
    "place",
    [
        "/etc/__carom__/test_game/start",
        "../__carom__/test_game/start",
        "tests/__carom__/../../../__carom__/x/start",
        "tests/start",
        "tests/__carom__/test_game/.start",
        "tests/__carom__/start",
        "c:/__carom__/test_game/start",
        "tests\\__carom__\\test_game\\start",
    ],
)
def test_what_is_no_golden_of_this_project_is_refused(
    project: Path, place: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A report names goldens, and only those; nothing is written when one is refused."""
    edit(project, golden=place)
    before = sorted(project.rglob("*"))
    assert main(["accept", str(zipped(project)), "--yes"]) == 2
    accepted = "accepted: paths such as tests/__carom__/test_balls/falling"
    assert capsys.readouterr().err == f"{place}: is no golden of this project; {accepted}\n"
    assert sorted(project.rglob("*")) == sorted([*before, project / "failed-run.zip"])


def test_links_lead_nowhere(project: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Neither a folder of goldens nor a golden may be a link out of the project."""
    outside = tmp_path_factory.mktemp("outside")
    (project / "tests" / "__carom__" / "test_linked").symlink_to(outside)
    edit(project, golden="tests/__carom__/test_linked/start")
    assert main(["accept", str(project / "report"), "--yes"]) == 2
    (project / f"{PLACE}.png").unlink()
    (project / f"{PLACE}.png").symlink_to(outside / "start.png")
    edit(project, golden=PLACE)
    assert main(["accept", str(project / "report"), "--yes"]) == 2
    assert list(outside.iterdir()) == []


def test_names_in_a_zip_that_lead_out_of_it_lead_nowhere(project: Path) -> None:
    """Only what is in the files counts, never where the zip would put them."""
    assert main(["accept", str(zipped(project, "../../../..")), "--yes"]) == 0
    assert picture(project) == 0


def test_run_elsewhere_it_says_where_to_go(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Goldens are never written beside tests that are not there."""
    elsewhere = project / "docs"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    assert main(["accept", str(project / "report"), "--yes"]) == 2
    assert capsys.readouterr().err == (
        f"{PLACE}: there is no folder tests in {elsewhere}; run this where the tests were run\n"
    )


def test_what_is_no_state_or_picture_is_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever its name says."""
    (folder,) = (project / "report" / "carom-cases").iterdir()
    (folder / "actual.png").write_bytes(b"#!/bin/sh")
    assert main(["accept", str(project / "report"), "--yes"]) == 2
    (folder / "actual.json").write_text("[]")
    assert main(["accept", str(project / "report"), "--yes"]) == 2
    assert capsys.readouterr().err == (
        f"{PLACE}: its actual.png is no picture\n{PLACE}: its actual.json is missing or is no state\n"
    )


def test_what_is_no_report_is_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A missing file, another file, a folder without cases, a case of another version."""
    (project / "text.zip").write_text("text")
    edit(project, extra=1)
    for name in ("missing.zip", "text.zip", "tests", "report"):
        assert main(["accept", name, "--yes"]) == 2
    accepted = "accepted: the folder carom-report of a run, or a zip of it"
    lines = capsys.readouterr().err.splitlines()
    assert lines[:3] == [
        f"cannot read missing.zip: No such file or directory; {accepted}",
        f"cannot read text.zip: File is not a zip file; {accepted}",
        f"tests holds no check that did not pass; {accepted}",
    ]
    assert lines[3].startswith("report: carom-cases/start-") and "is no case of this version of carom" in lines[3]


def test_a_golden_that_is_no_text_is_refused(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As what no version of carom writes."""
    edit(project, golden=5)
    (case,) = (project / "report").rglob("case.json")
    assert main(["accept", "report", "--yes"]) == 2
    name = case.relative_to(project / "report").as_posix()
    assert capsys.readouterr().err == f"report: {name} is no case of this version of carom: its golden is no text\n"


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (
            "bits",
            (
                "cannot read sent.zip: Error -3 while decompressing data: invalid block type; "
                "accepted: the folder carom-report of a run, or a zip of it\n"
            ),
        ),
        ("password", "sent.zip: case.json is encrypted; send the report without a password\n"),
    ],
)
def test_a_zip_that_cannot_be_unpacked_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], damage: str, message: str
) -> None:
    """One with wrong bits in it, and one that is encrypted."""
    monkeypatch.chdir(tmp_path)
    path = Path("sent.zip")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(ABOUT, "{" * 1000)
    content = bytearray(path.read_bytes())
    if damage == "bits":
        content[30 + len(ABOUT)] = 0xFF
    else:
        content[6] |= 1
        content[content.index(b"PK\x01\x02") + 8] |= 1
    path.write_bytes(content)
    assert main(["accept", "sent.zip", "--yes"]) == 2
    assert capsys.readouterr().err == message


def test_a_huge_file_in_a_zip_is_not_read(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """However small it is packed."""
    monkeypatch.setattr("carom.tools.snapshot_kit.accept.LARGEST", 2**20)
    (folder,) = (project / "report" / "carom-cases").iterdir()
    (folder / "actual.png").write_bytes(bytes(2**20 + 1))
    assert main(["accept", str(zipped(project)), "--yes"]) == 2
    name = f"carom-cases/{folder.name}/actual.png"
    assert capsys.readouterr().err == f"{project / 'failed-run.zip'}: {name} is larger than 1 MiB\n"
