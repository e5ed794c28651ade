"""How far two sequences are apart, and which vertices matter to an animation."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any, Iterable, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _options as o
from . import _structures as s
from ._arrays import as_faces, as_frame, check_faces
from ._library import encoder_library
from .errors import input_error
from .model import Frame


@dataclass(frozen=True)
class Comparison:
    """How far decoded frames lie from their originals. Distances are in the mesh's units.

    Attributes:
        frames: how many were compared.
        extent, diagonal: longest side and diagonal of the box around all frames of the original.
        max_coordinate_error, rms_coordinate_error, mean_coordinate_error: of the differences of coordinates.
        max_vertex_distance, rms_vertex_distance: of vertices from their decoded selves.
        worst_frame, worst_vertex: where the former is reached first.
        snr_db: the paper's signal to noise ratio; infinite for sequences that are the same.
        kg_percent: the KG error.
        mean_quadric_error, max_quadric_error: the paper's quadric error (Eq. 8), in squared units.
        sted, sted_spatial, sted_temporal: a STED-type metric: how unevenly edge lengths are off.
        hausdorff: between the surfaces, the larger of both directions, the largest of the frames measured; None
            where it was not asked for.
    """

    frames: int
    extent: float
    diagonal: float
    max_coordinate_error: float
    rms_coordinate_error: float
    mean_coordinate_error: float
    max_vertex_distance: float
    rms_vertex_distance: float
    worst_frame: int
    worst_vertex: int
    snr_db: float
    kg_percent: float
    mean_quadric_error: float
    max_quadric_error: float
    sted: float
    sted_spatial: float
    sted_temporal: float
    hausdorff: Optional[float]


class Measure(NamedTuple):
    """What `measure` found: costs, float64 [vertex], and important, bool [vertex]."""

    costs: "npt.NDArray[np.float64]"
    important: "npt.NDArray[np.bool_]"


def compare(original: Any, decoded: Any, faces: Any, hausdorff: Union[bool, int] = False) -> Comparison:
    """Compares two sequences of one mesh, frame by frame.

    Args:
        original, decoded: [frame, vertex, 3], or any iterable of [vertex, 3] or of `Frame`s (a `Clip`).
        faces: [face, 3]; KG and distances need none ([]).
        hausdorff: measure the distance of the surfaces too; a number N: at every Nth frame. About 20 ms for a
            frame of 10,000 vertices.

    Raises:
        ValueError: one has more frames, or other vertices, than the other.

    >>> wave = np.random.default_rng(1).random((5, 3, 3))
    >>> figures = tvg.compare(wave, tvg.decode(tvg.encode(wave, [[0, 1, 2]], bits=11))[0], [[0, 1, 2]])
    >>> figures.frames, figures.max_coordinate_error < figures.extent / 2**11
    (5, True)
    """
    lib = encoder_library()
    triangles, _ = as_faces(faces)
    comparer = ctypes.c_void_p()
    vertices: Optional[int] = None
    try:
        for number, (one, other) in enumerate(zip_longest(_plain(original), _plain(decoded))):
            if one is None or other is None:
                shorter = "original" if one is None else "decoded"
                raise ValueError(f"{shorter} ends after {number} frames, and the other goes on")
            pair = [as_frame(one, number, vertices), as_frame(other, number, vertices)]
            if vertices is None:
                vertices = len(pair[0])
                check_faces(triangles, vertices)
                _check(
                    lib.tvg_comparer_create(
                        vertices, triangles.ctypes.data, len(triangles), ctypes.byref(comparer)
                    ),
                    "there is no mesh to compare",
                )
                lib.tvg_comparer_use_hausdorff(comparer, int(hausdorff))
                pair[1] = as_frame(other, number, vertices)
            code = lib.tvg_comparer_add_frame(
                comparer, pair[0].ctypes.data, pair[1].ctypes.data, pair[0].size
            )
            _check(code, f"frame {number} cannot be compared")
        if vertices is None:
            raise ValueError("there is no frame to compare")
        report = s.sized(s.ComparisonReport)
        lib.tvg_comparer_get_report(comparer, ctypes.byref(report))
        names = [name for name in Comparison.__dataclass_fields__ if name != "hausdorff"]
        distance = report.hausdorff if report.hausdorff_frames else None
        return Comparison(**{name: getattr(report, name) for name in names}, hausdorff=distance)
    finally:
        lib.tvg_comparer_destroy(comparer)


def measure(positions: Any, faces: Any, importance: o.ImportanceLike = None) -> Measure:
    """Which vertices matter to an animation: the paper's measure over these frames.

    Args:
        positions: [frame, vertex, 3], or an iterable of [vertex, 3] or of `Frame`s; they are held in memory.
        faces: [face, 3].
        importance: as of `encode`: an `Importance`, a share, criteria, or weights.

    Returns:
        costs, float64 [vertex], and important, bool [vertex].

    >>> wave = np.random.default_rng(1).random((5, 4, 3))
    >>> costs, important = tvg.measure(wave, [[0, 1, 2], [0, 2, 3]], importance=0.5)
    >>> costs.shape, int(important.sum())
    ((4,), 2)
    """
    lib = encoder_library()
    triangles, _ = as_faces(faces)
    frames = [as_frame(frame, number, None) for number, frame in enumerate(_plain(positions))]
    if not frames:
        raise ValueError("there is no frame to measure: positions are [frame, vertex, 3]")
    for number, frame in enumerate(frames):
        as_frame(frame, number, len(frames[0]))
    stacked = np.stack(frames)
    vertices = stacked.shape[1]
    check_faces(triangles, vertices)
    given, _keep = o.importance_struct(o.as_importance(importance) or o.Importance())
    costs, flags = np.zeros(vertices), np.zeros(vertices, np.uint8)
    text = ctypes.create_string_buffer(1024)
    code = lib.tvg_measure(
        vertices,
        triangles.ctypes.data,
        len(triangles),
        stacked.ctypes.data,
        len(stacked),
        ctypes.byref(given),
        costs.ctypes.data,
        flags.ctypes.data,
        text,
        len(text),
    )
    _check(code, text.value.decode("utf-8", "replace"))
    return Measure(costs, flags.view(np.bool_))


def _plain(frames: Any) -> Iterable[Any]:
    if isinstance(frames, np.ndarray) and frames.ndim != 3:
        raise ValueError(f"positions have the shape {frames.shape}: they are [frame, vertex, 3]")
    return (frame.positions if isinstance(frame, Frame) else frame for frame in frames)


def _check(code: int, text: str) -> None:
    if code != 0:
        raise input_error(code, text)
