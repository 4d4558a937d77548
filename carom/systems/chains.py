"""Chains: ropes, chains, bridges, whips and nets, of links that joints hold together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import angles, quaternion, vector
from carom.systems.joints.kind import JOINTS
from carom.systems.joints.many import join_many
from carom.systems.joints.point_joint import PointJoint
from carom.systems.simulation import Simulation

WORLD = -1
BALL: Mapping[str, Any] = {"ball": {}}
FARTHEST = 1e100  # m; squares of more are beyond all numbers
UPRIGHT = 1e-9  # sine of the angle to gravity below which a chain hangs straight down


class Course(NamedTuple):
    """Where joints are (n + 1, 3), the first and last being the ends, and how links between lie (n, 4)."""

    joints: Floats
    rotation: Floats


def add_chain(
    simulation: Simulation,
    name: str,
    start: npt.ArrayLike,
    end: npt.ArrayLike,
    count: int,
    *,
    sag: float = 0.0,
    radius: float | None = None,
    joint: Mapping[str, Any] = BALL,
    a: str | int | None = WORLD,
    b: str | int | None = None,
    **words: Any,
) -> Integers:
    """Add a chain of ``count`` links from start to end (3,), m, and return their handles (count,).

    It is straight, or hangs as an arc of a circle whose middle is ``sag`` (m) lower. Links lie with y along the chain
    and z level across it: capsules of ``radius`` (m) that fill it, or whatever ``words`` state as those of an entity.
    ``joint`` are the words of what joins neighbours, who do not touch each other unless these say so. The first link is
    held by ``a`` and the last holds ``b``: bodies, the world (-1), or nobody (None). Links are called name[0] and so
    on, joints name.joint[0], from the start to the end. Raises DeclarationError for what cannot be built.
    """
    course = hung(simulation, np.asarray(start, np.float64), np.asarray(end, np.float64), count, sag)
    if "collider" not in words:
        words["collider"] = capsule_along(course, radius)
    refuse_lines(joint)
    links = lay_links(simulation, name, course, **words)
    join_links(simulation, name, course, links, joint, a, b)
    return links


def lay_links(simulation: Simulation, name: str, course: Course, **words: Any) -> Integers:
    """Add links that nothing joins yet, and return their handles (n,)."""
    centers = 0.5 * (course.joints[1:] + course.joints[:-1])
    names = [f"{name}[{number}]" for number in range(len(centers))]
    links = simulation.add_many(centers, names=names, **{"body": {}, **words})
    with simulation.world.edit(Transform) as transform:
        transform.rotation[simulation.world.slots.rows(links)] = course.rotation
    return links


def join_links(
    simulation: Simulation,
    name: str,
    course: Course,
    links: Integers,
    joint: Mapping[str, Any],
    a: str | int | None,
    b: str | int | None,
) -> None:
    """Join links to each other, the first to ``a`` and the last to ``b``."""
    places, first = course.joints, int(a is not None)
    if a is not None:
        _attach(simulation, joint, a, int(links[0]), places[0], f"{name}.joint[0]")
    names = [f"{name}.joint[{number}]" for number in range(first, first + len(links) - 1)]
    join_many(simulation.world, joint, links[:-1], links[1:], places[1:-1], names)
    if b is not None:
        _attach(simulation, joint, int(links[-1]), b, places[-1], f"{name}.joint[{first + len(links) - 1}]")


def add_net(
    simulation: Simulation,
    name: str,
    corner: npt.ArrayLike,
    across: npt.ArrayLike,
    along: npt.ArrayLike,
    count: tuple[int, int],
    *,
    joint: Mapping[str, Any] = BALL,
    **words: Any,
) -> Integers:
    """Add a net of knots, each joined to its neighbours, and return their handles (n, m).

    The first is at ``corner`` (3,), m; ``across`` and ``along`` (3,), m, lead from one to the next. ``words`` are those
    of a knot, ``joint`` those of what joins two: balls halfway, or ropes from one to the other. Knots are called
    name[0,0] and so on, joints name.across[0,0] and name.along[0,0] after the first of the two. Raises
    DeclarationError for what cannot be built.
    """
    rows, columns = count
    if min(count) < 1:
        raise DeclarationError(f"count: a net has 1 knot or more each way; received {rows} x {columns}")
    i, j = np.indices(count).reshape(2, -1, 1)
    places = np.asarray(corner, np.float64) + i * np.asarray(across, np.float64) + j * np.asarray(along, np.float64)
    names = [f"[{row},{column}]" for row in range(rows) for column in range(columns)]
    words = {"body": {}, **words}
    knots = simulation.add_many(places, names=[name + number for number in names], **words).reshape(count)
    numbers, places = np.array(names).reshape(count), places.reshape(*count, 3)
    ways = ("across", np.s_[:-1, :], np.s_[1:, :]), ("along", np.s_[:, :-1], np.s_[:, 1:])
    for way, here, next_one in ways:
        middle = 0.5 * (places[here] + places[next_one]).reshape(-1, 3)
        called = [f"{name}.{way}{number}" for number in numbers[here].ravel()]
        join_many(simulation.world, joint, knots[here].ravel(), knots[next_one].ravel(), middle, called)
    return knots


def hung(simulation: Simulation, start: Floats, end: Floats, count: int, sag: float) -> Course:
    """Return how links of one length lie between two points, on a straight line or an arc of a circle."""
    chord = float(vector.distance(start, end))
    if count < 1:
        raise DeclarationError(f"count: a chain has 1 link or more; received {count}")
    if not chord > 0.0:
        raise DeclarationError("end: is where the chain starts; accepted: another point")
    if not max(chord, sag) <= FARTHEST:
        raise DeclarationError(f"end: a chain is at most {FARTHEST:g} m long, and hangs as low; received {chord:g} m")
    if not sag >= 0.0:
        raise DeclarationError(f"sag: is 0 or more, m; received {sag:g}")
    gravity = np.array(simulation.settings.gravity, np.float64)
    ahead, down = (end - start) / chord, vector.normalise(gravity, otherwise=(0.0, -1.0, 0.0))
    level = vector.cross(ahead, down)
    upright = float(vector.length(level)) < UPRIGHT
    if upright and sag > 0.0:
        raise DeclarationError("sag: a chain from one point straight down to the other hangs to no side; leave it out")
    across = vector.normalise(vector.cross(ahead, (1.0, 0.0, 0.0) if abs(ahead[0]) < 0.9 else (0.0, 0.0, 1.0)))
    across = across if upright else vector.normalise(level)
    lower, part = vector.cross(across, ahead), np.linspace(-1.0, 1.0, count + 1)
    if sag > 0.0:
        bend, radius = 2.0 * angles.arc_tangent(2.0 * sag, chord), (0.25 * chord * chord + sag * sag) / (2.0 * sag)
        sine, cosine = angles.sines_cosines(bend * part)
        aside, deep = radius * sine, radius * (cosine - 1.0) + sag
    else:
        aside, deep = 0.5 * chord * part, np.zeros(count + 1)
    joints = 0.5 * (start + end) + aside[:, None] * ahead + deep[:, None] * lower
    joints[0], joints[-1] = start, end
    y = vector.normalise(joints[1:] - joints[:-1])
    z = np.broadcast_to(across, y.shape)
    return Course(joints, quaternion.from_matrix(np.stack([vector.cross(y, z), y, z], axis=-1)))


def capsule_along(course: Course, radius: float | None) -> dict[str, dict[str, float]]:
    """Return the words of the collider of links that are capsules from joint to joint."""
    pitch = float(vector.distance(*course.joints[:2]))
    if radius is None:
        raise DeclarationError("radius: state that of links that are capsules, or a collider of their own")
    if not 0.0 < 2.0 * radius < pitch:
        raise DeclarationError(
            f"radius: must be above 0 and below half a link, {0.5 * pitch:g} m; received {radius:g}; take fewer links"
        )
    return {"capsule": {"radius": radius, "length": pitch - 2.0 * radius}}


def refuse_lines(joint: Mapping[str, Any]) -> None:
    """Raise DeclarationError for a joint that holds no point."""
    for key in joint:
        if key in JOINTS and not issubclass(JOINTS[key], PointJoint):
            accepted = ", ".join(sorted(key for key, kind in JOINTS.items() if issubclass(kind, PointJoint)))
            raise DeclarationError(f"joint.{key}: holds no point, at which links meet; accepted: {accepted}")


def _attach(
    simulation: Simulation, joint: Mapping[str, Any], a: str | int, b: str | int, at: Floats, name: str
) -> None:
    """Hold one end of a chain."""
    ends = {side: None if whom == WORLD else whom for side, whom in (("a", a), ("b", b))}
    kinds = {key: {**words, **ends, "at": at} for key, words in joint.items()}
    simulation.add(name=name, joint=kinds)
