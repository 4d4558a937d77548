"""Force laws: what a world states about its forces, and the list each force system works through."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar, TypeVar

import numpy as np

from carom.ecs import Collider, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError, did_you_mean
from carom.systems.bodies import centers_of_mass
from carom.systems.forces.reach import NOBODY, Reach
from carom.systems.parameters import WordFault, make_plain, number_fault, parameter, unknown_keys, vector
from carom.systems.progress import Progress
from carom.systems.registry import Keyed

LAWS: dict[str, type[Law]] = {}
L = TypeVar("L", bound="Law")
EVERYBODY = Reach()

__all__ = ["LAWS", "Forces", "Law", "parameter", "vector"]


@dataclass(frozen=True)
class Law(Keyed, registry=LAWS, kinds="force laws"):
    """One force of a world; parameters are fields declared by `parameter`, and ``key`` is its word in files."""

    conservative: ClassVar[bool] = False  # it has a potential energy, see `energy`
    moves_medium: ClassVar[bool] = False  # it adds to the velocity of the medium, to which all drags are relative

    def __post_init__(self) -> None:
        """Refuse parameters outside their bounds; raise DeclarationError naming all of them. Kernels take floats."""
        stated = [one for one in fields(self) if "unit" in one.metadata and getattr(self, one.name) is not one.default]
        faults = [(one.name, number_fault(one.metadata, getattr(self, one.name))) for one in stated]
        if any(fault for _, fault in faults):
            raise DeclarationError("; ".join(f"{self.key}.{name}: {fault}" for name, fault in faults if fault))
        make_plain(self, (one.name for one in stated))

    @property
    def steady(self) -> bool:
        """Whether it is the same as long as the body stays where it is, so that it may fall asleep."""
        return True

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return the potential energy (J) of bodies of these masses (n,) with these centres of mass (n, 3)."""
        raise NotImplementedError

    def energy_of(self, world: World, rows: Integers) -> float:
        """Return the potential energy (J) of bodies (rows) as they are now."""
        return self.energy(world[RigidBody].mass[rows], centers_of_mass(world, rows))

    def points(self, world: World, rows: Integers) -> Floats:
        """Return where it acts on bodies (n, 3), m, world frame, for who looks on: at their centres of mass."""
        return centers_of_mass(world, rows)

    def flow(self, world: World, points: Floats) -> Floats:
        """Return the velocity (n, 3) in m/s of a medium of its own at points (n, 3) in m, for who looks on."""
        return np.zeros_like(points)

    def bears(self, world: World, rows: Integers) -> Booleans:
        """Tell which bodies (n,) it holds up by itself, so that they may fall asleep though they touch nothing."""
        return np.zeros(len(rows), np.bool_)

    def refuse_unless(self, fits: bool, word: str, fault: str) -> None:
        """Raise DeclarationError, which says what is wrong with a word, unless it fits."""
        if not fits:
            raise DeclarationError(f"{self.key}.{word}: {fault}")


def read_law(key: str, words: Mapping[str, Any], faults: list[WordFault]) -> Law | None:
    """Return the law that words state; None where anything is wrong with them, all of which is added to ``faults``."""
    if key not in LAWS:
        faults.append(WordFault((key,), "unknown force law", repr(key), ", ".join(LAWS), did_you_mean(key, LAWS)))
        return None
    takes, before = {one.name: one for one in fields(LAWS[key])}, len(faults)
    faults += unknown_keys((key,), words, takes)
    lacking = [name for name, one in takes.items() if one.default is MISSING and name not in words]
    faults += [WordFault((key, name), "is missing", accepted=takes[name].metadata["doc"]) for name in lacking]
    return LAWS[key](**words) if len(faults) == before else None


@dataclass
class Forces(Resource):
    """The force laws of a world, each with whom it acts on, where and when."""

    entries: dict[type[Law], list[tuple[Any, Reach]]] = field(default_factory=dict)
    limits: dict[Reach, Integers] = field(default_factory=dict)  # with whom each acts on in this substep

    def add(self, law: Law, reach: Reach = EVERYBODY) -> None:
        """Let a law act from now on."""
        self.entries.setdefault(type(law), []).append((law, reach))
        if reach.limited:
            self.limits[reach] = NOBODY

    @property
    def count(self) -> int:
        """How many laws there are."""
        return sum(map(len, self.entries.values()))

    def choose(self, world: World, time: float) -> None:
        """Find whom limited laws act on at a time (s), by where bodies are now."""
        for reach in self.limits:
            self.limits[reach] = reach.rows(world) if reach.acts_at(time) else NOBODY

    def at(self, world: World, time: float) -> Forces:
        """Return these laws as they act at a time (s) on bodies as they are now, for who looks on from outside."""
        now = Forces(self.entries, dict(self.limits))
        now.choose(world, time)
        return now

    def acting(self, kind: type[L], world: World) -> Sequence[tuple[L, Integers]]:
        """Return each law of a kind with the rows of the living bodies it acts on in this substep."""
        entries = self.entries.get(kind)
        if entries is None:  # most laws of most worlds, in every substep
            return ()
        return [(law, self.limits[reach] if reach.limited else reach.rows(world)) for law, reach in entries]

    def restless(self, world: World) -> Iterator[tuple[Law, Integers]]:
        """Yield each law that pushes another way in every step, with the rows of the bodies it acts on."""
        for kind in self.entries:
            yield from ((law, rows) for law, rows in self.acting(kind, world) if not law.steady)

    def borne(self, world: World) -> Booleans:
        """Tell of each row in use whether a law bears the body by itself."""
        found = np.zeros(world.used(), np.bool_)
        for kind in self.entries:
            for law, rows in self.acting(kind, world):
                found[rows] |= law.bears(world, rows)
        return found

    def turned(self, world: World, begin: float, end: float) -> Integers:
        """Return the rows of bodies on which laws begin or cease to act after ``begin`` (s) and not after ``end``."""
        turning = [reach.rows(world) for reach in self.limits if reach.turns_within(begin, end)]
        return np.concatenate(turning) if turning else NOBODY


@system(reads=(Progress, RigidBody, Transform, Collider, Parent), writes=(Forces,))
def choose_bodies(world: World, dt: float) -> None:
    """Find whom laws with a region, layers or a time window act on, as things are in the middle of the substep."""
    if world[Forces].limits:
        world[Forces].choose(world, world[Progress].clock + 0.5 * dt)
