"""Systems of extensions are placed in the frame beside those they name."""

from __future__ import annotations

import pytest
from faults import error

from carom.ecs import ColliderPose, Component, DeclarationError, Phase, Schedule, System, World, system
from carom.systems import places


def named(name: str, module: str, *reads: type[Component]) -> System:
    """Return a system of another module."""

    def function(world: World, dt: float) -> None:
        """Do nothing."""

    function.__name__, function.__module__ = name, module
    return system(reads=reads)(function)


@pytest.mark.parametrize("turned", [False, True])
def test_the_frame_does_not_depend_on_the_order_of_import(turned: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Modules in order of their names, systems of a module as they are written, each beside its neighbour."""
    monkeypatch.setattr(places, "PLACES", {})
    modules = {
        "ants": [("first", "after", "a"), ("second", "after", "a"), ("early", "before", "b")],
        "bees": [("third", "after", "a"), ("fourth", "after", "third"), ("late", "before", "b")],
    }
    for module, systems in sorted(modules.items(), reverse=turned):
        for name, side, neighbour in systems:
            places.placed(**{side: neighbour})(named(name, module))
    frame = places.extended(Schedule(Phase("one", named("a", "own")), Phase("two", named("b", "own"))))
    order = [(phase.name, one.name) for phase, one in frame]
    assert order[:5] == [("one", name) for name in ("a", "first", "second", "third", "fourth")]
    assert order[5:] == [("two", name) for name in ("early", "late", "b")]


def test_a_place_beside_nobody_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The message lists who is there."""
    monkeypatch.setattr(places, "PLACES", {})
    places.placed(before="kik")(named("fly", "ants"))
    with error(DeclarationError, "system 'fly' of ants is placed before 'kik'; there are kick"):
        places.extended(Schedule(Phase("one", named("kick", "own"))))


def test_a_frame_that_does_not_hold_together_names_who_is_placed_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Since what is missing may be missing to another extension."""
    monkeypatch.setattr(places, "PLACES", {})
    places.placed(before="kick")(named("look", "ants", ColliderPose))
    message = (
        "the schedule is wrong:\n  system 'look' in phase 'one' needs ColliderPose, which neither files nor an earlier "
        "system supply; place a system that writes it before\n  system 'look' of ants is placed in it"
    )
    with error(DeclarationError, message):
        places.extended(Schedule(Phase("one", named("kick", "own"))))
