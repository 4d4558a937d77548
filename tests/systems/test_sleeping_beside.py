"""Who is near enough to wake others sleeps when they do."""

from __future__ import annotations

from sleepers import BOX, asleep, stacks

from carom.systems.why_awake import why_awake


def test_islands_that_are_near_each_other_fall_asleep_together() -> None:
    """Else each would wake the other right after it fell asleep, and none would ever stay so."""
    simulation = stacks(0.0, 1.002)
    simulation.step(20)
    simulation["b1"].motion.still = 0.0
    slept = []
    for _ in range(60):
        simulation.step()
        slept.append(asleep(simulation, "a0", "a2", "b0", "b2"))
    first = slept.index([True] * 4)
    assert slept[:first] == [[False] * 4] * first
    assert slept[first:] == [[True] * 4] * (60 - first)
    assert 28 <= first <= 31  # half a second after b1 was still


def test_who_drifts_beside_others_goes_on_and_they_stay_awake() -> None:
    """That an island near it is held does not hold it."""
    simulation = stacks(0.0)
    simulation.add(
        name="drifter", collider=BOX, body={"gravity_scale": 0.0},
        transform={"position": (1.001, 1.5, -0.4)}, motion={"linear": (0.0, 0.0, 0.005)},
    )  # fmt: skip
    simulation.step(120)
    assert asleep(simulation, "a0", "a2", "drifter") == [False, False, False]
    assert simulation["drifter"].motion.linear.tolist() == [0.0, 0.0, 0.005]
    assert why_awake(simulation, "a0") == (
        "'a0' is awake since others are near enough to touch its island of 3 bodies within a step: "
        "'drifter' is awake since nothing that stands touches or holds it: what drifts slowly goes on"
    )


def test_who_is_near_what_a_lift_may_touch_stays_awake() -> None:
    """It would be woken in each step."""
    simulation = stacks(0.0)
    simulation.add(
        name="lift", collider=BOX, body={"type": "kinematic"},
        transform={"position": (1.001, 1.5, 0.0)}, motion={"linear": (0.0, 0.001, 0.0)},
    )  # fmt: skip
    for _ in range(120):
        simulation.step()
        assert asleep(simulation, "a0", "a2") == [False, False]
    assert why_awake(simulation, "a0") == (
        "'a0' is awake since 'lift', which moves, may touch it, in its island of 3 bodies"
    )
