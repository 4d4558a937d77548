"""Oracles foretell where bodies are: by formulas of the file, as thrown, and on conics."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs.snapshot import state_hash
from carom.worlds import WorldError, load_text
from carom.worlds.closed_forms import kepler
from carom.worlds.oracle import Oracle
from carom.worlds.terms import read_term

FILE = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/60}
variables: {speed: 3 m/s, rate: 2 rad/s}
entities:
  - {name: ball, body: {mass: 1}, transform: {position: [0, 5, 0]}, motion: {linear: [3, 0, 0]}}
  - {name: club, body: {mass: 1, inertia: [1, 1, 1], center_of_mass: [0.5, 0, 0], gravity_scale: 0.5}, transform: {position: [0, 9, 0]}, motion: {linear: [1, 2, 0], angular: [0, 0, 4]}}
  - {name: sign, transform: {position: [1, 1, 1]}}
oracle:
  ball: {position: [speed * t, 5 m - 10 m/s2 * t**2 / 2, 0]}
  club: ballistic
  sign: {position: ["2 m * exp(-t / 1 s) * cos(rate * t)", 1 ft, "${1 m / 2}"]}
"""


def test_positions_are_what_formulas_say() -> None:
    """Of time and variables with units; thrown bodies by their centres of mass, however they turn and are drawn to the ground."""
    loaded = load_text(FILE)
    simulation, world = loaded.simulation, loaded.simulation.world
    oracle, rows = world[Oracle], world[Oracle].rows(world)
    assert oracle.positions(world, rows[2:], 0.75)[0] == pytest.approx(
        (2.0 * math.exp(-0.75) * math.cos(1.5), 0.3048, 0.5), rel=1e-13
    )
    off = read_term("error(sign)", world)
    assert off.unit == "m"
    assert off.read(world) == pytest.approx(np.array([[math.dist((1.0, 1.0, 1.0), (2.0, 0.3048, 0.5))]]), rel=1e-13)
    simulation.step(45)
    assert read_term("error(ball)", world).read(world).max() < 1e-12
    assert read_term("error(club)", world).read(world).max() < 1e-12
    assert simulation["club"].transform.position[0] != pytest.approx(0.5 + 0.75 - 0.5, abs=0.01)  # it turned


def test_errors_of_many_are_read_by_looking_each_up_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many have a form, nobody's name is asked for twice."""
    copies = FILE.replace("{name: sign, ", "{name: sign, line: {count: 300, step: [1, 0, 0]}, ")
    world, asked = load_text(copies).simulation.world, list[int]()
    monkeypatch.setattr(world, "name", lambda entity, told=world.name: asked.append(int(entity)) or told(entity))
    assert len(read_term("error(sign)", world).names) == 300
    assert len(asked) == len(set(asked)) == 302


def test_no_bit_depends_on_an_oracle() -> None:
    """With it or without, a world runs to the same state; one without has none."""
    with_it, without = load_text(FILE).simulation, load_text(FILE.partition("oracle:")[0]).simulation
    for simulation in (with_it, without):
        simulation.step(30)
    assert state_hash(with_it.world) == state_hash(without.world)
    assert Oracle not in without.world


@pytest.mark.parametrize("parameter", [-1.2, 0.0, 0.4, 2.0])
def test_hyperbolas_are_where_goldstein_has_them(parameter: float) -> None:
    """From F = -1 of k = sqrt 2 to F by t = k sinh F - F, x = k - cosh F, y = sinh F; G M = a = 1 m."""
    k = math.sqrt(2.0)

    def at(f: float) -> tuple[float, np.ndarray, np.ndarray]:
        place, way = (k - math.cosh(f), math.sinh(f), 0.0), (-math.sinh(f), math.cosh(f), 0.0)
        return k * math.sinh(f) - f, np.array(place), np.array(way) / (k * math.cosh(f) - 1.0)

    (begin, place, velocity), (end, there, _) = at(-1.0), at(parameter)
    assert kepler(1.0, place, velocity, end - begin) == pytest.approx(there, abs=1e-13)


@pytest.mark.parametrize("parameter", [-3.0, 0.5, 2.0, 3.0, 40.0])
def test_ellipses_are_where_kepler_has_them(parameter: float) -> None:
    """From the nearest point of e = 0.8 by his equation t = E - e sin E, many times round and back in time too."""
    place, velocity = np.array((0.2, 0.0, 0.0)), np.array((0.0, math.sqrt(1.8 / 0.2), 0.0))
    there = (math.cos(parameter) - 0.8, 0.6 * math.sin(parameter), 0.0)
    assert kepler(1.0, place, velocity, parameter - 0.8 * math.sin(parameter)) == pytest.approx(there, abs=1e-13)


@pytest.mark.parametrize("parameter", [-0.5, 0.3, 4.0])
def test_parabolas_are_where_barker_has_them(parameter: float) -> None:
    """From the nearest point q = 1: t = sqrt 2 (D + D^3 / 3), x = 1 - D^2, y = 2 D."""
    place, velocity = np.array((1.0, 0.0, 0.0)), np.array((0.0, math.sqrt(2.0), 0.0))
    time = math.sqrt(2.0) * (parameter + parameter**3 / 3.0)
    there = (1.0 - parameter**2, 2.0 * parameter, 0.0)
    assert kepler(1.0, place, velocity, time) == pytest.approx(there, abs=1e-12)


def test_a_formula_that_ends_leaves_its_body_nowhere() -> None:
    """A root of what falls below 0 is no error of the file: from then on nothing is foretold."""
    loaded = load_text(FILE.partition("oracle:")[0] + "oracle: {ball: {position: [1 m * sqrt(1 - t / 1 s), 0, 0]}}\n")
    world = loaded.simulation.world
    rows = world[Oracle].rows(world)
    assert world[Oracle].positions(world, rows, 0.75)[0, 0] == 0.5
    assert np.isnan(world[Oracle].positions(world, rows, 1.25)).all()


def test_all_that_cannot_be_foretold_is_told_at_once() -> None:
    """Names, numbers of components, units, forms that lack what they go round, and errors of who has no oracle."""
    text = (
        FILE.partition("oracle:")[0]
        + """oracle:
  bell: ballistic
  sign: ballistic
  club: kepler
  ball: {position: [speed, 5 m - g * t, 1 +]}
expect:
  - always: error(sign) < 1 m
"""
    )
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert str(caught.value).splitlines() == [
        "w.yaml:10:3: oracle.bell: unknown entity; received 'bell'; accepted: ball, club, sign; did you mean 'ball'?",
        "w.yaml:11:3: oracle.sign: sign is no body that obeys forces; accepted: an entity with body, or position: [...]",
        "w.yaml:12:3: oracle.club: goes round no single gravity_well; received 0 of them; accepted: one",
        "w.yaml:13:21: oracle.ball.position.0: must be a length; received 3 m/s, which is a speed; accepted: a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi",
        "w.yaml:13:28: oracle.ball.position.1: unknown variable; received 'g'; accepted: t, speed, rate",
        "w.yaml:13:41: oracle.ball.position.2: lacks a value; received '1 +'; accepted: numbers with units, variables, + - * / ** ( ), pi, sqrt, abs, min, max, round, sin, cos, tan, exp",
        "w.yaml:15:5: expect.0.always: oracle says nothing of sign; accepted: an entity of the section oracle",
    ]
    for words, fault in (
        ("{}", "w.yaml:9:10: oracle.ball: must state one closed form; received none; accepted: position or kepler"),
        (
            "{position: 3 m}",
            "w.yaml:9:17: oracle.ball.position: must be a list; received '3 m'; accepted: [...], or lines that begin with -",
        ),
        (
            "{position: [1, 2]}",
            "w.yaml:9:17: oracle.ball.position: must be a list of 3 lengths; received [1, 2]; accepted: numbers in m, or expressions of t",
        ),
        ("balistic", "w.yaml:9:10: oracle.ball: unknown word; received 'balistic'; accepted: ballistic, kepler"),
        (
            "{kepler: klub}",
            "w.yaml:9:17: oracle.ball.kepler: unknown entity; received 'klub'; accepted: ball, club, sign; did you mean 'club'?",
        ),
        (
            "{kepler: club}",
            "w.yaml:9:10: oracle.ball: goes round nobody: it needs one mutual_gravitation and another body; received 'club'",
        ),
    ):
        with pytest.raises(WorldError) as caught:
            load_text(FILE.partition("oracle:")[0] + f"oracle: {{ball: {words}}}\n", "w.yaml")
        assert str(caught.value) == fault
