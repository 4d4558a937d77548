"""Recorder: the table with a time axis, as a Rerun recording."""

from carom.tools.recorder.recorder import Recorder

__all__ = ["Recorder"]
