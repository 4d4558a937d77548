"""The rooms depend on each other in one direction, and heavy libraries stay in the room that needs them, lazily."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import carom

PACKAGE = Path(carom.__file__).parent
ROOMS = ("ecs", "systems", "worlds", "tools")
KEPT_IN = {"fcl": "systems", "rerun": "tools", "rerun_cli": "tools", "pyrender": "tools", "OpenGL": "tools"}
# These derive from pyrender's classes; whoever needs them imports them inside a function.
DRAWING = {f"carom.tools.{name}" for name in ("instances", "osmesa", "passes", "surfaceless")}
COMPARING = ("tools", "bench")  # where carom is measured against any library
FILES = sorted(PACKAGE.rglob("*.py"))


class Import(NamedTuple):
    """One imported module, by absolute name, and whether importing the file imports it."""

    module: str
    line: int
    eager: bool


def imports(path: Path) -> Iterator[Import]:
    """Yield every import of a file."""
    package = ("carom", *path.relative_to(PACKAGE).parent.parts)
    yield from _imports(ast.parse(path.read_text()), package, True)


def _imports(node: ast.AST, package: tuple[str, ...], eager: bool) -> Iterator[Import]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import):
            yield from (Import(alias.name, child.lineno, eager) for alias in child.names)
        elif isinstance(child, ast.ImportFrom):
            base = package[: len(package) - child.level + 1] if child.level else ()
            stem = ".".join([*base, *([child.module] if child.module else [])])
            yield from (Import(f"{stem}.{alias.name}", child.lineno, eager) for alias in child.names)
        else:
            typing_only = isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test)
            in_function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
            yield from _imports(child, package, eager and not typing_only and not in_function)


def faults(path: Path) -> list[str]:
    """Return what is wrong with the imports of one file."""
    parts = path.relative_to(PACKAGE).parts
    room = parts[0] if parts[0] in ROOMS else None
    drawing = ".".join(["carom", *path.relative_to(PACKAGE).with_suffix("").parts]) in DRAWING
    found = []
    for module, line, eager in imports(path):
        where = f"{path.relative_to(PACKAGE.parent)}:{line} imports {module}"
        names = module.split(".")
        if names[0] == "carom" and len(names) > 1 and names[1] in ROOMS:
            if room is None or ROOMS.index(names[1]) > ROOMS.index(room):
                found.append(f"{where}, against the arrow")
            elif eager and not drawing and DRAWING & {module, module.rpartition(".")[0]}:
                found.append(f"{where} eagerly: move it into the function that needs it")
        elif names[0] in KEPT_IN:
            if room != KEPT_IN[names[0]] and parts[:2] != COMPARING:
                found.append(f"{where}, which belongs in {KEPT_IN[names[0]]}/")
            elif eager and not drawing:
                found.append(f"{where} eagerly: move it into the function that needs it")
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_arrows_point_one_way_and_heavy_imports_are_lazy(path: Path) -> None:
    """Every file of the package, by the roots of what it imports."""
    assert faults(path) == []


def test_a_relative_import_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A relative import against the arrow is a fault like an absolute one."""
    for folder in ("carom", "carom/ecs"):
        (tmp_path / folder).mkdir()
    wrong = tmp_path / "carom" / "ecs" / "wrong.py"
    wrong.write_text("from ..tools import cli\nfrom .. import systems\nimport fcl\n")
    monkeypatch.setattr(
        "test_arrows.PACKAGE" if __name__ == "test_arrows" else f"{__name__}.PACKAGE", tmp_path / "carom"
    )
    assert [fault.partition(", ")[2] for fault in faults(wrong)] == [
        "against the arrow",
        "against the arrow",
        "which belongs in systems/",
    ]
