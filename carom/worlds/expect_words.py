"""The words of what a world expects."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import ConfigDict, Field, model_validator

from carom.worlds.errors import WordError
from carom.worlds.sections import Time
from carom.worlds.values import Count, In, Words, either

Span = Annotated[tuple[float, float], In("m")]


class Measure(Words):
    """What a value must be, and how near."""

    value: Any = Field(alias="is", description="the number or list of numbers it must be")
    within: Any = Field(description="largest difference, in the unit of the value or as a share like '1 %'")


class When(Words):
    """The moment of an event."""

    impact: tuple[str, str] | None = Field(None, description="two colliders that strike each other")
    enter: tuple[str, str] | None = Field(None, description="a sensor and who enters it")
    exit: tuple[str, str] | None = Field(None, description="a sensor and who leaves it")
    joint_break: str | None = Field(None, alias="break", description="a joint that breaks")
    nth: Count = Field(1, description="which of these events, from 1")

    @model_validator(mode="after")
    def check(self) -> When:
        """Refuse several events and none."""
        named = {"impact": self.impact, "enter": self.enter, "exit": self.exit, "break": self.joint_break}
        events = [key for key, stated in named.items() if stated is not None]
        if len(events) != 1:
            received = " and ".join(events) or "none"
            raise WordError("must state one event", received=received, accepted=", ".join(named))
        return self


class SettledWords(Words):
    """By when bodies rest, and which."""

    time: Time = Field(description="from when on until the end (s)")
    speed: Annotated[float, In("m/s", above=0.0)] = Field(0.001, description="speed that counts as rest (m/s)")
    entities: list[str] | None = Field(None, description="names or patterns; every body by default")


class BoundsWords(Words):
    """Between which places the shapes of bodies are."""

    x: Span | None = Field(None, description="lowest and highest x (m)")
    y: Span | None = Field(None, description="lowest and highest y (m)")
    z: Span | None = Field(None, description="lowest and highest z (m)")
    entities: list[str] | None = Field(None, description="names or patterns; every body by default")


class Expect(Words):
    """Something that must hold: a law, what a camera shows, or values like ``ball.position`` at a time or event."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Measure]
    energy: str | None = Field(None, description="'non-increasing' or 'constant within X'")
    momentum: str | None = Field(None, description="'constant within X'")
    angular_momentum: str | None = Field(None, description="'constant within X'")
    penetration: str | None = Field(None, description="'< 1 mm'")
    bounds: BoundsWords | None = Field(None, description="between which places bodies are, with all of their shapes")
    never: str | None = Field(None, description="condition, such as 'ball.position.y < 0'")
    always: str | None = Field(None, description="condition, such as 'speed(ball) < 3 m/s'")
    eventually: str | None = Field(None, description="condition that holds at some time, for each entity it speaks of")
    settles_by: either(Time, SettledWords) = Field(None, description="from when on no body moves, such as 3 s")  # type: ignore[valid-type]
    order: list[When] | None = Field(None, description="events that come one after another")
    visible: str | None = Field(
        None, description="what a camera shows then, at the end by default, such as 'crate >= 400 px from main'"
    )
    at: Time | None = Field(None, description="time of the values (s)")
    when: When | None = Field(None, description="event of the values")
