"""Forces: a free-body diagram of every dynamic body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.free_body import FRICTION, JOINT, NORMAL, loads
from carom.tools.marks import Arrows, Labels, Mark
from carom.tools.overlays.overlay import Overlay, Scaling, Seen

LONGEST = 0.4  # of the picture's height at the camera's target: an impact is far larger than what it is compared with
COLORS = {
    "gravity": (0.98, 0.86, 0.25),
    NORMAL: (1.0, 0.45, 0.2),
    FRICTION: (0.95, 0.35, 0.75),
    JOINT: (0.7, 0.55, 1.0),
}
OTHERS = (0.45, 0.8, 1.0)


class ForceMarks(Overlay):
    """Arrows over everything, each with its name and size in N.

    Contacts, joints and laws that say so are drawn from where they act, all else from centres of mass. The scale is
    that of all but contacts and joints; a longer arrow is cut, and only its label tells.
    """

    key: ClassVar[str] = "forces"

    def __init__(self) -> None:
        self._scaling = Scaling()

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the arrows, and a label at the end of each."""
        found = loads(seen.simulation)
        touches = np.isin(found.name, (NORMAL, FRICTION, JOINT))
        scale = self._scaling.metres_per_unit(found.force[~touches] if not touches.all() else found.force, seen)
        sizes = np.linalg.norm(found.force, axis=1)
        shares = np.minimum(scale, seen.metres(LONGEST) / sizes)
        ends = found.point + found.force * shares[:, None]
        colors = np.array([(*COLORS.get(name, OTHERS), 1.0) for name in found.name]).reshape(-1, 4)
        texts = [f"{name} {newtons(size)}" for name, size in zip(found.name, sizes, strict=True)]
        order = np.argsort(-sizes, kind="stable")
        labels = Labels(ends[order], [texts[number] for number in order.tolist()], colors[order])
        return [Arrows(found.point, ends, colors), labels]


def newtons(size: Floats) -> str:
    """Return a force in words, with three digits."""
    return f"{size:.3g} N" if size < 1e3 else f"{size / 1e3:.3g} kN"
