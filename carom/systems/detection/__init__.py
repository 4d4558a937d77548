"""Detection: bounds, pairs, contacts and sensors at the poses of the start of the step."""

from carom.systems.detection.answered import Answered

__all__ = ["Answered"]
