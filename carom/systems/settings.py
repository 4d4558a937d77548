"""Settings: how a simulation steps, and the defaults in one table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Literal, get_args

import numpy as np

from carom.ecs import World
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError
from carom.systems.parameters import number_fault, refusal, unknown_keys

MOST_THREADS = 64
MOST_SUBSTEPS = 1000  # a step of more would not end before the user does
NUMBERS: dict[str, dict[str, Any]] = {
    "dt": {"unit": "s", "above": 0.0},
    "hit_speed": {"unit": "m/s", "above": 0.0},
    "gravity": {"unit": "m/s2", "width": 3},
}
Integrator = Literal["euler", "semi_implicit", "verlet"]
Collision = Literal["auto", "fcl"]
Response = Literal["full", "reflect"]


def meant(default: Any, doc: str) -> Any:
    """Declare a setting: what it is where nobody states it, and its meaning, for schema and docs."""
    return field(default=default, metadata={"doc": doc})


@dataclass(frozen=True)
class Settings(Resource):
    """How a simulation steps; the values here are the defaults of files and Python alike."""

    dt: float = meant(1.0 / 60.0, "one step")
    substeps: int = meant(4, "parts of a step in which forces act and contacts are solved; the more, the stiffer these")
    gravity: tuple[float, float, float] = meant((0.0, -9.81, 0.0), "acceleration of free fall")
    integrator: Integrator = meant("verlet", "rule by which bodies that touch nothing move")
    dimensions: int = meant(3, "2: every body keeps to its plane z = const and turns about z only")
    collision: Collision = meant("auto", "fcl: no kernel stands in for FCL, but on meshes")
    response: Response = meant("full", "reflect: impacts only, no resting contacts")
    hit_speed: float = meant(0.2, "closing speed from which an impact is a hit")
    sleeping: bool = meant(True, "bodies that have come to rest are left alone until something touches or changes them")
    seed: int = meant(0, "of the world's one generator of random numbers")
    threads: int = meant(1, "that share the work of a step; the bits do not depend on it")

    def __post_init__(self) -> None:
        """Refuse what cannot be stepped; raise DeclarationError naming every fault."""
        wrong = {name: number_fault(declared, getattr(self, name)) for name, declared in NUMBERS.items()}
        faults = [f"{name} {what}" for name, what in wrong.items() if what]
        for name, most in (("substeps", MOST_SUBSTEPS), ("threads", MOST_THREADS)):
            count = getattr(self, name)
            if not isinstance(count, (int, np.integer)) or not 1 <= count <= most:
                faults.append(f"{name} must be from 1 to {most}, received {count!r}")
        if self.dimensions not in (2, 3):
            faults.append(f"dimensions must be 2 or 3, received {self.dimensions}")
        elif self.dimensions == 2 and not wrong["gravity"] and self.gravity[2]:
            faults.append(f"gravity must lie in the plane z = const with dimensions 2, received {list(self.gravity)}")
        for name, choices in (("integrator", Integrator), ("collision", Collision), ("response", Response)):
            if getattr(self, name) not in get_args(choices):
                faults.append(f"{name} must be one of {', '.join(get_args(choices))}, received {getattr(self, name)!r}")
        if faults:
            raise DeclarationError("; ".join(faults))
        floats = {"dt": float(self.dt), "hit_speed": float(self.hit_speed), "gravity": tuple(map(float, self.gravity))}
        for name, value in floats.items():  # a kernel that is first called with whole numbers would cut all others off
            object.__setattr__(self, name, value)


def settings_of(words: Mapping[str, Any]) -> Settings:
    """Return the settings that words state; raise DeclarationError for words that are none."""
    if wrong := list(unknown_keys((), words, [field.name for field in fields(Settings)])):
        raise refusal(wrong)
    return Settings(**words)


def time_of(world: World) -> float:
    """Return the simulated seconds of a world."""
    return world.frame * world[Settings].dt


PCG_MULTIPLIER, PCG_PERIOD = 0x2360ED051FC65DA44385DF649FCCF645, 1 << 128  # of PCG64 (O'Neill, 2014)


class Random(Resource):
    """The one seeded generator of a world."""

    def __init__(self, seed: int) -> None:
        self.generator = np.random.Generator(np.random.PCG64(seed))

    def drawn(self, seed: int) -> int | None:
        """Return how many numbers were drawn since the generator began with ``seed``; None where none of it has.

        By bits from the lowest, since those of a linear congruential generator repeat with the period of their place
        (Brown, Random number generation with arbitrary strides, 1994).
        """
        begin, now = np.random.PCG64(seed).state, self.generator.bit_generator.state
        state, plus, end = begin["state"]["state"], begin["state"]["inc"], now["state"]["state"]
        if now["state"]["inc"] != plus or now["has_uint32"]:
            return None
        times, bit, count = PCG_MULTIPLIER, 1, 0
        while state != end:
            if (state ^ end) & bit:
                state = (state * times + plus) % PCG_PERIOD
                count |= bit
            times, plus, bit = times * times % PCG_PERIOD, (times + 1) * plus % PCG_PERIOD, 2 * bit
        return count

    def draw(self, count: int) -> None:
        """Go on by so many numbers."""
        self.generator.bit_generator.advance(count)  # type: ignore[attr-defined]

    def state(self) -> bytes:
        """Return the generator's position, and the half of a draw that a 32-bit number left over, if any."""
        whole = self.generator.bit_generator.state
        position: dict[str, int] = whole["state"]
        left = whole["uinteger"].to_bytes(4, "big") if whole["has_uint32"] else b""
        return position["state"].to_bytes(16, "big") + position["inc"].to_bytes(16, "big") + left

    def restore(self, state: bytes) -> None:
        """Set the generator to a saved position."""
        whole = dict(self.generator.bit_generator.state)
        whole["state"] = {"state": int.from_bytes(state[:16], "big"), "inc": int.from_bytes(state[16:32], "big")}
        whole["has_uint32"], whole["uinteger"] = int(len(state) > 32), int.from_bytes(state[32:], "big")
        self.generator.bit_generator.state = whole
