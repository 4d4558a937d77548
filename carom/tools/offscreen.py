"""Offscreen: which OpenGL draws on this machine, and the context it draws in.

OSMesa renders on the CPU into memory. Where its library is not to be had (later Mesa has none), EGL without a surface
renders on the same machine. PyOpenGL fixes its platform at the first ``import OpenGL``, so `load` comes before it.
"""

from __future__ import annotations

import ctypes
import os
import sys
import warnings
from importlib import import_module
from types import ModuleType
from typing import Any

from carom.ecs.errors import CaromError

PLATFORM_VARIABLE = "PYOPENGL_PLATFORM"
LIBRARIES = {
    "osmesa": (("libOSMesa.so.8",), ("libOSMesa.so.6",), ("libOSMesa.so",)),
    "egl": (("libEGL.so.1", "libEGL_mesa.so.0"), ("libEGL.so.1",)),
}


class GraphicsError(CaromError):
    """No picture can be drawn on this machine as it is set up."""


def loads(libraries: tuple[str, ...]) -> bool:
    """Return whether the dynamic loader finds every one of ``libraries``."""
    try:
        for library in libraries:
            ctypes.CDLL(library)
    except OSError:
        return False
    return True


def backend() -> str:
    """Return ``osmesa`` or ``egl``, whose library loads; of both the one in PYOPENGL_PLATFORM, else ``osmesa``.

    Raises GraphicsError, which says how to mend it, when there is neither.
    """
    chosen = os.environ.get(PLATFORM_VARIABLE)
    for name in sorted(LIBRARIES, key=lambda name: name != chosen):
        if any(loads(libraries) for libraries in LIBRARIES[name]):
            return name
    raise GraphicsError(
        "pictures need software OpenGL, and neither libOSMesa.so nor libEGL.so.1 was found; accepted: either of them; "
        "run: sudo apt-get install -y libosmesa6 (or, where that package does not exist, libegl1 libgl1-mesa-dri); "
        "simulating, checking and recording work without it"
    )


def load() -> Any:
    """Import pyrender on the platform of `backend` and return it.

    Raises GraphicsError when there is no OpenGL, or when other code of this process imported it for a screen already.
    """
    name = backend()
    if "OpenGL" in sys.modules and os.environ.get(PLATFORM_VARIABLE) != name:
        raise GraphicsError(
            "OpenGL was imported before carom could choose how to draw without a screen; "
            f"set the environment variable {PLATFORM_VARIABLE}={name} before Python starts, or make carom's "
            "renderer first"
        )
    os.environ[PLATFORM_VARIABLE] = name
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # pyrender's dependencies use what their own dependencies will drop one day
        pyrender = _without_windows()
    _know_references()
    return pyrender


def _without_windows() -> Any:
    """Import pyrender without its viewer, whose windows need libraries of X11 that servers lack.

    ``pyrender.viewer`` is imported as ever by who asks for it by this name.
    """
    if "pyrender" not in sys.modules:
        sys.modules["pyrender.viewer"] = absent = ModuleType("pyrender.viewer")
        absent.Viewer = None  # type: ignore[attr-defined]
        try:
            import_module("pyrender")
        finally:
            del sys.modules["pyrender.viewer"]
    return import_module("pyrender")


def _know_references() -> None:
    """Teach PyOpenGL 3.1.0 the type of ``ctypes.byref``, whose module has another name since Python 3.13."""
    from OpenGL.arrays.arraydatatype import ArrayDatatype
    from OpenGL.arrays.ctypesparameters import CtypesParameterHandler

    ArrayDatatype.getRegistry()[type(ctypes.byref(ctypes.c_int()))] = CtypesParameterHandler()


def context() -> Any:
    """Return a pyrender platform whose OpenGL context is current; all is drawn into framebuffers of their own size."""
    load()
    if backend() == "osmesa":
        from carom.tools.osmesa import OSMesa

        platform = OSMesa(1, 1)
    else:
        from carom.tools.surfaceless import Surfaceless

        platform = Surfaceless(1, 1)
    try:
        platform.init_context()
    except Exception as fault:
        raise GraphicsError(
            f"the {backend()} library was found but gives no OpenGL 3.3 context: {fault}; "
            "run: sudo apt-get install --reinstall -y libosmesa6 (or libegl1 libgl1-mesa-dri)"
        ) from fault
    platform.make_current()
    return platform


def driver() -> str:
    """Return what draws in the current context, such as ``osmesa: llvmpipe (LLVM 15.0.6, 256 bits)``."""
    from OpenGL import GL

    return f"{backend()}: {GL.glGetString(GL.GL_RENDERER).decode()}"


def largest() -> int:
    """Return how wide and high (px) a picture in the current context can be."""
    from OpenGL import GL

    return int(GL.glGetIntegerv(GL.GL_MAX_RENDERBUFFER_SIZE))
