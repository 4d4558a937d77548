"""What functions are compiled to is kept, told of once, and never a hindrance."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from carom.systems.kernels.stored import Files

MESSAGE = (
    "carom: compiling kernels, once, which may take a minute or two; `carom warm` compiles all of them beforehand\n"
)
KERNELS = """
from carom.systems.kernels.kernel import inlined, kernel

@inlined
def twice(number):
    return number + number

@kernel()
def of_whole_numbers(count):
    return twice(count)

@kernel()
def of_fractions(count):
    return twice(0.5 * count)
"""
WORDS = (
    "import doubling",
    "print(doubling.of_whole_numbers(1), doubling.of_fractions(1))",
)


class Program:
    """A script of two kernels that call one function with different types, in a folder with a cache of its own."""

    def __init__(self, folder: Path) -> None:
        self.cache = folder / "cache"
        (folder / "doubling.py").write_text(KERNELS)
        path = os.pathsep.join([str(folder), *sys.path])
        self._environment = {**os.environ, "PYTHONPATH": path, "NUMBA_CACHE_DIR": str(self.cache)}
        self._environment.pop("NUMBA_DISABLE_JIT", None)

    def start(self, *words: str) -> subprocess.Popen[str]:
        """Start it in a process of its own."""
        command = [sys.executable, "-c", "; ".join(words or WORDS)]
        return subprocess.Popen(
            command, env=self._environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )

    def run(self) -> tuple[str, str]:
        """Return what it says on stdout and stderr."""
        return self.start().communicate()

    @property
    def files(self) -> list[Path]:
        """What is cached."""
        return sorted(self.cache.rglob("*.nbc"))


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """Return the script, with an empty cache."""
    return Program(tmp_path)


def test_compiling_is_told_once_and_loading_is_silent(program: Program) -> None:
    """On stderr, for all kernels together."""
    assert program.run() == ("2 1.0\n", MESSAGE)
    assert program.run() == ("2 1.0\n", "")
    assert len(program.files) == 4  # one for each type of `twice`, and the kernels


def test_where_only_what_is_stored_is_loaded_nothing_is_compiled(program: Program) -> None:
    """What is not stored is refused, and compiled when it is called again."""
    words = (
        "import doubling",
        "from carom.systems.kernels.stored import NotStoredError, only_stored",
        "exec('with only_stored():\\n try: print(doubling.of_fractions(1))\\n except NotStoredError as e: print(e)')",
    )
    assert program.start(*words).communicate() == ("of_fractions\n", "")
    assert program.files == []
    call = ("print(doubling.of_fractions(1))",)
    assert program.start(*words, *call).communicate() == ("of_fractions\n1.0\n", MESSAGE)
    assert program.start(*words).communicate() == ("1.0\n", "")


def test_other_threads_compile_meanwhile(program: Program) -> None:
    """A world may take its first step where another one already needs a kernel that is not stored."""
    words = (
        "import doubling",
        "from threading import Thread",
        "from carom.systems.kernels.stored import only_stored",
        "other = Thread(target=lambda: print(doubling.of_fractions(1)))",
        "exec('with only_stored():\\n other.start()\\n other.join()')",
    )
    assert program.start(*words).communicate() == ("1.0\n", MESSAGE)


def test_what_cannot_be_read_is_compiled_anew(program: Program) -> None:
    """A pickle of a class that has moved, and half a file."""
    program.run()
    moved, half, *_ = program.files
    stamp = moved.read_bytes().partition(b"\n")[0]
    moved.write_bytes(stamp + b"\ncnumba.elsewhere\nGone\n.")
    half.write_bytes(half.read_bytes()[:-100])
    assert program.run() == ("2 1.0\n", MESSAGE)
    assert program.run() == ("2 1.0\n", "")


def test_processes_fill_one_empty_cache_at_once(program: Program) -> None:
    """Two compile a type each of the function that both call, one compiles all; what they leave is whole."""
    words = [("import doubling", f"print(doubling.{name}(1))") for name in ("of_whole_numbers", "of_fractions")]
    started = [program.start(*words[0]), program.start(*words[1]), program.start()]
    assert [process.communicate()[0] for process in started] == ["2\n", "1.0\n", "2 1.0\n"]
    assert program.run() == ("2 1.0\n", "")
    assert len(program.files) == len([path for path in program.cache.rglob("*") if path.is_file()]) == 4


def test_another_stamp_is_another_function(tmp_path: Path) -> None:
    """What was saved under the one before is not loaded, and gives way."""
    Files(tmp_path, "balls.roll", "before").save("key", 1)
    assert Files(tmp_path, "balls.roll", "before").load("key") == 1
    after = Files(tmp_path, "balls.roll", "after")
    assert after.load("key") is None
    after.save("key", 2)
    assert after.load("key") == 2
    assert after.load("other key") is None
    assert [path.name for path in tmp_path.iterdir()] == [after.path("key").name]
