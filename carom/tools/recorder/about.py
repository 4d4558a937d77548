"""About: what was simulated, with which settings, frame, versions and files, on what, as text and as values."""

from __future__ import annotations

import dataclasses
import platform
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

import carom
from carom.ecs.explain import explain
from carom.systems.extensions import load_extensions
from carom.systems.simulation import Simulation
from carom.tools.machine import this_machine

PATH = "about"
FILES = "about/files"
PACKAGES = ("numpy", "numba", "python-fcl", "rerun-sdk")


def versions() -> dict[str, str]:
    """Return the versions a result may depend on."""
    own = {"carom": carom.__version__, "python": platform.python_version()}
    others = {extension.distribution: extension.version for extension in load_extensions()}
    return own | {name: version(name) for name in PACKAGES} | others


def versions_here() -> dict[str, str]:
    """Return them by the names they have in a recording, with the processor as ``this_machine`` knows it."""
    tagged = {f"version_{name.replace('-', '_')}": number for name, number in versions().items()}
    return tagged | {"processor": this_machine().processor}


def about(title: str, simulation: Simulation, source: str | None, detail: str, only: list[str]) -> list[Any]:
    """Return a text to read and the same as values: settings with the seed, versions, the world file as it was."""
    import rerun

    stated: dict[str, Any] = {name: _plain(value) for name, value in dataclasses.asdict(simulation.settings).items()}
    lines = [f"# {title}", "", "| setting | value |", "| --- | --- |"]
    lines += [f"| {name} | {value} |" for name, value in stated.items()]
    lines += ["", " · ".join(f"{name} {number}" for name, number in versions().items())]
    if source is not None:
        lines += ["", "```yaml", source.rstrip(), "```"]
    document = rerun.TextDocument("\n".join(lines), media_type="text/markdown")
    frame = explain(simulation.schedule)
    own: dict[str, Any] = {"title": title, "world_file": source or "", "schedule": frame, "detail": detail}
    if only:
        own["only"] = only
    values = rerun.AnyValues(**own, **stated, **versions_here())
    return [document, values]


def files(contents: Mapping[str, bytes]) -> Any:
    """Return the content of the files a world names, with its words for them."""
    import pyarrow
    import rerun

    return rerun.AnyValues(name=list(contents), content=pyarrow.array(contents.values(), pyarrow.binary()))


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
