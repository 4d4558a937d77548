"""Ten bugs are planted into systems of one world: one command names system, entity and frame of each.

Kernels are sound; what they were handed, or have written, is spoiled from a frame on, as the bug would.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from plants import plant, spoil_system

from carom.ecs import Motion, Transform, World
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection import contacts
from carom.systems.simulation import Simulation
from carom.tools.cli import main

WORLD = """
carom: 1
name: NAME
run: {duration: 1.1 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: crate
    collider: {box: {size: [1, 1, 1]}}
    body: {}
    transform: {position: [0, 0.5, 0]}
    motion: {linear: [4, 0, 1]}
  - {name: sleeper, collider: {box: {size: [1, 1, 1]}}, body: {}, transform: {position: [20, 0.5, 0]}}
  - name: ball
    collider: {sphere: {radius: 0.5}}
    body: {}
    material: {restitution: 0.5}
    transform: {position: [17, 0.5, 0]}
    motion: {linear: [2.5, 0, 0]}
  - name: spinner
    collider: {box: {size: [1, 2, 3]}}
    body: {}
    transform: {position: [0, 30, 20]}
    motion: {angular: [1, 2, 3]}
  - name: lift
    collider: {box: {size: [1, 1, 1]}}
    body: {type: kinematic}
    keyframes: [{at: 0 s, position: [0, 5, -9]}, {at: 2 s, position: [0, 9, -9]}]
"""
FIRST = 31  # the frame in which most of them begin


def row(world: World, name: str) -> int:
    """Return the row of an entity."""
    return int(world.row(world.find(name)))


def of_contact(world: World, name: str) -> int:
    """Return the first contact of the floor and somebody."""
    contact = world[Contact]
    return int(np.nonzero(contact.row_b[: contact.count] == row(world, name))[0][0])


def friction_of_the_wrong_sign(simulation: Simulation) -> None:
    """Let friction push the crate on by as much as it should brake it."""
    kept = np.zeros(3)

    def before(world: World, dt: float) -> None:
        kept[:] = world[Motion].linear[row(world, "crate")]

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            linear = world[Motion].linear[row(world, "crate")]
            linear[[0, 2]] = 2.0 * kept[[0, 2]] - linear[[0, 2]]

    spoil_system(simulation, "hold", before=before, after=after)


def stale_warm_start(simulation: Simulation) -> None:
    """Let the contact of the crate begin every step with the impulse of one long past."""

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            world[Contact].warm_normal[of_contact(world, "crate")] = 30.0

    spoil_system(simulation, "hand_impulses_over", after=after)


def force_applied_twice(simulation: Simulation) -> None:
    """Let gravity pull everybody twice."""
    gravity = next(system for _, system in simulation.schedule if system.name == "apply_gravity")

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            gravity(world, dt)

    spoil_system(simulation, "apply_gravity", after=after)


def mass_of_another_row(simulation: Simulation) -> None:
    """Let the forces on the spinner, six cubic metres, be divided by the mass of the crate, of one."""

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            world[Flight].felt[row(world, "spinner")] *= 6.0

    spoil_system(simulation, "sum_forces", after=after)


def zero_normal(simulation: Simulation) -> None:
    """Let a normal of no length be made unit."""

    def after(world: World, dt: float) -> None:
        if world.frame == FIRST:
            normal = world[Contact].normal[of_contact(world, "crate")]
            normal *= 0.0
            normal /= np.sqrt((normal * normal).sum())

    spoil_system(simulation, "find_contacts", after=after)


def unsorted_pairs(simulation: Simulation) -> None:
    """Let two rows of the contact table stand in each other's place."""

    def after(world: World, dt: float) -> None:
        if world.frame == FIRST:
            contact = world[Contact]
            for name in Contact.columns:
                column = getattr(contact, name)
                column[[0, 1]] = column[[1, 0]]

    spoil_system(simulation, "find_contacts", after=after)


def missed_wake(simulation: Simulation) -> None:
    """Let detection not wake who is run into."""
    rouse = contacts.rouse

    def before(world: World, dt: float) -> None:
        contacts.rouse = lambda world, found: False

    def after(world: World, dt: float) -> None:
        contacts.rouse = rouse

    spoil_system(simulation, "find_contacts", before=before, after=after)


def energy_from_a_correction(simulation: Simulation) -> None:
    """Let what pushes overlap out stay in the velocity of the crate."""

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            world[Motion].linear[row(world, "crate"), 1] += 0.2

    spoil_system(simulation, "relax", after=after)


def swapped_quaternion(simulation: Simulation) -> None:
    """Let the rotation of the spinner be written as wxyz."""

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            rotation = world[Transform].rotation[row(world, "spinner")]
            rotation[:] = rotation[[3, 0, 1, 2]]

    spoil_system(simulation, "settle", after=after)


def drifting_clock(simulation: Simulation) -> None:
    """Let the lift go by a clock that is fast by a millionth."""

    def after(world: World, dt: float) -> None:
        if world.frame >= FIRST:
            world[Motion].linear[row(world, "lift")] *= 1.0 + 1e-6

    spoil_system(simulation, "follow_keyframes", after=after)


PLANTED: dict[str, tuple[Callable[[Simulation], None], str, int, str]] = {  # system, its run, what it wrote first
    "a wrong sign in a friction row": (friction_of_the_wrong_sign, "hold", 1, "Motion.linear[0] of entity 'crate'"),
    "a stale warm start": (stale_warm_start, "hand_impulses_over", 1, "Contact.warm_normal in row 0 (floor, crate)"),
    "a force applied twice": (force_applied_twice, "apply_gravity", 1, "Force.force[1] of entity 'crate'"),
    "a mass read from another row": (mass_of_another_row, "sum_forces", 1, "Flight.felt[1] of entity 'spinner'"),
    "an unsorted pair list": (unsorted_pairs, "find_contacts", 1, "Contact.feature in row 0 (floor, crate)"),
    "an energy-adding correction": (energy_from_a_correction, "relax", 1, "Motion.linear[1] of entity 'crate'"),
    "a swapped quaternion": (swapped_quaternion, "settle", 1, "Transform.rotation[0] of entity 'spinner'"),
    "a clock drift": (drifting_clock, "follow_keyframes", 1, "Motion.linear[1] of entity 'lift'"),
}


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of ``sound.yaml`` and ``planted.yaml``, in which this test runs."""
    monkeypatch.chdir(tmp_path)
    for name in ("sound", "planted"):
        Path(f"{name}.yaml").write_text(WORLD.replace("NAME", name))
    return tmp_path


@pytest.mark.parametrize("bug", PLANTED)
def test_bisect_names_system_entity_and_frame(
    bug: str, files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In its first line, and what that system wrote in its second."""
    spoil, system, run, what = PLANTED[bug]
    plant(monkeypatch, spoil)
    assert main(["bisect", "sound.yaml", "planted.yaml"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told[0].startswith(f"frame {FIRST}: system '{system}', run {run} in phase '")
    assert told[0].endswith("', is the first after which sound.yaml and planted.yaml differ")
    assert told[1].startswith(f"  wrote    {what} is ")
    assert told[2] == "  is in    both"


def test_bisect_names_a_missed_wake(
    files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In the frame in which the ball comes to reach the sleeper, who is awake in one run alone."""
    plant(monkeypatch, missed_wake)
    assert main(["bisect", "sound.yaml", "planted.yaml"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told[0].partition(": ")[2].startswith("system 'find_contacts', run 1 in phase 'detect', is the first")
    assert "'sleeper' is" in told[1]
    frame = int(told[0].split(":")[0].removeprefix("frame "))
    assert 60 <= frame <= 66  # 2 m, at 2.5 m/s and then rolling at 5/7 of that, less what a step may reach


def test_break_names_a_nan_from_a_zero_normal(
    files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the contact; nobody else would have noticed, since nothing compares with a NaN."""
    plant(monkeypatch, zero_normal)
    assert main(["run", "planted.yaml", "--break", "not finite"]) == 1
    pair = "Contact.normal of entity 'floor and crate' is [nan, nan, nan]"
    command = "carom run planted.yaml --break 'not finite' --pdb"
    told = f"frame {FIRST}: {pair}, written by system 'find_contacts'\nopen it with: {command}\n"
    assert capsys.readouterr().err == told


def test_break_names_who_was_given_energy(
    files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a sound run to compare with: the crate is told with its line of the file."""
    plant(monkeypatch, energy_from_a_correction)
    assert main(["run", "planted.yaml", "--break", "crate.motion.linear.y > 0.1 m/s"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told[0].startswith(f"frame {FIRST} at 0.516667 s: crate.motion.linear.y > 0.1 m/s: crate.")
    assert told[1].startswith("  planted.yaml:7:5: 'crate' at [")
