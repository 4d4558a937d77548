"""The pages of docs/ cannot rot: their Python, worlds and commands are run, and print what the pages say."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import jsonschema
import pytest
from pages import NOT_RUN, PAGES, ROOT, Block, bare, blocks, commands, like, run_here, status, write_files

from carom.tools.cli import parser
from carom.tools.session import run
from carom.worlds import json_schema, load_world
from carom.worlds.reader import read

README = ROOT / "README.md"
TUTORIAL = ROOT / "docs" / "tutorial.md"  # tests/test_tutorial.py goes through it
EVERY = [README, *PAGES]
# Classes that a whole process knows from then on: such pages get a process of their own.
DECLARES = re.compile(r"^class .*\((Component|Law|Overlay)\):", re.MULTILINE)
# Languages that something here looks after; text is what the Python before it prints.
LANGUAGES = {"python", "text", "yaml", "sh", "console", "toml", "xml"}
PROGRAMS = {"carom", "make", "cd", "pip", "pytest", "head"}


def code(page: Path) -> list[str]:
    """Return the Python of a page, but files, which are parts of projects."""
    return [block.text for block in blocks(page, "python") if not block.title and not block.included]


def worlds(page: Path) -> list[Block]:
    """Return the whole world files of a page, but included ones, which other tests run."""
    return [one for one in blocks(page, "yaml") if re.match(r"(#.*\n)*carom:", one.text) and not one.included]


@cache
def schema() -> jsonschema.Draft202012Validator:
    """Return what holds parts of files to the schema."""
    return jsonschema.Draft202012Validator(json_schema())


def of(pages: list[Path]) -> pytest.MarkDecorator:
    """Run a test for each of these pages."""
    return pytest.mark.parametrize("page", pages, ids=lambda page: page.stem)


@of([page for page in PAGES if code(page)])
def test_the_python_of_a_page_runs(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Block by block, each going on where the one before has ended: its asserts hold and its text is what it prints."""
    write_files(page, tmp_path)
    monkeypatch.chdir(tmp_path)
    parts = code(page)
    if DECLARES.search("".join(parts)):
        done = subprocess.run([sys.executable, "-c", "\n".join(parts)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        printed = done.stdout
    else:
        names: dict[str, object] = {}
        for part in parts:
            exec(compile(part, str(page), "exec"), names)
        printed = capsys.readouterr().out
    assert printed == "".join(block.text for block in blocks(page, "text") if not block.included)


@of([page for page in PAGES if worlds(page) and page != TUTORIAL])
def test_the_worlds_of_a_page_hold_what_they_expect(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every whole world file that a page shows, beside its other files, but for one that says that it fails."""
    monkeypatch.delenv("CAROM_CHECK", raising=False)  # what systems declare is checked elsewhere
    write_files(page, tmp_path)
    for number, block in enumerate(worlds(page)):
        path = tmp_path / (block.title or f"world_{number}.yaml")
        path.write_text(block.text)
        assert bool(run(load_world(path)).failures) == ("# fails" in block.text), block.text


@of(PAGES)
def test_the_parts_of_files_that_a_page_shows_are_such(page: Path) -> None:
    """Parts of worlds fit the schema; what is TOML is TOML; and nothing is in a language that no test knows."""
    assert {block.language for block in blocks(page)} <= LANGUAGES
    for block in blocks(page, "yaml"):
        if not block.included and block not in worlds(page):
            found = read(block.text, page.name).data
            part = {"entities": found} if isinstance(found, list) else found
            schema().validate({"carom": 1, **part})
    for block in blocks(page, "toml"):
        tomllib.loads(block.text)


@of(EVERY)
def test_the_commands_and_files_of_a_page_exist(page: Path) -> None:
    """Every command is one that carom takes; links and the paths that a text names lead somewhere."""
    for command, _ in commands(page):
        program, *words = shlex.split(bare(command))
        assert program in PROGRAMS, command
        if program == "carom" and not {">", "|"} & set(words):
            parser().parse_args(words)
    text = page.read_text(encoding="utf-8")
    for path in re.findall(r"\]\(((?!http)[^)#]+)", text):
        assert (page.parent / path).is_file(), path
    for path in re.findall(r"`((?:carom|tests|docs)/[a-z_0-9./]+[a-z])`", text):
        assert (ROOT / path).exists(), path


@pytest.mark.slow
@of([page for page in PAGES if page != TUTORIAL and any(bare(one) not in NOT_RUN for one, _ in commands(page))])
def test_the_commands_of_a_page_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In order, in one empty folder with the files that the page shows, as whoever reads it would; see NOT_RUN."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("CAROM_CHECK", raising=False)
    write_files(page, tmp_path)
    (tmp_path / "docs").mkdir()  # into which the pictures of pages are written
    for command, told in commands(page):
        if bare(command) not in NOT_RUN:
            done, printed = run_here(bare(command))
            assert done == status(command) if told is None else like(told, printed), f"{command}\n{printed}"


def test_no_command_is_left_out_that_no_page_has() -> None:
    """What is left out from running is still there, with its reason."""
    assert {bare(command) for page in EVERY for command, _ in commands(page)} >= set(NOT_RUN)
