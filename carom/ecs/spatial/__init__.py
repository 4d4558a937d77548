"""Mathematics of space over arrays: vectors, quaternions, matrices, trigonometry that is equal on every machine."""

from carom.ecs.spatial import affine, angles, constants, matrix, projection, quaternion, vector

__all__ = ["affine", "angles", "constants", "matrix", "projection", "quaternion", "vector"]
