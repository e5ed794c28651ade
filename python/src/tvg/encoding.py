"""Making streams."""
from __future__ import annotations

import os
import tempfile
from fractions import Fraction
from typing import Any, BinaryIO, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union
from typing import overload

import numpy as np
import numpy.typing as npt

from . import _options as o
from ._arrays import bounding_box
from ._encoder import Encoder, Report
from ._mesh_input import AttributeLike, GivenFrames, PlainFrames
from ._request import Box, Request, checked_options
from .clip import Clip, Frames
from .model import Frame, Part

Positions = Union[npt.ArrayLike, Iterable[npt.ArrayLike], Iterable[Frame]]
Target = Union[str, "os.PathLike[str]", BinaryIO]
_LIMITS = {
    "vertices": "max_vertices",
    "faces": "max_faces",
    "meshes": "max_meshes",
    "property_bytes": "max_property_bytes",
    "animated_frame_bytes": "max_animated_frame_bytes",
}


@overload  # Without `out`, the first of the two is meant.
def encode(  # type: ignore[misc]
    positions: Positions,
    faces: Any = ...,
    out: None = ...,
    *,
    bits: Optional[o.Pair] = ...,
    step: Optional[o.Steps] = ...,
    max_error: Union[None, float, str] = ...,
    lossless: bool = ...,
    mode: str = ...,
    predictor: str = ...,
    fps: Union[None, int, float, str, Fraction] = ...,
    gop: Optional[int] = ...,
    period: Union[None, int, str] = ...,
    effort: int = ...,
    importance: o.ImportanceLike = ...,
    attributes: Optional[Mapping[str, AttributeLike]] = ...,
    parts: Optional[Sequence[Part]] = ...,
    face_parts: Optional[npt.ArrayLike] = ...,
    polygons: Optional[npt.ArrayLike] = ...,
    metadata: Optional[Mapping[str, Any]] = ...,
    data: Optional[Mapping[str, bytes]] = ...,
    threads: Optional[int] = ...,
    box: Optional[Box] = ...,
    reorder: bool = ...,
    limits: Optional[Mapping[str, int]] = ...,
    first_frame: int = ...,
    progress: Optional[Callable[[int, Optional[int]], None]] = ...,
) -> bytes:
    ...


@overload
def encode(
    positions: Positions,
    faces: Any = ...,
    out: Target = ...,
    *,
    bits: Optional[o.Pair] = ...,
    step: Optional[o.Steps] = ...,
    max_error: Union[None, float, str] = ...,
    lossless: bool = ...,
    mode: str = ...,
    predictor: str = ...,
    fps: Union[None, int, float, str, Fraction] = ...,
    gop: Optional[int] = ...,
    period: Union[None, int, str] = ...,
    effort: int = ...,
    importance: o.ImportanceLike = ...,
    attributes: Optional[Mapping[str, AttributeLike]] = ...,
    parts: Optional[Sequence[Part]] = ...,
    face_parts: Optional[npt.ArrayLike] = ...,
    polygons: Optional[npt.ArrayLike] = ...,
    metadata: Optional[Mapping[str, Any]] = ...,
    data: Optional[Mapping[str, bytes]] = ...,
    threads: Optional[int] = ...,
    box: Optional[Box] = ...,
    reorder: bool = ...,
    limits: Optional[Mapping[str, int]] = ...,
    first_frame: int = ...,
    progress: Optional[Callable[[int, Optional[int]], None]] = ...,
) -> Report:
    ...


def encode(
    positions: Positions,
    faces: Any = None,
    out: Optional[Target] = None,
    *,
    bits: Optional[o.Pair] = None,
    step: Optional[o.Steps] = None,
    max_error: Union[None, float, str] = None,
    lossless: bool = False,
    mode: str = "elp",
    predictor: str = "elp",
    fps: Union[None, int, float, str, Fraction] = None,
    gop: Optional[int] = None,
    period: Union[None, int, str] = None,
    effort: int = 5,
    importance: o.ImportanceLike = None,
    attributes: Optional[Mapping[str, AttributeLike]] = None,
    parts: Optional[Sequence[Part]] = None,
    face_parts: Optional[npt.ArrayLike] = None,
    polygons: Optional[npt.ArrayLike] = None,
    metadata: Optional[Mapping[str, Any]] = None,
    data: Optional[Mapping[str, bytes]] = None,
    threads: Optional[int] = None,
    box: Optional[Box] = None,
    reorder: bool = False,
    limits: Optional[Mapping[str, int]] = None,
    first_frame: int = 0,
    progress: Optional[Callable[[int, Optional[int]], None]] = None,
) -> Union[bytes, Report]:
    """Encodes an animation.

    Args:
        positions: [frame, vertex, 3] in the mesh's units, of any real type and layout (a memory map too; frames
            are taken one by one and become float32); or any iterable of [vertex, 3], which is gone through once
            and held a group of frames at a time; or an iterable of `Frame`s (a `Clip`), which bring their mesh.
        faces: [face, 3], vertex numbers counter-clockwise; or [face, N] of N corners each, which come back as
            triangles and polygons. Of `Frame`s, none.
        out: a path, which appears when it is whole; or a binary file object, which gets bytes as soon as a group
            of frames is complete. Unless given, the bytes are returned.
        bits: bits per coordinate (11 unless given), or of important vertices and of others ("13:11").
        step: instead, the edge of a lattice cell in the mesh's units, or two ("0.01:0.04").
        max_error: instead, what no coordinate may be off by more, in the mesh's units or as "0.05%" of the diagonal.
        lossless: instead, every bit of float32 comes back.
        mode: "elp", each frame from those before it; or "basis", sums of planes: far smaller, slower to make.
        predictor: "elp", "pyramid" (smaller, slower), "auto", "space" or "time".
        fps: frames per second, kept with the stream.
        gop: frames that can be decoded on their own; 50 unless given, 32 in mode basis.
        period: in mode basis, frames that share planes and are held in memory, or "all".
        effort: 1 (fast) to 9 (small): what mode basis tries.
        importance: which vertices get the finer of two lattices: an `Importance`, a share (0.35), criteria
            ("curv+0.5*velocity"), or a weight for each vertex, [vertex].
        attributes: by name: [vertex, N], [face, 3, N] (of each corner), [frame, vertex, N] (animated), or an
            `Attribute`. "uv", "normal" and "color" at the beginning of a name make its kind.
        parts, face_parts: what the faces belong to, and the number of the part of each, [face].
        polygons: [polygon, 2], first face and number of corners of faces that had more than three.
        metadata: texts by key: "name", "units" (length of one unit: "m", "cm"), "up" ("y", "z"), ...
        data: free-form bytes by name.
        threads: groups encoded at a time; one per processor unless given. The bytes do not depend on it.
        box: ((x, y, z), (x, y, z)) that all frames lie in: makes one lattice for frames that are gone through once.
        reorder: vertices may change their order, which saves bytes.
        limits: of the meshes to come, where frames are gone through once and their mesh grows: "vertices", "faces",
            "meshes" (that a decoder keeps in case they come again), "property_bytes" (`Mesh.property_bytes`),
            "animated_frame_bytes".
        first_frame: number of the first frame in a longer sequence.
        progress: called with the frames so far, and how many there are, or None.

    Returns:
        the stream; or, with `out`, a `Report`.

    Raises:
        ValueError: what was given cannot be encoded; the message says what, where, and what would be right.
            `InputError` where the library found it.
        Error, OSError: the stream could not be made or written.

    An array, a list and a clip are gone through twice, first for the box of all frames, as `tvg encode` does with
    files; the bytes are the same then.

    >>> ramp = np.linspace(0, 1, 10)[:, None, None] * np.ones((10, 3, 3)) * [[0, 0, 1]]
    >>> ramp[:, 1, 0] = ramp[:, 2, 1] = 1
    >>> stream = tvg.encode(ramp, [[0, 1, 2]], bits=12, fps=25)
    >>> stream[:4], bool(abs(tvg.decode(stream)[0] - ramp).max() <= 0.5 / 2**12)
    (b'\\x8bTVG', True)
    """
    c, max_error = checked_options(bits, step, max_error, lossless, mode)
    if predictor not in o.PREDICTOR_NUMBERS:
        raise ValueError(f"predictor={predictor!r}: write one of {', '.join(o.PREDICTOR_NUMBERS)}")
    c.predictor = o.PREDICTOR_NUMBERS[predictor]
    c.gop_frames = o.whole("gop", (32 if c.mode == 1 else 50) if gop is None else gop, 1, 65536)
    c.effort = o.whole("effort", effort, 1, 9)
    c.threads = o.thread_count(threads)
    c.reorder = bool(reorder)
    c.first_frame = o.whole("first_frame", first_frame, 0, 2**63)
    for name, value in (limits or {}).items():
        if name not in _LIMITS:
            raise ValueError(f"limits: there is no {name!r}; they are {', '.join(_LIMITS)}")
        setattr(c, _LIMITS[name], o.whole(f"limits[{name!r}]", value, 0, 2**32 - 1))
    measure = o.as_importance(importance)
    if measure is not None and c.fine_bits == c.coarse_bits:
        raise ValueError("importance needs two resolutions, for example bits='13:11'")
    texts = o.texts(metadata)
    if fps is not None:
        texts["fps"] = o.frame_rate(fps)
    blobs: Dict[str, bytes] = dict(data or {})
    if isinstance(positions, (Clip, Frames)):
        clip = positions._clip if isinstance(positions, Frames) else positions
        texts, blobs = {**clip.metadata, **texts}, {**clip.data, **blobs}
    frames, box_of_frames = _frames_of(
        positions,
        faces,
        Request(c, max_error, measure, period, box),
        attributes,
        parts,
        face_parts,
        polygons,
    )
    options = Request(c, max_error, measure, period, box)
    options.complete(frames, box_of_frames)
    return _write(frames, options, texts, blobs, out, progress)


def _frames_of(
    positions: Any,
    faces: Any,
    options: Request,
    attributes: Optional[Mapping[str, AttributeLike]],
    parts: Optional[Sequence[Part]],
    face_parts: Optional[npt.ArrayLike],
    polygons: Optional[npt.ArrayLike],
) -> "Tuple[Union[PlainFrames, GivenFrames], Optional[Box]]":
    """The frames, and their box where it is needed and they can be gone through twice."""
    if isinstance(positions, (bytes, str)):
        raise ValueError("positions are an array [frame, vertex, 3], not a stream: tvg.encode(tvg.open(...))")
    if hasattr(positions, "__array__") and not isinstance(positions, np.ndarray):
        positions = np.asarray(positions)
    if isinstance(positions, np.ndarray) and positions.ndim != 3:
        hint = "; one frame alone is positions[np.newaxis]" if positions.ndim == 2 else ""
        raise ValueError(f"positions have the shape {positions.shape}: they are [frame, vertex, 3]{hint}")
    if isinstance(positions, tuple):
        positions = list(positions)
    again = isinstance(positions, (list, np.ndarray, Frames)) or (
        isinstance(positions, Clip) and positions.seekable
    )
    frames = _take(positions, faces, attributes, parts, face_parts, polygons)
    if isinstance(positions, (Clip, Frames)) and again:
        frames.frame_count = len(positions)
    if again and isinstance(frames, GivenFrames):
        c = options.c
        for _, mesh, _values in frames:
            c.max_vertices = max(c.max_vertices, mesh.vertex_count)
            c.max_faces = max(c.max_faces, len(mesh.faces))
            c.max_property_bytes = max(c.max_property_bytes, mesh.property_bytes())
    box = bounding_box(frames.plain()) if again and options.needs_box() else None
    return frames, box


def _take(
    positions: Any,
    faces: Any,
    attributes: Optional[Mapping[str, AttributeLike]],
    parts: Optional[Sequence[Part]],
    face_parts: Optional[npt.ArrayLike],
    polygons: Optional[npt.ArrayLike],
) -> Union[PlainFrames, GivenFrames]:
    if isinstance(positions, (Clip, Frames)):
        own: Any = positions
        first: Any = Frame(
            np.zeros((0, 3), np.float32),
            positions.mesh if isinstance(positions, Clip) else positions._clip.mesh,
        )
    else:
        iterator = iter(positions)
        first = next(iterator, None)
        own = positions
        if iterator is positions:
            own = _chained(first, iterator)
    if not isinstance(first, Frame):
        if faces is None:
            raise ValueError("faces= are missing: [face, 3], vertex numbers counter-clockwise ([] for none)")
        return PlainFrames(own, faces, attributes, parts, face_parts, polygons)
    given = {
        "faces": faces,
        "attributes": attributes,
        "parts": parts,
        "face_parts": face_parts,
        "polygons": polygons,
    }
    surplus = [name for name, value in given.items() if value is not None]
    if surplus:
        raise ValueError(f"{surplus[0]}= is what the frames bring: they are tvg.Frames with a mesh")
    return GivenFrames(own, first)


def _chained(first: Any, rest: Iterable[Any]) -> Iterable[Any]:
    if first is not None:
        yield first
        yield from rest


def _write(
    frames: Union[PlainFrames, GivenFrames],
    options: Request,
    texts: Mapping[str, str],
    blobs: Mapping[str, bytes],
    out: Optional[Target],
    progress: Optional[Callable[[int, Optional[int]], None]],
) -> Union[bytes, Report]:
    """Encodes into what `out` is."""
    if out is None:
        pieces: List[bytes] = []
        _run(frames, options, texts, blobs, pieces.append, progress)
        return b"".join(pieces)
    if not isinstance(out, (str, os.PathLike)):
        if not hasattr(out, "write"):
            raise TypeError(f"out is a {type(out).__name__}: write a path, or a file object opened with 'wb'")
        return _run(frames, options, texts, blobs, out.write, progress)
    path = os.path.abspath(os.fspath(out))
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as device:  # a pipe or a device has no place for another file beside it
            return _run(frames, options, texts, blobs, device.write, progress)
    number, beside = tempfile.mkstemp(prefix=os.path.basename(path) + ".", dir=os.path.dirname(path))
    try:
        with os.fdopen(number, "wb") as file:
            report = _run(frames, options, texts, blobs, file.write, progress)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)
        os.replace(beside, path)
        return report
    except BaseException:
        os.unlink(beside)
        raise


def _run(
    frames: Union[PlainFrames, GivenFrames],
    options: Request,
    texts: Mapping[str, str],
    blobs: Mapping[str, bytes],
    write: Callable[[bytes], Any],
    progress: Optional[Callable[[int, Optional[int]], None]],
) -> Report:
    encoder = Encoder(options.c, write)
    try:
        if options.importance is not None:
            encoder.set_importance(options.importance)
        encoder.set_texts(texts, blobs)
        for count, item in enumerate(frames, 1):
            encoder.add(item)
            if progress is not None:
                progress(count, frames.frame_count)
        return encoder.finish()
    finally:
        encoder.close()
