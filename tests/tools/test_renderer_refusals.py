"""What cannot be drawn is refused in whole sentences: cameras, columns, closed renderers, missing libraries."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest
from drawn_bodies import CUBE, batch, poses

from carom.ecs.errors import CaromError
from carom.tools import offscreen
from carom.tools.batch import LARGEST_ID, Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            {"position": (1.0, 0.0, 0.0), "target": (1.0, 0.0, 0.0)},
            "camera: position and target must be finite and differ, received (1.0, 0.0, 0.0) and (1.0, 0.0, 0.0)",
        ),
        (
            {"position": (math.nan, 0.0, 0.0)},
            "camera: position and target must be finite and differ, received (nan, 0.0, 0.0) and (0.0, 0.0, 0.0)",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "up": (0.0, 0.0, 0.0)},
            "camera: up must be finite and not zero, received (0.0, 0.0, 0.0)",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "fov": math.pi},
            "camera: fov must lie between 0 and 180 deg, received 180 deg",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "near": 2.0, "far": 1.0},
            "camera: near must be above 0 m and below far, received 2 m and 1 m",
        ),
    ],
)
def test_a_camera_that_sees_nothing_is_refused(arguments: dict[str, object], message: str) -> None:
    """A camera without a direction, an angle or a range raises an error that names the values received."""
    with pytest.raises(CaromError) as caught:
        Camera(**arguments)  # type: ignore[arg-type]
    assert str(caught.value) == message


def test_ids_that_do_not_fit_are_refused() -> None:
    """A batch with an id above the largest one raises an error that gives the range allowed."""
    with pytest.raises(CaromError) as caught:
        batch(CUBE, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), first=LARGEST_ID)
    assert str(caught.value) == "batch: ids must lie from 0 to 16777214, received 16777214 to 16777215"


def test_columns_of_different_lengths_are_refused() -> None:
    """A batch has one pose, one colour and one id per instance, or raises an error with the three counts."""
    with pytest.raises(CaromError) as caught:
        Batch(CUBE.vertices, CUBE.faces, poses((0.0, 0.0, 0.0)), np.ones((2, 4)), np.zeros(1, np.int64))
    assert str(caught.value) == "batch: poses, colors and ids must be as many, received 1, 2 and 1"


def test_a_closed_renderer_says_so() -> None:
    """Closing twice is harmless, and drawing afterwards raises an error that says what to do."""
    closed = Renderer(8, 8)
    closed.close()
    closed.close()
    with pytest.raises(CaromError) as caught:
        closed.picture([], Camera((0.0, 0.0, 3.0)))
    assert str(caught.value) == "renderer: it was closed; make a new one"


def test_without_any_opengl_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error names the libraries looked for, the command to run, and what works without them."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: False)
    with pytest.raises(offscreen.GraphicsError) as caught:
        offscreen.backend()
    assert str(caught.value) == (
        "pictures need software OpenGL, and neither libOSMesa.so nor libEGL.so.1 was found; accepted: either of them; "
        "run: sudo apt-get install -y libosmesa6 (or, where that package does not exist, libegl1 libgl1-mesa-dri); "
        "simulating, checking and recording work without it"
    )


def test_opengl_imported_for_a_screen_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """If OpenGL was imported first, loading raises an error that gives two ways out."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setitem(sys.modules, "OpenGL", sys)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: True)
    with pytest.raises(offscreen.GraphicsError) as caught:
        offscreen.load()
    assert str(caught.value) == (
        "OpenGL was imported before carom could choose how to draw without a screen; set the environment variable "
        "PYOPENGL_PLATFORM=osmesa before Python starts, or make carom's renderer first"
    )
