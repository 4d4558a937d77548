"""Models of other programs as world files: URDF, MJCF and glTF."""
