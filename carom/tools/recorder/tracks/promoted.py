"""Promoted: chosen bodies with a path, a label, plots and a lane of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Column, Floats, Integers
from carom.ecs.relations.touching import Touching
from carom.systems.bodies import centers_of_mass, dynamic_rows
from carom.systems.compound import bodies_of
from carom.systems.energy import kinetic_energies
from carom.systems.free_body import FRICTION, JOINT, NORMAL, loads
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.choice import Choice, Chosen
from carom.tools.recorder.lanes import Lanes, told
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle, number
from carom.tools.recorder.stream import Stamp, Stream, own_path
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.bodies import Bodies

ROOT = "promoted"
LABELS = "world/labels"
LABEL_RADIUS = -2.0  # negative: points of the screen
LABEL_COLOR = (240, 240, 240)
AXES = (255, 90, 60), (120, 210, 130), (90, 160, 255)
NOBODY = "nobody"
SLEEP = {"awake": (120, 210, 130), "asleep": (90, 110, 170)}
PLOTS = {
    "position": ("position (m)", "xyz"),
    "speed": ("speed (m/s)", ("speed",)),
    "energy": ("energy (J)", ("kinetic", "potential")),
    "force": ("forces (N)", ("applied", "normal", "friction", "joint")),
}


class Promoted(RowTrack):
    """Chosen bodies that obey forces: where they are, how fast, their energy, what acts on them and who touches them.

    Potential energy is that in gravity. Forces from outside and of laws are summed; those of contacts and joints are
    means of the step.
    """

    key: ClassVar[str] = "promoted"
    path: ClassVar[str] = ROOT
    sparse: ClassVar[bool] = True
    columns: ClassVar[Mapping[str, Column]] = {
        "entity": handle("the body"),
        "position": Transform.columns["position"],
        "speed": number("m/s", "of its centre of mass"),
        "kinetic": number("J", "energy of motion and rotation"),
        "potential": number("J", "energy in gravity"),
        "applied": number("N", "sum of all forces but those of contacts and joints, world frame", 3),
        "normal": number("N", "sum of normal forces of contacts, world frame", 3),
        "friction": number("N", "sum of friction of contacts, world frame", 3),
        "joint": number("N", "sum of forces of joints, world frame", 3),
    }

    def __init__(self, chosen: Chosen = ()) -> None:
        super().__init__()
        self.choice = Choice(chosen)
        self._lanes, self._touching = Lanes("sleep", SLEEP), Lanes("touching", {NOBODY: (90, 90, 90)})
        self._there: dict[int, str] = {}
        self._names: dict[int, str] = {}

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Have each drawn by itself, so that it is outlined and hidden by itself."""
        bodies = tracks["bodies"]
        assert isinstance(bodies, Bodies)
        bodies.alone = self.choice

    def silent(self, simulation: Simulation) -> bool:
        """Tell whether nobody was chosen."""
        return self.choice.nobody

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the plots of each that is there, and the lanes."""
        for name in reversed(world.names_told(world.entities(self._bodies(world)))):
            plots = {f"{own_path(ROOT, name)}/{key}": f"{name}: {title}" for key, (title, _) in PLOTS.items()}
            layout.plot_first(name, plots)
            layout.lanes = True

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep what there is to tell of each; label one that is new, and clear the label of one that is gone."""
        import rerun

        world = simulation.world
        rows = self._bodies(world)
        entities = world.entities(rows)
        names = dict(zip(entities.tolist(), world.names_told(entities), strict=True))
        for entity in names.keys() - self._there.keys():
            label = rerun.Points3D.from_fields(
                labels=[names[entity]], show_labels=True, radii=[LABEL_RADIUS], colors=[LABEL_COLOR]
            )
            stream.row(own_path(LABELS, names[entity]), stamp, label)
            for curve, color in zip("xyz", AXES, strict=True):
                style = rerun.SeriesLines(colors=[color])
                stream.static(f"{own_path(ROOT, names[entity])}/position/{curve}", style)
        for entity in self._there.keys() - names.keys():
            stream.row(own_path(LABELS, self._there[entity]), stamp, rerun.Clear(recursive=False))
        self._there = names
        self._names |= names
        states = np.where(world[Motion].asleep[rows], "asleep", "awake").tolist()
        self._lanes.note_all(stamp, dict(zip(names.values(), states, strict=True)))
        self._touching.note_all(stamp, dict(zip(names.values(), _touched(world, rows), strict=True)))
        super().sample(simulation, stamp, stream)

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each body."""
        world = simulation.world
        rows = self._bodies(world)
        body, centers = world[RigidBody], centers_of_mass(world, rows)
        weighing = body.mass[rows] * body.gravity_scale[rows]
        found = loads(simulation)
        names = np.array(found.name, np.str_)
        forces = {"normal": names == NORMAL, "friction": names == FRICTION, "joint": names == JOINT}
        forces["applied"] = ~np.logical_or.reduce(list(forces.values()))
        return {
            "entity": world.entities(rows),
            "position": world[Transform].position[rows],
            "speed": np.linalg.norm(world[Motion].linear[rows], axis=1),
            "kinetic": kinetic_energies(world, rows),
            "potential": -weighing * (centers @ np.array(world[Settings].gravity)),
            **{name: _summed(found.body[kept], found.force[kept], rows) for name, kept in forces.items()},
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Write labels and curves, of forces their sizes."""
        import rerun

        stamps = np.repeat(np.arange(len(block.stamps)), block.counts)
        for entity in np.unique(block.columns["entity"]).tolist():
            rows = np.nonzero(block.columns["entity"] == entity)[0]
            name, when = self._names[entity], [block.stamps[stamp] for stamp in stamps[rows]]
            position = block.columns["position"][rows]
            stream.rows(own_path(LABELS, name), when, rerun.Points3D.columns(positions=position))
            for key, (_, curves) in PLOTS.items():
                values = position.T if key == "position" else [block.columns[curve][rows] for curve in curves]
                for curve, numbers in zip(curves, values, strict=True):
                    sizes = np.linalg.norm(numbers, axis=1) if numbers.ndim == 2 else numbers
                    columns = rerun.Scalars.columns(scalars=sizes)
                    stream.rows(f"{own_path(ROOT, name)}/{key}/{curve}", when, columns)
        return ()

    def write(self, stream: Stream) -> None:
        """Write rows, labels, curves and lanes."""
        super().write(stream)
        self._lanes.write(stream)
        self._touching.write(stream)

    def _bodies(self, world: World) -> Integers:
        """Return the rows of those chosen that obey forces."""
        rows = dynamic_rows(world)
        return rows[self.choice.rows(world)[rows]]


def _touched(world: World, rows: Integers) -> list[str]:
    """Return whom each body (row) touches, by colliders of whatever it carries."""
    touching, owners = world[Touching], bodies_of(world)
    pairs = np.stack([touching.a[: touching.count], touching.b[: touching.count]], axis=1)
    pairs = pairs[world.slots.live(pairs.ravel()).reshape(pairs.shape).all(axis=1)]
    owned = owners[world.slots.rows(pairs.ravel())].reshape(pairs.shape)
    found = [np.unique(pairs[:, ::-1][owned == row]) for row in rows.tolist()]
    return [told(world.names_told(others), "touch it") or NOBODY for others in found]


def _summed(body: Integers, force: Floats, rows: Integers) -> Floats:
    """Return the sum of forces (n, 3) on each of ``rows``."""
    sums = np.zeros((int(max(body.max(initial=-1), rows.max(initial=-1))) + 1, 3))
    np.add.at(sums, body, force)
    return np.asarray(sums[rows])
