"""Kinds of joints: the declaration each makes in a file of its own, and their registry."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Self

from carom.ecs.components.joint import Joint
from carom.systems.declared import Stated, Steps, flag, whom
from carom.systems.joints.held import Held
from carom.systems.joints.ways import Ways
from carom.systems.parameters import parameter, same, vector
from carom.systems.registry import Keyed

JOINTS: dict[str, type[JointKind]] = {}
Vector = tuple[float, float, float]
NOWHERE = (0.0, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class JointKind(Stated, Keyed, ABC, registry=JOINTS, kinds="joints"):
    """What holds b to a; ``key`` is its word in files, and its words are declared fields.

    Angles and distances are those of b against a, and 0 at the poses at which the joint is stated.
    """

    a: Any = whom(doc="who holds, the world by default")
    b: Any = whom(doc="who is held, the world by default")
    anchor_a: Vector | None = vector(unit="m", doc="anchor in the frame of a", default=None)
    anchor_b: Vector | None = vector(unit="m", doc="anchor in the frame of b", default=None)
    break_force: float = parameter(unit="N", doc="force beyond which it breaks", default=math.inf, above=0.0)
    collide: bool = flag(doc="whether a and b touch each other")

    def joint(self, a: Held, b: Held) -> Joint:
        """Return the component, the anchors and frames being where both are now."""
        ways = Ways()
        self.hold(ways, a, b)
        shared = {name: getattr(self, name) for name in ("break_force", "collide")}
        return Joint(a=a.entity, b=b.entity, **shared, **self.columns(a, b), **ways.columns)

    @abstractmethod
    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Say which ways are locked, limited, driven and rubbed."""

    @abstractmethod
    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return where it is anchored, what it measures along and about, and the place of b."""

    @classmethod
    def of(cls, joint: Joint) -> Self | None:
        """Return what states a joint of one row, a and b left out, wherever both are; None where this kind cannot."""
        return None

    def misplaced(self, a: Held, b: Held) -> Iterator[tuple[Steps, str]]:
        """Yield what is wrong with its words for those whom it holds, as `faults` does."""
        yield from ()


def anchors_of(joint: Joint) -> dict[str, Any]:
    """Return the words for the anchors of a joint of one row, those at the origin left out."""
    anchors = {name: tuple(getattr(joint, name).tolist()) for name in ("anchor_a", "anchor_b")}
    return {name: anchor for name, anchor in anchors.items() if not same(anchor, NOWHERE)}
