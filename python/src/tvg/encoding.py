"""Making streams."""
from __future__ import annotations

import ctypes
import os
import tempfile
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, BinaryIO, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union
from typing import overload

import numpy as np
import numpy.typing as npt

from . import _options as o
from . import _structures as s
from ._arrays import bounding_box
from ._library import SINK, encoder_library
from ._mesh_input import AttributeLike, GivenFrames, Item, PlainFrames
from .clip import Clip, Frames
from .errors import Code, Error, input_error
from .model import DOMAINS, KINDS, Attribute, Floats, Frame, Mesh, Part, same_mesh

Positions = Union[npt.ArrayLike, Iterable[npt.ArrayLike], Iterable[Frame]]
Target = Union[str, "os.PathLike[str]", BinaryIO]
Box = Tuple[Sequence[float], Sequence[float]]
_LIMITS = {
    "vertices": "max_vertices",
    "faces": "max_faces",
    "meshes": "max_meshes",
    "property_bytes": "max_property_bytes",
    "animated_frame_bytes": "max_animated_frame_bytes",
}


@dataclass(frozen=True)
class Report:
    """What was encoded.

    Attributes:
        frames, gops: how many.
        bytes: of the whole stream.
        largest_error: in mode basis, of a coordinate, in the mesh's units; 0 in others.
    """

    frames: int
    gops: int
    bytes: int
    largest_error: float


class _Sink:
    """Hands bytes on to `write`; what that raises is kept until the library has returned."""

    def __init__(self, write: Callable[[bytes], Any]) -> None:
        self._write = write
        self.error: Optional[BaseException] = None
        self.callback = SINK(self._take)

    def _take(self, user: Any, address: int, size: int) -> int:
        try:
            rest = ctypes.string_at(address, size)
            while rest:
                written = self._write(rest)
                if written is None or not 0 < written < len(rest):
                    break  # most files take all; raw ones may take less
                rest = rest[written:]
            return 0
        except BaseException as error:  # noqa: B902: also what is no Exception has to wait
            self.error = error
            return 1


class _Encoder:
    """tvg_encoder: errors become exceptions, meshes are set where they change."""

    def __init__(self, options: s.EncoderOptions, write: Callable[[bytes], Any]) -> None:
        self._lib = encoder_library()
        self._sink = _Sink(write)
        self._handle = ctypes.c_void_p()
        code = self._lib.tvg_encoder_create(
            ctypes.byref(options), self._sink.callback, None, ctypes.byref(self._handle)
        )
        if code != 0:
            raise input_error(code, "an encoder cannot be made")
        self._mesh: Optional[Mesh] = None

    def close(self) -> None:
        handle, self._handle = self._handle, ctypes.c_void_p()
        self._lib.tvg_encoder_destroy(handle)
        del self._sink.callback  # it refers to the sink that owns it

    def set_importance(self, importance: o.Importance) -> None:
        given, _keep = o.importance_struct(importance)
        self._check(self._lib.tvg_encoder_set_importance(self._handle, ctypes.byref(given)))

    def set_texts(self, metadata: Mapping[str, str], data: Mapping[str, bytes]) -> None:
        for key, value in metadata.items():
            self._check(self._lib.tvg_encoder_set_metadata(self._handle, key.encode(), value.encode()))
        for name, content in data.items():
            blob = bytes(content)
            self._check(self._lib.tvg_encoder_add_data(self._handle, name.encode(), blob, len(blob)))

    def add(self, item: Item) -> None:
        positions, mesh, values = item
        if mesh is not self._mesh:
            if self._mesh is None or not same_mesh(mesh, self._mesh):
                self._set_mesh(mesh, values)
            self._mesh = mesh
        for number, key in enumerate(mesh.attributes):
            if key in values:
                rows = np.ascontiguousarray(values[key], dtype=np.float32)
                self._check(
                    self._lib.tvg_encoder_set_values(
                        self._handle, number, rows.ctypes.data, len(rows), 4 * rows.shape[1]
                    )
                )
        self._check(
            self._lib.tvg_encoder_add_frame(self._handle, positions.ctypes.data, positions.nbytes, 12)
        )

    def finish(self) -> Report:
        report = s.sized(s.EncodeReport)
        self._check(self._lib.tvg_encoder_finish(self._handle, ctypes.byref(report)))
        return Report(report.frames, report.gops, report.bytes, report.largest_error)

    def _set_mesh(self, mesh: Mesh, values: Mapping[str, Floats]) -> None:
        for key, attribute in mesh.attributes.items():
            self._add_attribute(attribute, values.get(key))
        for part in mesh.parts:
            texts = (text.encode() for text in (part.object, part.group, part.material))
            given = s.sized(s.PartInfo, **dict(zip(("object", "group", "material"), texts)))
            self._check(self._lib.tvg_encoder_add_part(self._handle, ctypes.byref(given)))
        if mesh.face_parts is not None and len(mesh.face_parts) and mesh.parts:
            parts = np.ascontiguousarray(mesh.face_parts, dtype=np.uint32)
            self._check(self._lib.tvg_encoder_set_face_parts(self._handle, parts.ctypes.data, len(parts)))
        if mesh.polygons is not None and len(mesh.polygons):
            polygons = np.ascontiguousarray(mesh.polygons, dtype=np.uint32)
            self._check(self._lib.tvg_encoder_set_polygons(self._handle, polygons.ctypes.data, len(polygons)))
        faces = mesh.faces
        self._check(
            self._lib.tvg_encoder_set_mesh(self._handle, mesh.vertex_count, faces.ctypes.data, len(faces))
        )

    def _add_attribute(self, attribute: Attribute, values: Optional[Floats]) -> None:
        static = None if attribute.animated else attribute.values
        shown = values if attribute.animated else static
        if shown is None:
            raise ValueError(f"attribute {attribute.name!r} is animated, and the frame has no values of it")
        corners = None
        if attribute.corners is not None:
            corners = np.ascontiguousarray(attribute.corners, dtype=np.uint32)
        given = s.sized(
            s.AttributeGiven,
            name=attribute.name.encode(),
            kind=KINDS.index(attribute.kind),
            domain=DOMAINS.index(attribute.domain),
            components=shown.shape[1],
            bits=attribute.bits or 0,
            values=None if static is None else static.ctypes.data,
            value_count=len(shown),
            corners=None if corners is None else corners.ctypes.data,
            corner_count=0 if corners is None else corners.size,
            animated=int(attribute.animated),
        )
        self._check(self._lib.tvg_encoder_add_attribute(self._handle, ctypes.byref(given)))

    def _check(self, code: int) -> None:
        if self._sink.error is not None:
            error, self._sink.error = self._sink.error, None
            raise error
        if code != 0:
            raise input_error(code, self._lib.tvg_encoder_error_text(self._handle).decode("utf-8", "replace"))


@dataclass
class _Options:
    """What encode() was asked for, once it has been checked."""

    c: s.EncoderOptions
    max_error: Union[None, float, str]
    importance: Optional[o.Importance]
    period: Union[None, int, str]
    box: Optional[Box]

    def needs_box(self) -> bool:
        lossless = self.c.mode == 2
        return self.box is None and not lossless and (self.max_error is not None or self.c.step == 0)

    def complete(self, frames: Union[PlainFrames, GivenFrames], box: Optional[Box]) -> None:
        """Sets what only frames can tell, as `tvg encode` does with a source that it can read twice."""
        c = self.c
        lossless = c.mode == 2
        box = None if lossless else self.box if self.box is not None else box
        if box is not None:
            low, high = [[float(value) for value in corner] for corner in box]
            if len(low) != 3 or len(high) != 3 or not all(a <= b for a, b in zip(low, high)):
                raise ValueError(
                    f"box={box!r}: write its lowest and its highest corner, ((x, y, z), (x, y, z))"
                )
            if self.box is not None or self.max_error is not None or c.step == 0:
                c.has_box, c.box_low[:], c.box_high[:] = 1, low, high
        if self.max_error is not None:
            diagonal = None if box is None else float(np.linalg.norm(np.subtract(high, low)))
            bound = o.error_bound(self.max_error, diagonal)
            if box is not None:
                bound = o.resolve_error(bound, low, high)
                c.step = 2 * bound
            c.max_error = bound
        if c.mode == 1:
            most = o.PERIODS.get(c.effort, 128) if self.period is None else self._period_frames()
            count = frames.frame_count
            c.period_frames = most if count is None else max(1, min(count, most))
        elif self.period is not None:
            raise ValueError("period needs mode='basis', whose planes the frames of a period share")
        # What lies on the surface of a single frame is predicted from its shape.
        if frames.frame_count == 1 and frames.mesh.attributes and c.mode == 0 and c.predictor == 2:
            c.predictor = 3

    def _period_frames(self) -> int:
        return 65536 if self.period == "all" else o.whole("period", self.period, 1, 65536)


def _checked_options(
    bits: Optional[o.Pair],
    step: Optional[o.Steps],
    max_error: Union[None, float, str],
    lossless: bool,
    mode: str,
) -> "Tuple[s.EncoderOptions, Union[None, float, str]]":
    """Options with what there is to say of precision."""
    given = [
        name
        for name, value in (("bits", bits), ("step", step), ("max_error", max_error))
        if value is not None
    ]
    if len(given) > 1 or (lossless and given):
        names = " and ".join(given + (["lossless"] if lossless else []))
        raise ValueError(f"{names} exclude each other: each says how exact positions are")
    if mode not in ("elp", "basis"):
        raise ValueError(f"mode={mode!r}: write 'elp' or 'basis' (or lossless=True)")
    c = s.sized(s.EncoderOptions)
    encoder_library().tvg_encoder_options_init(ctypes.byref(c))
    c.mode = 2 if lossless else 1 if mode == "basis" else 0
    if bits is not None:
        c.fine_bits, c.coarse_bits = o.bits_pair(bits)
    if step is not None:
        c.step, shift = o.step_pair(step)
        c.fine_bits, c.coarse_bits = o.MOST_BITS, o.MOST_BITS - shift
    return c, max_error


@overload
def encode(positions: Positions, faces: Any = None, out: None = None, **options: Any) -> bytes:
    ...


@overload
def encode(positions: Positions, faces: Any, out: Target, **options: Any) -> Report:
    ...


@overload
def encode(positions: Positions, *, out: Target, **options: Any) -> Report:
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
            "meshes" (that a decoder keeps in case they come again), "property_bytes", "animated_frame_bytes".
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
    (b'\\x89TVG', True)
    """
    c, max_error = _checked_options(bits, step, max_error, lossless, mode)
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
        _Options(c, max_error, measure, period, box),
        attributes,
        parts,
        face_parts,
        polygons,
    )
    options = _Options(c, max_error, measure, period, box)
    options.complete(frames, box_of_frames)
    return _write(frames, options, texts, blobs, out, progress)


def _frames_of(
    positions: Any,
    faces: Any,
    options: _Options,
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
    options: _Options,
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
    options: _Options,
    texts: Mapping[str, str],
    blobs: Mapping[str, bytes],
    write: Callable[[bytes], Any],
    progress: Optional[Callable[[int, Optional[int]], None]],
) -> Report:
    encoder = _Encoder(options.c, write)
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


def join(streams: Sequence[bytes]) -> bytes:
    """One stream of several, at the borders of their groups of frames and without decoding.

    >>> one = tvg.encode(np.zeros((2, 3, 3)), [[0, 1, 2]])
    >>> len(tvg.open(tvg.join([one, one])))
    4
    """
    lib = encoder_library()
    pieces: List[bytes] = []
    sink = _Sink(pieces.append)
    held = [np.frombuffer(stream, dtype=np.uint8) for stream in streams]
    array = (s.StreamBytes * len(held))(*[s.StreamBytes(piece.ctypes.data, piece.nbytes) for piece in held])
    text = ctypes.create_string_buffer(1024)
    code = lib.tvg_join(array, len(held), sink.callback, None, None, text, len(text))
    del sink.callback
    if sink.error is not None:
        raise sink.error
    if code != 0:
        raise input_error(code, text.value.decode("utf-8", "replace") or "there is no stream to join")
    return b"".join(pieces)


__all__ = ["Code", "Error", "Report", "encode", "join"]
