"""OSMesa: a context in plain memory, under the PyOpenGL 3.1.0 that pyrender pins.

That PyOpenGL lacks OSMesaCreateContextAttribs and hands out contexts it cannot hash, so both are called by ctypes on
the library it loaded. Import this only after `carom.tools.offscreen.load`.
"""

from __future__ import annotations

import ctypes

from OpenGL import platform
from pyrender.platforms.base import Platform

# Names and values of GL/osmesa.h: 8-bit RGBA, a depth buffer of 24 bits, the core profile of OpenGL 3.3, end of list.
ATTRIBUTES = (0x22, 0x1908, 0x30, 24, 0x33, 0x34, 0x36, 3, 0x37, 3, 0)
UNSIGNED_BYTE = 0x1401


class OSMesa(Platform):  # type: ignore[misc]
    """A pyrender platform without screen, window or graphics card."""

    def init_context(self) -> None:
        """Create the context; raise RuntimeError when the library refuses."""
        library = self._library = platform.PLATFORM.OSMesa
        # PyOpenGL sets a return type it cannot hash when this attribute is first looked up, so ours comes after.
        _ = platform.PLATFORM.GetCurrentContext
        library.OSMesaGetCurrentContext.restype = ctypes.c_void_p
        library.OSMesaCreateContextAttribs.restype = ctypes.c_void_p
        library.OSMesaCreateContextAttribs.argtypes = [ctypes.POINTER(ctypes.c_int), ctypes.c_void_p]
        library.OSMesaMakeCurrent.restype = ctypes.c_ubyte
        kind_and_size = (ctypes.c_uint, ctypes.c_int, ctypes.c_int)
        library.OSMesaMakeCurrent.argtypes = [ctypes.c_void_p, ctypes.c_void_p, *kind_and_size]
        library.OSMesaDestroyContext.restype = None
        library.OSMesaDestroyContext.argtypes = [ctypes.c_void_p]
        self._context = library.OSMesaCreateContextAttribs((ctypes.c_int * len(ATTRIBUTES))(*ATTRIBUTES), None)
        if not self._context:
            raise RuntimeError("OSMesaCreateContextAttribs refused")
        self._pixels = (ctypes.c_ubyte * (self.viewport_width * self.viewport_height * 4))()

    def make_current(self) -> None:
        """Make the context the one that OpenGL calls of this thread go to."""
        size = (self.viewport_width, self.viewport_height)
        if not self._library.OSMesaMakeCurrent(self._context, self._pixels, UNSIGNED_BYTE, *size):
            raise RuntimeError("OSMesaMakeCurrent refused")

    def make_uncurrent(self) -> None:
        """Do nothing: contexts are switched by making another one current."""

    def delete_context(self) -> None:
        """Free the context and its pixels."""
        if self._context:
            self._library.OSMesaDestroyContext(self._context)
        self._context = None

    def supports_framebuffers(self) -> bool:
        """Return True: pictures are drawn into framebuffer objects, with 4 samples a pixel."""
        return True
