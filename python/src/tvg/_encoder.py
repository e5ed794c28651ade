"""The encoder of the C interface, with exceptions and numpy arrays."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, List, Mapping, Optional, Sequence

import numpy as np

from . import _options as o
from . import _structures as s
from ._library import SINK, encoder_library
from ._mesh_input import Item
from .errors import input_error
from .model import DOMAINS, KINDS, Attribute, Floats, Mesh, same_mesh


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


class Sink:
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


class Encoder:
    """tvg_encoder: errors become exceptions, meshes are set where they change."""

    def __init__(self, options: s.EncoderOptions, write: Callable[[bytes], Any]) -> None:
        self._lib = encoder_library()
        self._sink = Sink(write)
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
        faces = np.ascontiguousarray(mesh.faces, dtype=np.uint32)
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


def join(streams: Sequence[bytes]) -> bytes:
    """One stream of several, at the borders of their groups of frames and without decoding.

    >>> one = tvg.encode(np.zeros((2, 3, 3)), [[0, 1, 2]])
    >>> len(tvg.open(tvg.join([one, one])))
    4
    """
    lib = encoder_library()
    pieces: List[bytes] = []
    sink = Sink(pieces.append)
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
