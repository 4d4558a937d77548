"""Particles as pictures and recordings show them: by their share of life, as dots over a picture or as solids in it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.ecs.components.emitter import Drawn, Emitter
from carom.ecs.relations.particle import Particle
from carom.systems.particles.pieces import Piece, emitter_row, pieces
from carom.systems.settings import time_of
from carom.systems.shapes.box import Box
from carom.systems.shapes.shape import Shape
from carom.systems.shapes.sphere import Sphere
from carom.tools.batch import Batch
from carom.tools.marks import Lines, Mark
from carom.tools.view import View

POINT_WIDTH = 3.0  # px of what is drawn as points, however far it is
SOLIDS: dict[int, Shape] = {Drawn.SPHERES: Sphere(0.5), Drawn.BOXES: Box((1.0, 1.0, 1.0))}
SURFACES = {kind: shape.surface() for kind, shape in SOLIDS.items()}
COARSER = {kind: shape.coarser_surfaces() for kind, shape in SOLIDS.items()}


class Cloud(NamedTuple):
    """The particles of one emitter as they look: places (n, 3) and diameters (n,) in m, colours (n, 4).

    They are in a ``piece`` of their table, and their emitter is in the row ``source``.
    """

    piece: Piece
    source: int
    drawn: Drawn
    places: Floats
    diameters: Floats
    colors: Floats


def clouds(world: World) -> Iterator[Cloud]:
    """Yield the particles of each emitter that has any, with size and colour by how much of their life is over."""
    if not world.count(Particle):
        return
    emitter, particle, time = world[Emitter], world[Particle], time_of(world)
    for piece in pieces(world):
        row = emitter_row(world, piece)
        if row is None:
            continue
        spent = particle.spent(piece.rows, time)
        sizes = emitter.size[row] + spent * (emitter.end_size[row] - emitter.size[row])
        colors = emitter.color[row] + spent[:, None] * (emitter.end_color[row] - emitter.color[row])
        yield Cloud(piece, row, Drawn(emitter.drawn[row]), particle.position(piece.rows), sizes, colors)


def particle_batches(world: World) -> list[Batch]:
    """Return those drawn as solids; as ids they have the row of their emitter."""
    batches = []
    for cloud in clouds(world):
        if cloud.drawn in SURFACES:
            surface, count = SURFACES[cloud.drawn], len(cloud.places)
            poses = np.zeros((count, 4, 4))
            poses[:, :3, :3] = cloud.diameters[:, None, None] * np.eye(3)
            poses[:, :3, 3], poses[:, 3, 3] = cloud.places, 1.0
            ids = np.full(count, cloud.source)
            place = (surface.vertices, surface.faces, poses, cloud.colors, ids, surface.smooth)
            batches.append(Batch(*place, coarser=COARSER[cloud.drawn]))
    return batches


def particle_marks(world: World, view: View) -> list[Mark]:
    """Return those drawn as points and as sprites, the farthest first."""
    seen = [cloud for cloud in clouds(world) if cloud.drawn not in SURFACES]
    if not seen:
        return []
    places = np.concatenate([cloud.places for cloud in seen])
    widths = [
        np.full(len(cloud.places), POINT_WIDTH)
        if cloud.drawn == Drawn.POINTS
        else cloud.diameters * view.pixels_per_metre(cloud.places) / view.magnification
        for cloud in seen
    ]
    order = np.argsort(-view.ahead(places), kind="stable")
    width, colors = np.concatenate(widths)[order], np.concatenate([cloud.colors for cloud in seen])[order]
    return [Lines(places[order], places[order], colors, width, behind=0.0)]
