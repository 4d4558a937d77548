"""Why a body is awake, and why two that sleep have no contact, in whole sentences."""

from __future__ import annotations

from sleepers import BALL, BOX, sleeping, stacks

from carom.systems.detection.why import why_no_contact
from carom.systems.simulation import Simulation
from carom.systems.why_awake import why_awake


def test_why_a_body_is_awake() -> None:
    """One reason at a time, with who it is, numbers and limits."""
    simulation = stacks(0.0)
    simulation.add(
        name="late",
        collider=BALL,
        body={"mass": 1.0},
        transform={"position": (0, 3.5, 0)},
        motion={"linear": (1, 0, 0)},
    )
    simulation.step()
    told = why_awake(simulation, "a0")
    assert told.startswith("'a0' is awake since 'late', in its island of 4 bodies, moves at ")
    assert told.endswith(" m/s; at 0.03 m/s or less it may fall asleep")
    assert why_awake(simulation.world, "floor") == "'floor' has no body; it stands"
    simulation = stacks(0.0)
    simulation.step(20)
    assert why_awake(simulation, "a2").startswith("'a2' is awake since 'a")
    assert why_awake(simulation, "a2").endswith(" s; after 0.5 s it falls asleep")
    simulation.step(60)
    assert why_awake(simulation, "a2") == "'a2' sleeps"
    assert why_awake(stacks(0.0, sleeping=False), "a0") == (
        "'a0' is awake since nobody falls asleep in this world: sleeping is off"
    )
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(name="drifter", collider=BOX, body={}, motion={"linear": (1e-3, 0.0, 0.0)})
    simulation.add(name="restless", collider=BOX, body={"sleeps": False}, transform={"position": (5.0, 0.0, 0.0)})
    simulation.add(name="lift", collider=BOX, body={"type": "kinematic"}, transform={"position": (9.0, 0.0, 0.0)})
    simulation.step(60)
    assert why_awake(simulation, "drifter") == (
        "'drifter' is awake since nothing that stands touches or holds it: what drifts slowly goes on"
    )
    assert why_awake(simulation, "restless") == (
        "'restless' is awake since it may not fall asleep: its body says so (sleeps)"
    )
    assert why_awake(simulation, "lift") == "'lift' is kinematic; it neither rests nor sleeps"
    simulation.force("mutual_gravitation")
    simulation.step()
    assert why_awake(simulation, "drifter") == (
        "'drifter' is awake since it is pushed another way in every step, by mutual_gravitation"
    )


def test_why_two_that_sleep_have_no_contact() -> None:
    """`why_no_contact` says that they sleep, and what there would be."""
    simulation = sleeping(0.0)
    told = why_no_contact(simulation, "a0", "a1")
    assert told.startswith(
        "'a0' and 'a1' sleep, so that nobody looks for contacts of the two; they are in contact: 4 poin"
    )
    told = why_no_contact(simulation, "floor", "a0")
    assert told.startswith("'a0' sleeps, so that nobody looks for contacts of the two; they are in contact: 4 points")
    simulation.wake("a0")
    simulation.step()
    assert why_no_contact(simulation, "floor", "a0").startswith("they are in contact: 4 points")
