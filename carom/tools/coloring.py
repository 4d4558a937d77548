"""Coloring: what the colour of a body tells, as one mapping from a world to colours for whoever draws it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from carom.ecs import BodyType, Collider, Motion, RigidBody, Visual, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.compound import bodies_of
from carom.systems.energy import kinetic_energies
from carom.systems.layers import Layers
from carom.systems.links import all_islands
from carom.systems.sleep_state import STATES, sleep_states
from carom.tools.round_numbers import next_round

GRAY = (0.62, 0.62, 0.62)
UNSAID = (np.nan, np.nan, np.nan)  # of what a mode says nothing about, which is gray, as light as it looks
LIGHT = np.array((0.30, 0.59, 0.11))  # how light colours look. Source: ITU-R BT.601
KINDS = {"static": GRAY, "kinematic": (0.90, 0.62, 0.0), "dynamic": (0.34, 0.71, 0.91)}
SLEEP = dict(zip(STATES, (GRAY, (0.90, 0.62, 0.0), (0.97, 0.88, 0.42), (0.30, 0.42, 0.70)), strict=True))
#: Colours of few things that most eyes tell apart, colour-blind ones too. Source: Okabe and Ito, Color universal
#: design, 2002; yellow is darker here, since it is lit.
FEW = np.array([
    (0.0, 0.45, 0.70), (0.90, 0.62, 0.0), (0.0, 0.62, 0.45), (0.80, 0.47, 0.65),
    (0.34, 0.71, 0.91), (0.84, 0.37, 0.0), (0.87, 0.82, 0.20), (0.35, 0.35, 0.35),
])  # fmt: skip
#: Viridis at nine even steps, alike in steps to the eye. Source: S. van der Walt and N. Smith, matplotlib 1.5, 2015.
SCALE = np.array([
    (0.267, 0.005, 0.329), (0.279, 0.175, 0.483), (0.230, 0.322, 0.546), (0.173, 0.449, 0.558), (0.128, 0.567, 0.551),
    (0.158, 0.684, 0.502), (0.369, 0.789, 0.383), (0.678, 0.864, 0.190), (0.993, 0.906, 0.144),
])  # fmt: skip
GOLDEN = 0.6180339887498949  # hues of things numbered in a row, each as far as can be from those before


@dataclass(frozen=True)
class Legend:
    """What colours mean: ``names`` with a colour each, or, where it is a scale, 0 to ``most`` in ``unit``."""

    title: str
    names: tuple[str, ...] = ()
    colors: Sequence[tuple[float, ...]] = ()
    unit: str = ""
    most: float = 0.0


class Coloring:
    """A mode of colour, such as ``speed``; an instance belongs to one film or picture.

    The scale of one with numbers ends at the largest so far, taken for the next of 1, 2 and 5 times a power of ten.
    """

    def __init__(self, mode: str) -> None:
        self._mode, self._largest = MODES[mode], 0.0
        self.legend: Legend | None = None
        self.keeps_looks = mode == "material"

    def colors(self, world: World, rows: Integers) -> Floats:
        """Return the colour (n, 4) of each row of what is visible; alpha stays that of its look."""
        own = world[Visual].color[rows]
        body = np.append(bodies_of(world), -1)[rows]  # of a row out of use
        told = self._mode(self, world, rows, body)
        if told is None:
            return own
        gray = 0.25 + 0.5 * (own[:, :3] @ LIGHT)[:, None]
        return np.column_stack([np.where(np.isnan(told), gray, told), own[:, 3]])

    def material(self, world: World, rows: Integers, body: Integers) -> None:
        """Leave colours as they are."""

    def entity(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Tell entities apart."""
        return hues(rows)

    def kind(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Tell static, kinematic and dynamic bodies apart."""
        dynamic = world[RigidBody].type[body] == BodyType.DYNAMIC
        return self._named("body", KINDS, np.where(body < 0, 0, 1 + dynamic))

    def sleep(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Tell bodies that sleep from those that are awake, and from those slow enough to fall asleep."""
        return self._named("state", SLEEP, sleep_states(world, body))

    def island(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Give those one colour that touch each other, directly or by way of others."""
        island = all_islands(world)
        return np.where(_pushed(world, body)[:, None], hues(island[body]), UNSAID)

    def layer(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Tell the layers of colliders apart."""
        layers = world[Layers].bits
        colors = {name: tuple(FEW[n % len(FEW)]) for n, name in enumerate(layers)}
        has = world.table(Collider).present[rows]
        bits = np.where(has, world[Collider].layer[rows], -1)
        same = bits[:, None] == list(layers.values())
        which = np.where(same.any(axis=1), same.argmax(axis=1), -1)
        return np.where((which < 0)[:, None], UNSAID, self._named("layer", colors, which))

    def speed(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Show how fast centres of mass are."""
        return self._scaled("speed", "m/s", body, np.linalg.norm(world[Motion].linear[body], axis=1))

    def energy(self, world: World, rows: Integers, body: Integers) -> Floats:
        """Show the energy of motion and rotation of dynamic bodies."""
        energies, pushed = np.zeros(len(body)), _pushed(world, body)
        energies[pushed] = kinetic_energies(world, body[pushed])
        return self._scaled("kinetic energy", "J", np.where(pushed, body, -1), energies)

    def _named(self, title: str, colors: Mapping[str, tuple[float, ...]], which: Integers) -> Floats:
        self.legend = Legend(title, tuple(colors), tuple(colors.values()))
        return np.array(list(colors.values()))[which]

    def _scaled(self, title: str, unit: str, body: Integers, values: Floats) -> Floats:
        self._largest = max(self._largest, float(values[body >= 0].max(initial=0.0)))
        most = next_round(self._largest) if self._largest > 0.0 else 1.0
        self.legend = Legend(title, unit=unit, most=most)
        return np.where((body < 0)[:, None], UNSAID, on_scale(values / most))


MODES: dict[str, Callable[[Coloring, World, Integers, Integers], Floats | None]] = {
    "material": Coloring.material, "entity": Coloring.entity, "kind": Coloring.kind, "sleep": Coloring.sleep,
    "island": Coloring.island, "layer": Coloring.layer, "speed": Coloring.speed, "energy": Coloring.energy,
}  # fmt: skip


def on_scale(shares: Floats) -> Floats:
    """Return the colours (n, 3) of shares (n,) of a scale, 0 dark blue and 1 yellow."""
    steps = np.linspace(0.0, 1.0, len(SCALE))
    return np.stack([np.interp(shares, steps, SCALE[:, channel]) for channel in range(3)], axis=1)


def hues(numbers: Integers) -> Floats:
    """Return colours (n, 3) of numbers, each always the same and far from those of its neighbours."""
    turn = (numbers * GOLDEN % 1.0)[:, None] - [0.0, 1.0 / 3.0, 2.0 / 3.0]
    return 0.55 + 0.35 * np.cos(2.0 * np.pi * turn)


def _pushed(world: World, body: Integers) -> Booleans:
    return np.asarray((body >= 0) & (world[RigidBody].inverse_mass[body] > 0.0))
