"""Checks of what callers give, with messages that say what would be right."""
from __future__ import annotations

import math
from typing import Any, Optional, Tuple

import numpy as np

from .model import Floats, Indices

MOST_VERTICES = 1 << 24


def as_faces(faces: Any) -> Tuple[Indices, Optional[Indices]]:
    """Faces as uint32 [face, 3], and the polygons [polygon, 2] that faces of more corners were."""
    if isinstance(faces, np.ndarray):
        array = faces
    else:
        try:
            array = np.array(faces)
        except ValueError:
            array = np.empty(0, object)
    if array.size == 0 and array.dtype != object:
        return np.zeros((0, 3), np.uint32), None
    if array.ndim != 2 or array.shape[1] < 3 or array.dtype == object:
        raise ValueError(
            f"faces have the shape {array.shape}: they are [face, 3], or [face, N] where all have N corners; of "
            "faces with different numbers of corners make triangles, and say so in polygons="
        )
    if array.dtype.kind == "f" and np.array_equal(array, np.floor(array)):
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise ValueError(f"faces are {array.dtype}: they are vertex numbers, so whole ones")
    low = array.min()
    if low < 0 or array.max() >= MOST_VERTICES:
        face, corner = np.argwhere((array < 0) | (array >= MOST_VERTICES))[0]
        raise ValueError(
            f"faces[{face}, {corner}] is {array[face, corner]}: vertices are numbered from 0 to {MOST_VERTICES - 1}"
        )
    corners = array.shape[1]
    if corners == 3:
        return np.ascontiguousarray(array, dtype=np.uint32), None
    fans = [array[:, [0, i, i + 1]] for i in range(1, corners - 1)]
    triangles = np.ascontiguousarray(np.stack(fans, axis=1).reshape(-1, 3), dtype=np.uint32)
    count = len(array)
    polygons = np.stack([np.arange(count) * (corners - 2), np.full(count, corners)], axis=1)
    return triangles, polygons.astype(np.uint32)


def check_faces(faces: Indices, vertex_count: int) -> None:
    """ValueError where a face names a vertex that is not there."""
    if len(faces) and int(faces.max()) >= vertex_count:
        face, corner = np.argwhere(faces >= vertex_count)[0]
        raise ValueError(
            f"faces[{face}, {corner}] is {faces[face, corner]}, but there are {vertex_count} vertices, numbered "
            f"from 0 to {vertex_count - 1}"
        )


def as_frame(positions: Any, number: int, vertex_count: Optional[int]) -> Floats:
    """Positions of a frame as float32 [vertex, 3] without gaps, each of them finite."""
    what = f"frame {number}"
    given = positions if isinstance(positions, np.ndarray) else np.asarray(positions)
    if given.dtype.kind not in "fiu":
        raise ValueError(f"{what} is {given.dtype}: positions are real numbers, float32 at best")
    if given.ndim != 2 or given.shape[1] != 3:
        hint = ""
        if given.ndim == 3:
            hint = "; is positions a list of sequences?"
        elif given.ndim == 1:
            hint = "; one frame alone is positions[np.newaxis]"
        elif given.ndim == 2 and given.shape[0] == 3:
            hint = "; its transpose, positions.T, would be"
        raise ValueError(f"{what} has the shape {given.shape}: a frame is [vertex, 3]{hint}")
    if vertex_count is not None and len(given) != vertex_count:
        raise ValueError(
            f"{what} has {len(given)} vertices, and the mesh {vertex_count}: where the mesh changes, give "
            "tvg.Frame(positions, tvg.Mesh(faces, vertex_count))"
        )
    with np.errstate(over="ignore"):
        array: Floats = np.ascontiguousarray(given, dtype=np.float32)
    _check_finite(array, given, what)
    return array


def _check_finite(array: Floats, given: "np.ndarray[Any, Any]", what: str) -> None:
    # The sum is not finite where a number is not, and rarely where all are: then they are looked at.
    with np.errstate(over="ignore", invalid="ignore"):
        suspicious = not math.isfinite(float(array.sum()))
    if suspicious and not np.isfinite(array).all():
        vertex, axis = np.argwhere(~np.isfinite(array))[0]
        raise ValueError(
            f"{what}, vertex {vertex}: {'xyz'[axis]} is {given[vertex, axis]}; coordinates are finite numbers of "
            "float32 (fill in or leave out what is missing)"
        )


def bounding_box(frames: Any) -> "Optional[Tuple[Floats, Floats]]":
    """The least and the largest of each coordinate over all frames; None where something is no frame."""
    low = np.full(3, np.inf, np.float32)
    high = np.full(3, -np.inf, np.float32)
    for number, positions in enumerate(frames):
        frame = as_frame(positions, number, None)
        if len(frame):
            np.minimum(low, frame.min(axis=0), out=low)
            np.maximum(high, frame.max(axis=0), out=high)
    return (low, high) if (low <= high).all() else None
