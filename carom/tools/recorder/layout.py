"""Layout: what a recording shows when it is opened, as its tracks state it."""

from __future__ import annotations

from typing import Any


class Layout:
    """The plots and texts beside the view of the world, from top to bottom, and what is hidden in it at first."""

    def __init__(self) -> None:
        self.plots: list[Any] = []
        self.texts: list[Any] = []
        self.hidden: list[str] = []

    def plot(self, path: str, name: str) -> None:
        """Add the curves below a path, in one plot."""
        import rerun.blueprint as rrb

        self.plots.append(rrb.TimeSeriesView(origin=path, name=name))

    def hide(self, path: str) -> None:
        """Leave a path to be shown by a click on its eye in the list of what the view of the world holds."""
        self.hidden.append(path)
