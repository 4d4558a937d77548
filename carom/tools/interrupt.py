"""Interrupt: Ctrl-C that waits for the end of a step, so that nothing is left half done."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType


@contextmanager
def deferred_interrupt() -> Iterator[Callable[[], None]]:
    """Hold back Ctrl-C: calling what this lends raises KeyboardInterrupt if it was pressed, as does the end.

    A second press acts at once.
    """
    if current_thread() is not main_thread():
        yield lambda: None  # only the main thread receives signals
        return
    pressed = False

    def press(number: int, frame: FrameType | None) -> None:
        nonlocal pressed
        if pressed:
            raise KeyboardInterrupt
        pressed = True

    def check() -> None:
        if pressed:
            raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, press)
    try:
        yield check
    finally:
        signal.signal(signal.SIGINT, before)
    check()  # else a press after the last step would be forgotten
