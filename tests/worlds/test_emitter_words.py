"""Words of emitters: everything that is wrong with them at once, in files and in Python, and what they come to be."""

from __future__ import annotations

import pytest

from carom.ecs.components.emitter import Collide, Drawn, Emitter, Source, Within
from carom.ecs.errors import DeclarationError
from carom.systems.simulation import Simulation
from carom.worlds.builder import load_text
from carom.worlds.errors import WorldError

FAULTY = """carom: 1
entities:
  - name: one
    emitter:
      rate: -1
      burst: 1.5
      source: {}
      cone: 200 deg
      life: 0
      draw: dots
      collide: everything
      colour: red
  - {name: two, emitter: {every: 1 s, speed: [3, 2]}}
  - {name: three, emitter: {}}
"""
WORDS = (
    "rate, burst, every, start, duration, source, direction, cone, speed, inherit, life, size, end_size, color, "
    "end_color, draw, mass, gravity_scale, most, collide, within"
)


def test_all_faults_of_a_file_are_told_at_once() -> None:
    """Each with line, column and what would be right."""
    with pytest.raises(WorldError) as told:
        load_text(FAULTY)
    assert str(told.value).splitlines() == [
        "world.yaml:5:7: entities.0.emitter.rate: must be at least 0 1/s; received -1",
        "world.yaml:6:7: entities.0.emitter.burst: must be a whole number; received 1.5; accepted: 0 or more",
        "world.yaml:8:7: entities.0.emitter.cone: must be at most 3.14159 rad; received '200 deg'",
        "world.yaml:9:7: entities.0.emitter.life: must be above 0 s; received 0",
        (
            "world.yaml:10:7: entities.0.emitter.draw: unknown word; received 'dots'; "
            "accepted: points, sprites, spheres, boxes"
        ),
        "world.yaml:11:7: entities.0.emitter.collide: unknown word; received 'everything'; accepted: none, planes, all",
        (
            f"world.yaml:12:7: entities.0.emitter.colour: unknown key; received 'colour'; accepted: {WORDS}; "
            "did you mean 'color'?"
        ),
        (
            "world.yaml:13:39: entities.1.emitter.speed: the least must not be above the greatest; "
            "received [3, 2] m/s; accepted: [least, greatest]"
        ),
        "world.yaml:14:19: entities.2.emitter: emits nothing; state rate or burst",
    ]


def test_python_tells_the_same() -> None:
    """As one message; nothing is added."""
    simulation = Simulation()
    with pytest.raises(DeclarationError) as told:
        simulation.add(emitter={"rate": -1, "speed": (3, 2), "color": (2, 0, 0), "source": {}, "draw": "dots"})
    assert str(told.value) == (
        "emitter.rate: must be finite and at least 0 1/s, received -1; "
        "emitter.source: must state exactly one shape, sphere, box or disc; "
        "emitter.speed: the least must not be above the greatest; received [3, 2] m/s; accepted: [least, greatest]; "
        "emitter.color: is not a colour; received (2, 0, 0); accepted: 3 or 4 numbers in 0..1; "
        "emitter.draw: unknown word; received 'dots'; accepted: points, sprites, spheres, boxes"
    )
    with pytest.raises(DeclarationError) as told:
        simulation.add(emitter={"every": 1.0, "most": 1.5})
    assert str(told.value) == (
        "emitter.most: must be a whole number, received 1.5; emitter: emits nothing; state rate or burst; "
        "emitter.every: repeats no burst; state burst"
    )
    assert simulation.world.count(Emitter) == 0


def test_files_and_python_state_the_same_emitter() -> None:
    """Every word comes to be a column, in SI."""
    text = """carom: 1
entities:
  - name: jet
    emitter:
      {rate: 10, burst: 5, every: 2 s, start: 1 s, duration: 1 min, source: {disc: {radius: 2 cm}}, cone: 45 deg,
       direction: [1, 0, 0], speed: [1, 2], inherit: 0.5, life: 3, size: 2 cm, end_size: 4 cm, color: red, mass: 2 g,
       gravity_scale: 0.5, most: 9, collide: all, draw: boxes, within: {sphere: {radius: 5 m, position: [0, 1, 0]}}}
"""
    found = load_text(text).simulation["jet"].emitter
    assert (found.rate, found.burst, found.every, found.start, found.duration) == (10.0, 5, 2.0, 1.0, 60.0)
    assert (found.source, found.extent[0], found.cone) == (Source.DISC, 0.02, pytest.approx(0.7853981633974483))
    assert (*found.direction, *found.speed, *found.life) == (1.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0)
    assert (found.inherit, found.size, found.end_size, found.mass) == (0.5, 0.02, 0.04, 0.002)
    assert (*found.color, *found.end_color) == (1.0, 0.0, 0.0, 1.0) * 2
    assert (found.gravity_scale, found.most, found.collide, found.drawn) == (0.5, 9, Collide.ALL, Drawn.BOXES)
    assert (found.within, found.within_extent[0], *found.within_position) == (Within.SPHERE, 5.0, 0.0, 1.0, 0.0)


def test_expectations_say_what_particles_have() -> None:
    """An unknown measure, an axis of a number, and particles of who is no emitter are refused with what is there."""
    text = """carom: 1
entities:
  - {name: jet, emitter: {rate: 10}}
  - {name: ball, collider: {sphere: {radius: 1}}}
expect:
  - {at: 1 s, jet.particles.counts: {is: 1, within: 1}}
  - {at: 1 s, jet.particles.upper.w: {is: 1, within: 1}}
  - {at: 1 s, jet.particles.count.x: {is: 1, within: 1}}
  - {at: 1 s, ball.particles.count: {is: 1, within: 1}}
"""
    with pytest.raises(WorldError) as told:
        load_text(text)
    assert [line.partition(": expect.")[2] for line in str(told.value).splitlines()] == [
        (
            "0.jet.particles.counts: particles have no counts; received 'jet.particles.counts'; "
            "accepted: count, center, lower, upper, velocity, speed; did you mean 'count'?"
        ),
        "1.jet.particles.upper.w: upper has no w; received 'jet.particles.upper.w'; accepted: x, y, z",
        "2.jet.particles.count.x: count has no x; received 'jet.particles.count.x'",
        (
            "3.ball.particles.count: ball has no such column; received 'particles.count'; accepted: position, "
            "rotation, friction, restitution, density, rolling_friction, spinning_friction, friction_combine, "
            "restitution_combine, number, color"
        ),
    ]
