"""About: what was simulated, with which settings and versions, as text and as values of the recording."""

from __future__ import annotations

import dataclasses
import platform
from importlib.metadata import version
from typing import Any

import carom
from carom.systems.extensions import load_extensions
from carom.systems.settings import Settings

PATH = "about"
PACKAGES = ("numpy", "numba", "python-fcl", "rerun-sdk")


def versions() -> dict[str, str]:
    """Return the versions a result may depend on."""
    own = {"carom": carom.__version__, "python": platform.python_version()}
    others = {extension.distribution: extension.version for extension in load_extensions()}
    return own | {name: version(name) for name in PACKAGES} | others


def about(title: str, settings: Settings, source: str | None) -> list[Any]:
    """Return a text to read and the same as values: settings with the seed, versions, the world file as it was."""
    import rerun

    stated: dict[str, Any] = {name: _plain(value) for name, value in dataclasses.asdict(settings).items()}
    used = versions()
    lines = [f"# {title}", "", "| setting | value |", "| --- | --- |"]
    lines += [f"| {name} | {value} |" for name, value in stated.items()]
    lines += ["", " · ".join(f"{name} {number}" for name, number in used.items())]
    if source is not None:
        lines += ["", "```yaml", source.rstrip(), "```"]
    document = rerun.TextDocument("\n".join(lines), media_type="text/markdown")
    tagged = {f"version_{name.replace('-', '_')}": number for name, number in used.items()}
    return [document, rerun.AnyValues(title=title, world_file=source or "", **stated, **tagged)]


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
