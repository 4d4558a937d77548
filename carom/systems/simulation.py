"""Simulation: a world, the step and the clock."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy.typing as npt

from carom.ecs import (
    Entity,
    NonFiniteError,
    Schedule,
    Snapshot,
    System,
    World,
    restore_snapshot,
    take_snapshot,
)
from carom.ecs.column import Integers
from carom.ecs.components.motion import Motion
from carom.ecs.components.transform import Transform
from carom.ecs.errors import DeclarationError
from carom.systems.assembly import add_entities, add_entity
from carom.systems.awake import Awake, ask_to_wake
from carom.systems.bookkeeping import Bookkeeping
from carom.systems.breakpoints import Breakpoint, StoppedError, look
from carom.systems.clock import Clock
from carom.systems.compound import bodies_of
from carom.systems.declared import read_words
from carom.systems.entity_words import refuse_words
from carom.systems.events import Events, read_event, repetitions
from carom.systems.explosion import Explosion, blast
from carom.systems.force_function import ForceFunction, force_system
from carom.systems.forces.law import Forces, Law, read_law
from carom.systems.forces.reach import read_reach
from carom.systems.forces.region import Region
from carom.systems.forces.standing import Standing
from carom.systems.interpolation import EarlierPoses
from carom.systems.layers import Layers
from carom.systems.ledger import Ledger
from carom.systems.materials import Materials
from carom.systems.observer import Observer
from carom.systems.parameters import WordFault, refusal
from carom.systems.particles.fields import Fields
from carom.systems.places import extended
from carom.systems.pushes import Pushes, push
from carom.systems.queries.space import Space
from carom.systems.rehearsal import Rehearsal
from carom.systems.resources import resources
from carom.systems.settings import Settings, settings_of
from carom.systems.step import STEP, has_strangers
from carom.systems.threads import Threads
from carom.systems.tracing import find_source, refuse_stated

CHECK_VARIABLE = "CAROM_CHECK"


class Simulation:
    """A world that steps: ``Simulation(dt=1/240)``; every option of `Settings` is a keyword.

    ``checked`` enforces what systems declare to touch (default: the environment variable CAROM_CHECK). Set ``watched``
    to have a NaN traced to the system that made it, at the price of a snapshot before every step. ``observers`` see the
    world after each step, ``hearers`` are told of each system that has run; ``breakpoints`` stop it before a step that
    meets one is committed, ``stopped`` is the last such stop.
    """

    def __init__(self, *, checked: bool | None = None, **settings: Any) -> None:
        self.world = World()
        self.schedule: Schedule = extended(STEP)
        self.checked = bool(os.environ.get(CHECK_VARIABLE)) if checked is None else checked
        self.watched = False
        self.observers: list[Observer] = []
        self.breakpoints: list[Breakpoint] = []
        self.stopped: StoppedError | None = None
        self.clock = Clock()
        self.space = Space(self.world)
        self._earlier = EarlierPoses()
        self.hearers: list[Callable[[System], None]] = []
        for resource in resources(settings_of(settings)):
            self.world.add(resource)

    @property
    def settings(self) -> Settings:
        """Return the settings that the world steps by; set others to let it go on by them."""
        return self.world[Settings]

    @settings.setter
    def settings(self, settings: Settings) -> None:
        self.world.add(settings)

    # Building: the words are those of world files, numbers are SI.
    def add(self, **words: Any) -> Entity:
        """Add one entity: ``add(name="ball", collider={"sphere": {"radius": 0.1}}, body={})``; see `add_entity`."""
        return add_entity(self.world, **words)

    def add_many(self, positions: npt.ArrayLike, *, names: list[str] | None = None, **words: Any) -> Integers:
        """Add an entity at each of ``positions`` (n, 3), m, all alike otherwise, far faster than one by one."""
        return add_entities(self.world, positions, names=names, **words)

    def material(self, name: str, **words: Any) -> None:
        """Name a material for later `add` calls; raise DeclarationError for what is wrong with its words."""
        refuse_words({"material": words})
        self.world[Materials].named[name] = words

    def layers(self, accepts: dict[str, Iterable[str] | None]) -> None:
        """Define layers, each with the layers it collides with (None: all)."""
        self.world[Layers].define(accepts)

    def force(
        self,
        law: str | Law,
        entities: Iterable[int] | None = None,
        *,
        region: Region | Mapping[str, Any] | None = None,
        layers: Sequence[str] | None = None,
        during: tuple[float, float | str] | None = None,
        **words: Any,
    ) -> None:
        """Let a force law act, on these entities or on every body: ``force("wind", velocity=(5, 0, 0))``.

        ``region={"sphere": {"radius": 2}}`` is where it acts, ``layers=["leaves"]`` on whose colliders, and when
        ``during=(0.5, 2)`` or ``(0.5, "end")``, in s. Raises DeclarationError for all that is wrong.
        """
        faults: list[WordFault] = []
        reach = read_reach(self.world[Layers], faults, entities, region, layers, during)
        made = law if isinstance(law, Law) else read_law(law, words, faults)
        if made is None or faults:
            raise refusal(faults)
        self.world[Forces].add(made, reach)

    def force_function(self, function: ForceFunction, name: str | None = None) -> System:
        """Let a Python function ``(world, rows) -> forces (n, 3) in N`` act on every body in every substep.

        On particles it acts once in a step, with a world in which they stand as bodies; see `Fields`.
        """
        made = force_system(function, name)
        self.schedule = self.schedule.insert(made, after="apply_quadratic_drag")
        self.world[Fields].functions.append(made)
        return made

    def event(self, at: float, *, every: float | None = None, times: int | None = None, **action: Any) -> None:
        """Let something happen at a time (s): ``event(1.5, release=["pin"])``, in the words of world files.

        ``impulse``, ``explode``, ``release``, ``despawn`` or ``spawn``, done at the start of the step that contains the
        time, so many ``times``, ``every`` so many seconds. Raises DeclarationError.
        """
        faults: list[WordFault] = []
        event = read_event(self.world, at, action, faults)
        events = [] if event is None else repetitions(event, every, times, faults)
        if faults:
            raise refusal(faults)
        self.world[Events].entries += events

    def explode(self, **words: Any) -> Pushes:
        """Let momentum go out from a point now: ``explode(position=(0, 1, 0), impulse=50)``; return what bodies take.

        ``blocked`` is whether walls and all that no force moves keep it off; see `Explosion`. Raises DeclarationError.
        """
        faults: list[WordFault] = []
        explosion = read_words(Explosion, words, (), faults)
        if explosion is None:
            raise refusal(faults)
        pushes = blast(self.world, explosion)
        with self.world.edit(Motion), self.world.faces(None):
            push(self.world, pushes)
        self.world[Events].given.append(pushes)
        return pushes

    def wake(self, *entities: int | str) -> None:
        """Wake bodies (handles or names) that sleep, with their islands, before the next step.

        Raises EntityError for who does not live or has no such name.
        """
        handles = [self.world.find(one) if isinstance(one, str) else one for one in entities]
        bodies = bodies_of(self.world)[[self.world.row(handle) for handle in handles]]
        with self.world.edit(Motion) as motion:
            ask_to_wake(motion, bodies[bodies >= 0])

    def keep_ledger(self) -> Ledger:
        """Book from now on, in every step, where energy comes from and goes to; return the ledger."""
        ledger: Ledger = self.world[Ledger]
        if not ledger.kept:
            self.hearers.insert(0, Bookkeeping(self).note)
        return ledger

    # Running.
    @property
    def frame(self) -> int:
        """Steps taken."""
        return self.world.frame

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self.world.frame * self.settings.dt

    def step(self, count: int = 1, *, after: Callable[[System], None] | None = None) -> None:
        """Take ``count`` steps of dt; ``after`` is told of every system run.

        Raises DeclarationError for fewer than none, NonFiniteError for a NaN, and `StoppedError` where a breakpoint is
        met, which observers have seen then. The world is what it was before that step, or as far as that came where
        nobody watches.
        """
        if count < 0:
            raise DeclarationError(f"step takes 0 steps or more, received {count}")
        if Rehearsal.due:
            Rehearsal.hold(Simulation(checked=False))
        for _ in range(count):
            before = take_snapshot(self.world) if self.watched or self.breakpoints else None
            stopped = None
            try:
                self._take_step(after)
                stopped = look(self.breakpoints, self) if self.breakpoints else None
            except NonFiniteError:
                if before is None:
                    raise
                restore_snapshot(self.world, before)
                self._trace(before)
            self.stopped = stopped or self.stopped
            for observer in self.observers:
                observer.observe(self)
            if stopped and before:
                restore_snapshot(self.world, before)
                raise stopped

    def _trace(self, before: Snapshot) -> None:
        """Take the same step again, looking for the NaN after every system; leave the world before it once found."""
        try:
            refuse_stated(self.world)
            self._take_step(lambda system: find_source(self.world, system.name))
        except NonFiniteError:
            restore_snapshot(self.world, before)
            raise

    def _take_step(self, after: Callable[[System], None] | None) -> None:
        self.world[Awake].strangers = has_strangers(self.schedule)
        self.world.frame += 1
        hearers = [*self.hearers, *([after] if after is not None else ())]
        self.world[Standing].heard = bool(hearers)

        def tell(system: System) -> None:
            for hear in hearers:
                hear(system)

        with self.world[Threads]:
            self.schedule.run(self.world, self.settings.dt, checked=self.checked, after=tell if hearers else None)

    def advance(self, seconds: float) -> float:
        """Take the steps that ``seconds`` of real time ask for; return how far (0 to 1) time is into the next one.

        What a frame leaves over is kept for the next, to the last bit: the steps taken do not depend on how time is cut
        into frames. A frame asks for at most ``clock.catch_up`` seconds, the rest is in ``clock.dropped``.
        """
        steps = self.clock.steps(seconds, self.settings.dt)
        if steps:
            self.step(steps - 1)
            self._earlier.keep(self.world)
            self.step()
        return self.clock.part(self.settings.dt)

    def between(self, part: float) -> Transform:
        """Return poses to draw, ``part`` (what `advance` returned) of the way from the step before to the last one.

        Arrays over rows like ``world[Transform]``, copied: ``between(part).position[rows]``. Without `advance` they are
        those of the last step. What is drawn is up to one step late, and as smooth as the frames.
        """
        return self._earlier.between(self.world, part)

    def __getitem__(self, key: Any) -> Any:
        """Return ``world[key]``; a text finds an entity by name."""
        return self.world[self.world.find(key) if isinstance(key, str) else key]
