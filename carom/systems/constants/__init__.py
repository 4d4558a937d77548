"""Every tolerance of the step: its unit, why this size, and what breaks if it changes; a module for each part of it."""

from carom.systems.constants.impacts import *  # noqa: F403
from carom.systems.constants.locks import *  # noqa: F403
from carom.systems.constants.manifolds import *  # noqa: F403
from carom.systems.constants.many import *  # noqa: F403
from carom.systems.constants.meshes import *  # noqa: F403
from carom.systems.constants.motion import *  # noqa: F403
from carom.systems.constants.pairs import *  # noqa: F403
from carom.systems.constants.queries import *  # noqa: F403
from carom.systems.constants.reaching import *  # noqa: F403
from carom.systems.constants.refining import *  # noqa: F403
from carom.systems.constants.resting import *  # noqa: F403
from carom.systems.constants.shapes import *  # noqa: F403
