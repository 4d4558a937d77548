"""Which modules are public: packages that state ``__all__``, and whatever the pages and the examples import."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
EXAMPLES = ("tests/example_extension", "tests/example_game")


@cache
def modules() -> list[str]:
    """Return their names, in order."""
    packages = (ROOT / "carom").rglob("__init__.py")
    stated = [dotted(path.parent) for path in packages if "\n__all__ = " in path.read_text(encoding="utf-8")]
    return sorted({*stated, *(module for code in shown() for module in imported(code))})


def parts(module: str) -> list[str]:
    """Return the modules that a package names in ``__all__`` and that have no page of their own."""
    path = ROOT / Path(*module.split("."), "__init__.py")
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    found = re.search(r"^__all__ = (\[.*?\])", text, re.MULTILINE | re.DOTALL)
    names = [f"{module}.{name}" for name in ast.literal_eval(found[1])] if found else []
    files = [name for name in names if (ROOT / Path(*name.split("."))).with_suffix(".py").is_file()]
    return [name for name in files if name not in modules()]


def dotted(path: Path) -> str:
    """Return the name of the module at a path."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def shown() -> Iterator[str]:
    """Yield the Python that a reader sees: blocks of pages, files of the examples."""
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        yield from BLOCK.findall(page.read_text(encoding="utf-8"))
    for folder in EXAMPLES:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield path.read_text(encoding="utf-8")


def imported(code: str) -> Iterator[str]:
    """Yield the modules of carom from which some code imports."""
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.partition(".")[0] == "carom":
            yield node.module
            for name in node.names:  # which may be modules themselves
                path = ROOT / Path(*node.module.split("."), name.name)
                if path.with_suffix(".py").is_file():
                    yield f"{node.module}.{name.name}"
