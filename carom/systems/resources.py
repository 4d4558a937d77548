"""Resources: what there is one of in every world that is simulated."""

from __future__ import annotations

from carom.ecs.commands import Commands
from carom.ecs.component import Resource
from carom.systems.awake import Awake
from carom.systems.compound import StatedBodies
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.broad import BroadPhase
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.seams import Seams
from carom.systems.detection.sensors import Sensing
from carom.systems.events import Events
from carom.systems.forces.law import Forces
from carom.systems.forces.standing import Standing
from carom.systems.landings import Landings
from carom.systems.layers import Layers
from carom.systems.ledger import Ledger
from carom.systems.linkage import Linkage
from carom.systems.materials import Materials
from carom.systems.particles.fields import Fields
from carom.systems.particles.newborn import Newborn
from carom.systems.progress import Progress
from carom.systems.queries.asked import Asked
from carom.systems.queries.scene import Scene
from carom.systems.resting import Resting
from carom.systems.settings import Random, Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.stream import Stream
from carom.systems.threads import Threads
from carom.systems.ties import Ties


def resources(settings: Settings) -> tuple[Resource, ...]:
    """Return them for a new world: what is made and stated, what a step counts, and caches, which may be dropped."""
    made = (Random(settings.seed), Layers(), Materials(), Geometries(), StatedBodies())
    stated = (Forces(), Events(), Commands())
    packed = (BroadPhase(), Apart(), FclObjects(), PackedHulls(), PackedMeshes(), Seams())
    solving = (Standing(), Resting(), Ties(), Linkage(), Landings(), Sensing(), Awake(), Fast(), Ledger(), Stream())
    caches = (*packed, *solving, Threads(), Scene(), Asked(), Newborn(), Fields())
    return (settings, *made, *stated, Progress(), Answered(), *caches)
