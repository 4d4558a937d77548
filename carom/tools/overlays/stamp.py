"""Stamp: the number of the frame and the simulated time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from carom.tools.marks import Inset, Mark
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.panel import Panel, text_size


class Stamp(Overlay):
    """Both in the corner at the bottom on the left."""

    key: ClassVar[str] = "stamp"

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the text."""
        text = f"{seen.time:.3f} s   frame {seen.world.frame}"
        return [Inset(Panel.of_lines([text], text_size(seen.view.height)).pixels(), "bottom left")]
