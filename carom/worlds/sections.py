"""Sections of a world file that no registry supplies: chains, places, keyframes, runs, pictures, recordings."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, WrapValidator, model_validator

from carom.systems.events import MOST_TIMES
from carom.systems.forces.reach import END
from carom.systems.paths import REPEATS
from carom.worlds.errors import WordError, shown
from carom.worlds.rotation import RotationWord
from carom.worlds.run import MOST_FRAMES
from carom.worlds.units import read_quantity
from carom.worlds.values import Count, Flag, In, Lengths, Whole, Words, word_of

DETAILS = ("light", "full", "solver")  # how much a recording holds, each with all of those before it
WORLD, NOBODY = "world", "nobody"  # what may hold the end of a chain beside entities
LayersMet = Annotated[list[str] | Literal["all"], WrapValidator(lambda value, handler: _layers_met(value))]
Time = Annotated[float, In("s", least=0.0)]
Every = Annotated[float, In("s", above=0.0)]
Times = Annotated[int, Whole(1, MOST_TIMES)]
TimeWindow = Annotated[tuple[Time, Time | Literal["end"]], WrapValidator(lambda value, handler: _time_window(value))]


def _time_window(value: Any) -> tuple[float, float | str]:
    if not isinstance(value, list) or len(value) != 2:
        raise WordError("is no time window", received=shown(value), accepted="[0.5 s, 2 s], or [0.5 s, end] for good")
    start = read_quantity(value[0], "s", least=0.0)
    end = value[1] if value[1] == END else read_quantity(value[1], "s")
    if isinstance(end, float) and end <= start:
        raise WordError("must end after it starts", received=shown(value))
    return start, end


def _layers_met(value: Any) -> list[str] | None:
    if value == "all":
        return None
    if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
        raise WordError("is not a set of layers", received=shown(value), accepted="a list of names, or all")
    return value


class ChainWords(Words):
    """Copies of an entity as the links of a chain that starts where it is, called like ``rope[3]``."""

    end: Lengths = Field(description="where it ends, world frame (m)")
    count: Count = Field(description="how many links")
    sag: Annotated[float, In("m", least=0.0)] = Field(0.0, description="how much lower its middle is (m)")
    radius: Annotated[float, In("m", above=0.0)] | None = Field(None, description="of links that are capsules (m)")
    a: str = Field(WORLD, description="who holds the first link: world, nobody or the name of an entity")
    b: str = Field(NOBODY, description="whom the last link holds, likewise")


class Placement(Words):
    """Where a group is."""

    position: Lengths = Field((0.0, 0.0, 0.0), description="position of its origin in the world (m)")
    rotation: RotationWord = Field((0.0, 0.0, 0.0, 1.0), description="unit quaternion xyzw, group to world")


class KeyframeWords(Words):
    """A pose at a time; what it leaves out is as in the keyframe before, or at first in transform."""

    at: Time = Field(description="simulated time (s)")
    position: Lengths | None = Field(None, description="position of the origin in the world (m)")
    rotation: RotationWord | None = Field(None, description="unit quaternion xyzw, body to world")


class KeyframesWords(Words):
    """Keyframes, and what follows the last."""

    frames: list[KeyframeWords] = Field(description="two or more, in order of their times")
    repeat: word_of(*REPEATS) = Field(REPEATS[0], description="once, loop, or ping_pong: there and back")  # type: ignore[valid-type]


class OnEnter(Words):
    """What a sensor does to who enters."""

    layer: str = Field(description="layer given to who enters")


class Run(Words):
    """How long a run takes: a duration, a number of frames, or until everything rests."""

    duration: Annotated[float, In("s", above=0.0)] | None = Field(None, description="simulated time (s)")
    frames: Annotated[int, Whole(1, MOST_FRAMES)] | None = Field(None, description="steps")
    until: word_of("rest") = Field(None, description="until no body is faster than rest_speed")  # type: ignore[valid-type]
    rest_speed: Annotated[float, In("m/s", above=0.0)] = Field(0.001, description="speed that counts as rest (m/s)")
    at_most: Annotated[float, In("s", above=0.0)] = Field(60.0, description="longest time until rest (s)")

    @model_validator(mode="after")
    def check(self) -> Run:
        """Refuse a run with no end and one with two."""
        ends = [key for key in ("duration", "frames", "until") if getattr(self, key) is not None]
        if len(ends) != 1:
            received = " and ".join(ends) or "none"
            raise WordError("must state one end", received=received, accepted="duration, frames or until")
        return self


class Render(Words):
    """Pictures and films of the world."""

    width: Count = Field(640, description="pixels")
    height: Count = Field(480, description="pixels")
    fps: Annotated[float, In("Hz", above=0.0)] = Field(30.0, description="pictures per second of film")
    camera: str | None = Field(None, description="name of a camera, the first by default")
    overlays: list[str] = Field([], description="what is drawn over the bodies, such as contacts, velocities, stamp")
    color: str = Field("material", description="what the colour of bodies tells, such as speed")
    plots: list[str] = Field([], description="quantities over time in a corner, such as energy or speed(ball)")
    wireframe: Flag = Field(False, description="bodies as their edges only")


class RecordingWords(Words):
    """Recordings of the world."""

    detail: word_of(*DETAILS) = Field(  # type: ignore[valid-type]
        DETAILS[0], description="how much they hold: light, full with velocities, forces and more, or solver"
    )


class OracleWords(Words):
    """Where an entity should be at every time: by formulas, or on a conic about another body."""

    position: list[Any] | None = Field(
        None, description="x, y and z (m), each a number or an expression of t and variables, such as 'v * t'"
    )
    kepler: str | None = Field(None, description="name of the one other body, which pulls by mutual_gravitation")

    @model_validator(mode="after")
    def check(self) -> OracleWords:
        """Refuse several forms and none."""
        forms = [key for key in ("position", "kepler") if getattr(self, key) is not None]
        if len(forms) != 1:
            raise WordError(
                "must state one closed form", received=" and ".join(forms) or "none", accepted="position or kepler"
            )
        return self
