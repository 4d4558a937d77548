"""Lanes: in which state something is over time, as Rerun's view of state timelines shows it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from carom.tools.recorder.stream import Stamp, Stream

ROOT = "lanes"
MOST_NAMES = 3  # in one state
Color = tuple[int, int, int]


class Lanes:
    """States by the name of a lane, written where they change; None is a gap."""

    def __init__(self, group: str, colors: Mapping[str, Color] | None = None) -> None:
        self._group, self._colors = group, colors or {}
        self._states: dict[str, str | None] = {}
        self._pending: dict[str, list[tuple[Stamp, str | None]]] = defaultdict(list)

    def note(self, name: str, stamp: Stamp, state: str | None) -> None:
        """Keep the state of a lane, if it is another than before."""
        if name not in self._states or self._states[name] != state:
            self._states[name] = state
            self._pending[name].append((stamp, state))

    def note_all(self, stamp: Stamp, states: Mapping[str, str]) -> None:
        """Keep the states of all lanes; one that is not among them has none any more."""
        for name in [*states, *(self._states.keys() - states.keys())]:
            self.note(name, stamp, states.get(name))

    def write(self, stream: Stream) -> None:
        """Write what was kept."""
        import rerun

        for name, changes in self._pending.items():
            path = str(rerun.new_entity_path([ROOT, self._group, name]))
            if self._colors:
                values, colors = list(self._colors), list(self._colors.values())
                stream.static(path, rerun.StateConfiguration(values=values, colors=colors))
            for stamp, state in changes:
                stream.row(path, stamp, rerun.StateChange(state=state))
        self._pending.clear()


def told(names: Sequence[str], there: str) -> str:
    """Return names as a state, or how many are ``there``; empty for none."""
    return f"{len(names)} {there}" if len(names) > MOST_NAMES else ", ".join(names)
