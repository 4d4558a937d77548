"""Surfaceless: an EGL context without a surface, of which several live side by side.

Import this only after `carom.tools.offscreen.load`.
"""

from __future__ import annotations

from typing import Any

from OpenGL.EGL import eglDestroyContext
from pyrender.platforms.egl import EGLPlatform


class Surfaceless(EGLPlatform):  # type: ignore[misc]
    """pyrender's platform, but for what it does in the end: the display is one for all contexts of the process."""

    _egl_context: Any

    def delete_context(self) -> None:
        """Free the context; the display stays open for others, whose contexts would be gone with it."""
        if self._egl_context is not None:
            eglDestroyContext(self._egl_display, self._egl_context)
        self._egl_context = None
