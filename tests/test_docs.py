"""The pages of docs/ cannot rot: their Python is run, and prints what they say it does."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from carom.tools.cli import parser
from carom.worlds import load_text

PAGES = sorted((Path(__file__).resolve().parents[1] / "docs").glob("*.md"))
WITH_WORLDS = [page for page in PAGES if "```yaml\ncarom:" in page.read_text()]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_python_of_a_page_runs(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Block by block, each going on where the one before has ended: its asserts hold and its text is what it prints."""
    blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
    assert blocks, f"{page.name} shows no Python"
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, str(page), "exec"), names)
    told = re.findall(r"^```text\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
    assert capsys.readouterr().out == "".join(told)


@pytest.mark.parametrize("page", WITH_WORLDS, ids=lambda page: page.stem)
def test_the_worlds_of_a_page_are_worlds(page: Path) -> None:
    """Every whole world file that a page shows can be read, with all that it expects."""
    for block in re.findall(r"^```yaml\n(carom:.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
        load_text(block, page.name)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_commands_and_files_of_a_page_exist(page: Path) -> None:
    """Every carom command is one that the command line takes; every picture and page it links is beside it."""
    text = page.read_text()
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        for line in block.splitlines():
            program, *words = shlex.split(line)
            assert program == "carom", line
            parser().parse_args(words)
    for path in re.findall(r"\]\(((?!http)[^)#]+)\)", text):
        assert (page.parent / path).is_file(), path
