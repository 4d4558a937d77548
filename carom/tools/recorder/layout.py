"""Layout: what a recording shows when it is opened, as its tracks state it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import Any, NamedTuple

from carom.tools.recorder.stream import FRAME, TIME


class Scene(NamedTuple):
    """A view of the world: its name, what it holds, how some paths are shown in it, and whether over a grid."""

    name: str
    contents: list[str]
    overrides: dict[str, list[Any]]
    grid: bool


class Layout:
    """The plots and texts beside the views of the world, from top to bottom, and what these show."""

    def __init__(self) -> None:
        self.plots: list[Any] = []
        self.texts: list[Any] = []
        self.scenes: list[Scene] = []
        self.overrides: defaultdict[str, list[Any]] = defaultdict(list)
        self.lanes = False

    def plot(self, path: str, name: str, hidden: str = "") -> None:
        """Add the curves below a path, in one plot, but for those in a ``hidden`` folder of it."""
        import rerun.blueprint as rrb

        contents = ["+ $origin/**", *([f"- $origin/{hidden}/**"] if hidden else [])]
        self.plots.append(rrb.TimeSeriesView(origin=path, contents=contents, name=name))

    def plot_first(self, name: str, plots: Mapping[str, str]) -> None:
        """Add plots by their paths, one behind the other, before those that are there."""
        import rerun.blueprint as rrb

        views = [rrb.TimeSeriesView(origin=path, name=title) for path, title in plots.items()]
        self.plots.insert(0, rrb.Tabs(*views, name=name))

    def hide(self, path: str) -> None:
        """Leave a path to be shown by a click on its eye in the list of what the view of the world holds."""
        import rerun.blueprint as rrb

        self.overrides[path].append(rrb.EntityBehavior(visible=False))

    def keep(self, path: str, seconds: float, dt: float) -> None:
        """Show what was written within the last seconds at once, by steps of ``dt`` (s) or by time."""
        import rerun.blueprint as rrb

        now = rrb.TimeRangeBoundary.cursor_relative
        ranges = [
            rrb.VisibleTimeRange(FRAME, start=now(seq=-round(seconds / dt)), end=now()),
            rrb.VisibleTimeRange(TIME, start=now(seconds=-seconds), end=now()),
        ]
        self.overrides[path].append(rrb.VisibleTimeRanges(ranges))

    def scene(self, name: str, contents: list[str], overrides: dict[str, list[Any]], *, grid: bool) -> None:
        """Add a view beside that of the world, from the same camera."""
        self.scenes.append(Scene(name, contents, overrides, grid))
