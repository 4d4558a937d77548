"""Pages: the blocks of docs, and a shell that runs their commands as a reader would, in a folder of its own."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from carom.tools.cli import main

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted((ROOT / "docs").glob("*.md"))
FENCE = re.compile(r'^```(\w*)(?: title="([^"]+)")?\n(.*?)^```', re.MULTILINE | re.DOTALL)
INCLUDES = "--8<-- "  # how pymdownx.snippets has a page include a file

#: Commands of pages that no test runs, and why.
NOT_RUN = {
    "make demo": "make sets up the clone by pip; .ci/setup and the same run are what CI begins with",
    "make test": "it is what runs this test",
    "carom view rec.rrd": "opens a window and stays",
    "carom view rec.rrd --frame 90 --select cue": "opens a window and stays",
    "carom view rec.rrd --web": "serves until Ctrl-C; tests/tools/test_view.py opens its page in a browser",
    "carom view rec.rrd --web --frame 90 --select cue": "serves until Ctrl-C, as the one above",
    "carom run billiards --live --speed 1x": "opens a window",
    "carom run billiards --live --speed 0.25x --record rec.rrd": "opens a window",
    "carom run billiards --viewer rerun+http://127.0.0.1:9876/proxy": "needs a viewer, as tests/tools/test_live.py has",
    'carom run dominoes --break "domino[*].position.y < 0.1 m" --pdb': "waits at a prompt: tests/tools/test_breaks.py",
    "carom run pool.yaml --watch --live": "goes on until Ctrl-C; tests/tools/test_watching.py saves and ends it",
    "carom import room.glb --units 0.01 --meshes parts --json": "takes a scene of yours and the extra authoring",
    "carom bench contacts --json | python .ci/site/figures.py": "takes minutes, and times nothing in a test",
    "carom accept carom-report.zip": "takes the report of a failed run in CI; tests/tools/test_accept.py has one",
}


@dataclass(frozen=True)
class Block:
    """A block of code: its language, the file that it is, if any, what it says, and whether it includes that."""

    language: str
    title: str
    text: str
    included: bool


def blocks(page: Path, *languages: str) -> list[Block]:
    """Return the blocks of a page, or those in some languages."""
    parts = FENCE.findall(page.read_text("utf-8"))
    found = [Block(language, title, text, text.startswith(INCLUDES)) for language, title, text in parts]
    return [one for one in found if not languages or one.language in languages]


def write_files(page: Path, folder: Path) -> None:
    """Write the files that a page shows."""
    for block in blocks(page):
        if block.title:
            path = folder / block.title
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, "utf-8")


def commands(page: Path) -> Iterator[tuple[str, str | None]]:
    """Yield the commands of a page, and of those in a console what they print."""
    for block in blocks(page, "sh", "console"):
        if block.language == "sh":
            yield from ((line, None) for line in block.text.replace("\\\n", " ").splitlines() if line)
        else:
            for part in re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]:
                command, _, told = part.partition("\n")
                yield command, told


def bare(command: str) -> str:
    """Return a command without its comment."""
    return re.sub(r"\s+# .*", "", command)


def status(command: str) -> int:
    """Return the exit status that a command's comment speaks of; 0 where it has none."""
    found = re.search(r"# exits (\d)", command)
    return int(found[1]) if found else 0


def like(told: str, text: str) -> bool:
    """Tell whether a text is what a page tells of it, in which ``...`` stands for anything, lines too."""
    parts = (re.escape(part) for part in told.strip().split("..."))
    return re.fullmatch(r"\s*" + "(?s:.*?)".join(parts) + r"\s*", text) is not None


def run_here(command: str) -> tuple[int, str]:
    """Run a command of carom in this process, any other by a shell; return its exit status and what it prints."""
    words = shlex.split(command)
    if words[0] != "carom":
        kept = {key: value for key, value in os.environ.items() if key != "PYTEST_XDIST_WORKER"}
        paths = os.pathsep.join([str(Path(sys.executable).parent), kept["PATH"]])
        return run_by_shell(command, Path.cwd(), {**kept, "PATH": paths, "PYTHONPATH": str(ROOT)})
    told = io.StringIO()
    paths = [sorted(map(str, Path().glob(word))) or [word] if "*" in word and "/" in word else [word] for word in words]
    with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
        try:
            done = main([word for path in paths[1:] for word in path])
        except SystemExit as ended:
            done = int(ended.code or 0)
    return done, told.getvalue()


def run_by_shell(command: str, folder: Path, environment: dict[str, str]) -> tuple[int, str]:
    """Run a command in a process of its own."""
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.returncode, done.stdout
