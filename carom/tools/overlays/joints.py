"""Joints: whom they hold and where, how loaded they are, their axes, limits and motors; and springs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import Joint
from carom.ecs.components.spring import Spring
from carom.tools.coloring import Legend, on_scale
from carom.tools.jointed import Jointed, coiled, is_coil, jointed, limits_of, ways_of
from carom.tools.legends import legend_inset
from carom.tools.marks import Arrows, Lines, Mark, Points, tinted
from carom.tools.overlays.overlay import Overlay, Scaling, Seen
from carom.tools.round_numbers import next_round

AXIS, LIMIT, NEEDLE, MOTOR, PIN = (
    (0.55, 0.75, 1.0), (1.0, 0.85, 0.3), (1.0, 1.0, 1.0), (0.35, 0.9, 0.45), (0.95, 0.95, 0.95)
)  # fmt: skip
LEAST = 1e-6  # N, N m: what a motor does that has nothing to do
OF_AXES, OF_LIMITS, OF_COILS = 0.05, 0.06, 0.012  # of the picture's height at the camera's target


class JointMarks(Overlay):
    """A line from body to body through the anchors of each joint, in the colour of its load, drawn over everything.

    Blue lines are axes of ways that are not locked, yellow arcs and tracks limits with a white needle where the joint
    is, green arrows what motors do, as long as their force or torque. Springs are zigzags.
    """

    key: ClassVar[str] = "joints"

    def __init__(self) -> None:
        self._most = 0.0
        self._forces, self._torques = Scaling(0.15), Scaling(0.15)

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return lines and dots, a legend of the loads, and keys of the arrows."""
        world, joint, spring = seen.world, seen.world[Joint], seen.world[Spring]
        found, springs = (jointed(world, kind, seen.transform) for kind in (Joint, Spring))
        loads = np.sqrt((joint.force[found.rows] ** 2).sum(axis=1))
        tensions = np.abs(spring.tension[springs.rows])
        self._most = max(self._most, float(np.concatenate([loads, tensions]).max(initial=0.0)))
        most = next_round(self._most) if self._most > 0.0 else 1.0
        links = [_links(found, loads / most, is_coil(world, found), seen)]
        links.append(_links(springs, tensions / most, np.arange(len(springs.rows)), seen))
        rim, needles = limits_of(world, found, seen.metres(OF_LIMITS))
        pins = np.concatenate([found.at_a, found.at_b, springs.at_a, springs.at_b])
        key = [legend_inset(Legend("load of joints", unit="N", most=most), seen.view)] if self._most > 0.0 else []
        return [*links, *self._ways(found, seen), _lines(rim, LIMIT), _lines(needles, NEEDLE),
                Points(pins, tinted(PIN, len(pins)), 4.0), *key]  # fmt: skip

    def _ways(self, found: Jointed, seen: Seen) -> list[Mark]:
        """Return axes, and arrows for what drives along and about them."""
        joint, ways = seen.world[Joint], ways_of(seen.world, found)
        at, reach = found.at_a[ways.joint], seen.metres(OF_AXES) * ways.axis
        effort = joint.effort[found.rows[ways.joint], ways.slot]
        made: list[Mark] = [Lines(at - reach, at + reach, tinted(AXIS, len(at)), 2.0)]
        for scaling, which, title, unit in (
            (self._forces, ways.slot < 3, "motor", "N"), (self._torques, ways.slot >= 3, "motor", "N m")
        ):  # fmt: skip
            works = which & (np.abs(effort) > LEAST)
            arrows = scaling.metres(effort[works, None] * ways.axis[works], seen)
            made.append(Arrows(at[works], at[works] + arrows, tinted(MOTOR, len(arrows)), 2.5))
            made += scaling.key(title, unit, MOTOR, seen)
        return made


def _links(found: Jointed, shares: Floats, coils: Integers, seen: Seen) -> Lines:
    """Return lines from body to anchor to anchor to body, those of springs as zigzags."""
    colors = np.concatenate([on_scale(shares), np.ones((len(shares), 1))], axis=1)
    zigzag = coiled(found.at_a[coils], found.at_b[coils], seen.metres(OF_COILS))
    straight = np.setdiff1d(np.arange(len(shares)), coils)
    starts = np.concatenate([found.from_a, found.at_b, found.at_a[straight], zigzag[:, :-1].reshape(-1, 3)])
    ends = np.concatenate([found.at_a, found.from_b, found.at_b[straight], zigzag[:, 1:].reshape(-1, 3)])
    tints = [colors, colors, colors[straight], np.repeat(colors[coils], zigzag.shape[1] - 1, axis=0)]
    return Lines(starts, ends, np.concatenate(tints), 2.0)


def _lines(pairs: Floats, color: tuple[float, float, float]) -> Lines:
    return Lines(pairs[:, 0], pairs[:, 1], tinted(color, len(pairs)), 1.5)
