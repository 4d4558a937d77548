"""Doctor: what works on this machine, and how to mend what does not."""

from __future__ import annotations

import json as json_module
import os
import platform
import shutil
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryFile

from carom.ecs.errors import CaromError
from carom.tools.offscreen import GraphicsError

REINSTALL = "run: python -m pip install --force-reinstall carom"


@dataclass(frozen=True)
class Finding:
    """One thing looked at: whether it works, what was seen, and how to mend it (empty where it works)."""

    name: str
    works: bool
    seen: str
    mend: str = ""


class FaultError(CaromError):
    """Something does not work; ``mend`` says what to do."""

    def __init__(self, seen: str, mend: str) -> None:
        super().__init__(seen)
        self.mend = mend


def python() -> str:
    """Return the versions of Python, NumPy and Numba, which decide what a kernel is compiled to."""
    return f"{platform.python_version()}, numpy {version('numpy')}, numba {version('numba')}, carom {version('carom')}"


def processor() -> str:
    """Return the processor and how many of its threads this process may use."""
    threads = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    model = next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.machine())
    return f"{model}, {threads} threads"


def kernels() -> str:
    """Return where kernels are cached and how many are; raise FaultError where nothing can be written."""
    from numba.core.caching import FunctionCache

    from carom.systems.kernels.kernel import kernel
    from carom.systems.kernels.stored import ENDING

    mend = "set the environment variable NUMBA_CACHE_DIR to a folder that can be written"
    try:
        folder = Path(FunctionCache(kernel).cache_path)
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except (OSError, RuntimeError) as fault:
        raise FaultError(f"no folder to cache kernels in: {fault}", mend) from fault
    count = len(list(folder.glob(f"*{ENDING}")))
    return f"{count} cached in {folder}" + ("" if count else "; run: carom warm")


def collision() -> str:
    """Return what FCL says of two unit spheres 1.5 m apart; raise FaultError unless they overlap by 0.5 m."""
    from carom.ecs import Collider, World
    from carom.ecs.components.collider import ColliderPose
    from carom.systems.detection.fcl_objects import FclObjects
    from carom.systems.detection.fcl_single import Side, measure
    from carom.systems.shapes.geometry import Geometries
    from carom.systems.shapes.sphere import Sphere

    world, ball = World(), Sphere(1.0)
    world.add(Geometries())
    world.add(FclObjects())
    shape = Collider(shape=ball.number, size=ball.packed())
    places = [ColliderPose(position=(x, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0)) for x in (0.0, 1.5)]
    one, two = (Side(world, world.row(world.spawn(shape, place))) for place in places)
    depths = [float(depth) for _, _, depth in measure(one, two, 0.0)]
    if len(depths) != 1 or abs(depths[0] - 0.5) > 1e-9:
        raise FaultError(f"two unit spheres 1.5 m apart overlap by {depths} m, must be [0.5]", REINSTALL)
    return f"python-fcl {version('python-fcl')}, two unit spheres 1.5 m apart overlap by 0.5 m"


def graphics() -> str:
    """Return what draws pictures, having drawn one."""
    from carom.tools.cameras import Camera
    from carom.tools.renderer import Renderer

    with Renderer(16, 16) as renderer:
        renderer.picture([], Camera((0.0, 0.0, 1.0)))
        return renderer.driver


def recording() -> str:
    """Return the version of Rerun and where its viewer is; raise FaultError where the viewer is missing."""
    import rerun

    beside = str(Path(sys.executable).parent)
    viewer = shutil.which("rerun", path=os.pathsep.join([beside, os.environ.get("PATH", "")]))
    if viewer is None:
        raise FaultError(
            f"rerun-sdk {rerun.__version__} without its viewer", f"put the folder of `rerun` on PATH, or {REINSTALL}"
        )
    return f"rerun-sdk {rerun.__version__}, viewer {viewer}"


def film() -> str:
    """Return the encoder that writes films."""
    import imageio_ffmpeg

    return f"{imageio_ffmpeg.get_ffmpeg_exe()} {imageio_ffmpeg.get_ffmpeg_version()}"


def extensions() -> str:
    """Return the extensions of carom that are installed; raise FaultError for one that cannot be used."""
    from carom.systems.extensions import load_extensions

    try:
        loaded = load_extensions()
    except CaromError as fault:
        raise FaultError(str(fault), "") from fault  # which says how to mend it
    return ", ".join(f"{extension.distribution} {extension.version}" for extension in loaded) or "none installed"


CHECKS: tuple[Callable[[], str], ...] = (python, processor, kernels, collision, graphics, recording, film, extensions)


def examine(check: Callable[[], str]) -> Finding:
    """Return what a check found; whatever goes wrong in it is a finding too."""
    try:
        return Finding(check.__name__, True, check())
    except FaultError as fault:
        return Finding(check.__name__, False, str(fault), fault.mend)
    except GraphicsError as fault:
        return Finding(check.__name__, False, "no software OpenGL", str(fault))
    except Exception as fault:
        return Finding(check.__name__, False, f"{type(fault).__name__}: {fault}", REINSTALL)


def doctor(json: bool = False) -> int:
    """Print what works on this machine and how to mend what does not; return 0 when all works, else 1."""
    findings = [examine(check) for check in CHECKS]
    if json:
        print(json_module.dumps([asdict(finding) for finding in findings], indent=2))
    else:
        for finding in findings:
            print(f"{'ok  ' if finding.works else 'FAIL'}  {finding.name:<10} {finding.seen}")
            if finding.mend:
                print(f"{'':16} {finding.mend}")
    return 0 if all(finding.works for finding in findings) else 1
