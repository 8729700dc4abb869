"""Curve-skeletons of 3D shapes from their silhouettes.

    import marrow
    vertices, faces = marrow.read_shape("horse.obj")
    skeleton = marrow.extract(vertices, faces)
    skeleton.save("horse.skel")
"""

from ._marrow import (
    Error,
    Skeleton,
    __version__,
    extract,
    extract_file,
    extract_volume,
    load,
    read_shape,
)

__all__ = [
    "Error",
    "Skeleton",
    "__version__",
    "extract",
    "extract_file",
    "extract_volume",
    "load",
    "read_shape",
]
