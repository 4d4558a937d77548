"""Passes: pyrender's renderer with carom's shaders, sun, sky and order of drawing.

Import this only after `carom.tools.offscreen.load`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pyrender
from OpenGL import GL

from carom.tools.cameras import Camera
from carom.tools.round_numbers import last_round
from carom.tools.sun import sun_for

SHADOW_BLUR = 1.25  # texels of the shadow map
SQUARES = 4.0  # squares of a floor between camera and target, rounded to 1, 2 or 5 times a power of ten


class Passes(pyrender.Renderer):  # type: ignore[misc]
    """Draws nodes as a camera sees them; `see` sets both before each picture.

    pyrender sorts nodes by distance and, within one distance, by chance; here they are drawn in the order given, so
    that pictures of one scene are the same to the last bit.
    """

    def __init__(self, width: int, height: int, *, antialiasing: bool = True) -> None:
        super().__init__(width, height)
        self._antialiasing = antialiasing
        self._program_cache.shader_dir = str(Path(__file__).parent / "shaders")
        self._aspect = width / height
        self.shadow_texels = 1024 if width * height <= 640 * 480 else 2048  # along each edge of the shadow map

    def __del__(self) -> None:
        """Delete nothing: by now another context may be current, where the same numbers are those of another renderer.

        `Renderer.close` deletes in the right one.
        """

    def reserve(self) -> bool:
        """Make the framebuffers; return whether the driver had room for them."""
        self._configure_main_framebuffer()
        found = []
        for buffer in (self._main_fb_ms, self._main_fb):
            GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, buffer)
            found.append(GL.glCheckFramebufferStatus(GL.GL_DRAW_FRAMEBUFFER))
        return found == [GL.GL_FRAMEBUFFER_COMPLETE] * 2

    def cast(self) -> None:
        """Forget the shadows: what casts them has changed."""
        self._shadows: bytes | None = None

    def see(self, nodes: list[Any], camera: Camera) -> None:
        """Take what the next picture shows, and from where."""
        self._nodes = nodes
        self._lit: set[Any] = set()
        pose = camera.pose()
        self._camera_matrices: tuple[Any, Any] = np.linalg.inv(pose), camera.projection(self._aspect)
        up = np.array(camera.zenith) / np.linalg.norm(camera.zenith)
        sun = sun_for(camera, self._aspect, self.shadow_texels)
        self._light_matrices = sun.view(), sun.projection()
        self._uniforms = {
            "up": up,
            "focus": camera.distance,
            "square": last_round(camera.distance / SQUARES),
            "sun": sun.direction,
            "texel": 2.0 * sun.reach / self.shadow_texels,
            "blur": SHADOW_BLUR / self.shadow_texels,
            "light_matrix": sun.projection() @ sun.view(),
        }

    def _sorted_mesh_nodes(self, scene: Any) -> list[Any]:
        return self._nodes

    def _get_camera_matrices(self, scene: Any) -> tuple[Any, Any]:
        return self._camera_matrices

    def _get_light_cam_matrices(self, scene: Any, light_node: Any, flags: int) -> tuple[Any, Any]:
        return self._light_matrices

    def _configure_shadow_mapping_viewport(self, light: Any, flags: int) -> None:
        super()._configure_shadow_mapping_viewport(light, flags)
        GL.glViewport(0, 0, self.shadow_texels, self.shadow_texels)

    def _shadow_mapping_pass(self, scene: Any, light_node: Any, flags: int) -> None:
        wanted = b"".join(matrix.tobytes() for matrix in self._light_matrices)
        if wanted != self._shadows:
            super()._shadow_mapping_pass(scene, light_node, flags)
            self._shadows = wanted

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        super()._configure_forward_pass_viewport(flags)
        if not self._sampled(flags):
            GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._main_fb)

    def _sampled(self, flags: int) -> bool:
        """Tell whether several samples a pixel are taken: never of ids and depths, which must not be mixed."""
        return self._antialiasing and not flags & pyrender.RenderFlags.SEG

    def _bind_lighting(self, scene: Any, program: Any, node: Any, flags: int) -> None:
        if program in self._lit:  # what is set stays set for the other nodes of this picture
            self._texture_alloc_idx = 1  # the next texture goes beside the shadow map
            return
        self._lit.add(program)
        for name, value in self._uniforms.items():
            program.set_uniform(name, value)
        (light,) = scene.lights
        self._bind_texture(light.shadow_texture, "shadow_map", program)
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_COMPARE_MODE, GL.GL_COMPARE_REF_TO_TEXTURE)
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR)

    def _read_main_framebuffer(self, scene: Any, flags: int) -> Any:
        """Return colours (h, w, 3), or for a pass of ids bytes (h, w, 4) and raw depth (h, w); first row on top."""
        width, height = self._main_fb_dims
        area = (0, 0, width, height)
        if self._sampled(flags):
            GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._main_fb_ms)
            GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._main_fb)
            GL.glBlitFramebuffer(*area, *area, GL.GL_COLOR_BUFFER_BIT, GL.GL_NEAREST)
        identify = bool(flags & pyrender.RenderFlags.SEG)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._main_fb)
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)  # rows of a width that is no multiple of 4 are not padded
        channels = GL.GL_RGBA if identify else GL.GL_RGB
        pixels = np.frombuffer(GL.glReadPixels(*area, channels, GL.GL_UNSIGNED_BYTE), np.uint8)
        colors = np.ascontiguousarray(pixels.reshape(height, width, -1)[::-1])
        if not identify:
            return colors
        depth = np.frombuffer(GL.glReadPixels(*area, GL.GL_DEPTH_COMPONENT, GL.GL_FLOAT), np.float32)
        return colors, np.ascontiguousarray(depth.reshape(height, width)[::-1])
