"""A decoder with the bytes it reads: events of the C interface become meshes and frames."""
from __future__ import annotations

import ctypes
import warnings
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Mapping, Optional, Type

import numpy as np

from . import _structures as s
from ._library import library
from ._source import PIECE, ByteSource, address_of
from .errors import Code, Damage, DamageWarning, Error, code_of, error_of
from .model import DOMAINS, KINDS, MODES, PREDICTORS, Attribute, Attributes, Floats, Frame, Gop, Mesh, Part
from .model import same_mesh

(NEED_BYTES, HEAD, METADATA, MESH, GOP, FRAME, DAMAGE, END, ERROR, DATA) = range(10)


@dataclass
class Settings:
    """How to decode: what tvg.open() was given."""

    limits: Mapping[str, int] = field(default_factory=dict)
    on_damage: Optional[Callable[[Damage], None]] = None
    lod: int = 0
    components: Optional[int] = None
    normals: bool = False


class Reader:
    """Reads one source with one decoder; `mesh`, `gop`, `metadata` and `data` are what came last."""

    def __init__(self, source: ByteSource, settings: Settings) -> None:
        self._lib = library()
        self._source, self._settings = source, settings
        self._decoder = ctypes.c_void_p(self._lib.tvg_decoder_create(ctypes.byref(_limits(settings.limits))))
        if not self._decoder:
            raise Error(Code.OUT_OF_MEMORY, "there is no memory for a decoder")
        if settings.lod:
            self._lib.tvg_decoder_use_lod(self._decoder, settings.lod)
        if settings.components is not None:
            self._lib.tvg_decoder_use_components(self._decoder, settings.components)
        self._offset = 0
        self._at_head = True  # no frame has been asked for
        self._frame_info = s.sized(s.FrameInfo)
        self._frame_info_ref = ctypes.byref(self._frame_info)
        self.metadata: Dict[str, str] = {}
        self.data: Dict[str, bytes] = {}
        self.mesh: Optional[Mesh] = None
        self.gop: Optional[Gop] = None
        self.number: Optional[int] = None  # of the frame that is there now
        self.frame_count: Optional[int] = None
        self.last_damage: Optional[Damage] = None

    def close(self) -> None:
        """Gives the decoder's memory back; the source is somebody else's."""
        decoder, self._decoder = self._decoder, ctypes.c_void_p()
        self._lib.tvg_decoder_destroy(decoder)

    def __del__(self) -> None:
        if getattr(self, "_decoder", None):
            self.close()

    def read_head(self) -> None:
        """Reads on to the first mesh, and the index of a source that can be read anywhere."""
        while True:
            event = self._step()
            if event == HEAD and self._source.size is not None:
                self._load_index()
            if event in (MESH, END):
                return

    def begin_at(self, frame: int) -> None:
        """Makes the next frame that is decoded this one, or the first good one after it."""
        if frame > 0 or not self._at_head:
            self._seek(frame)

    def advance(self) -> bool:
        """Decodes the next frame; False at the end."""
        self._at_head = False
        while True:
            event = self._step()
            if event == FRAME:
                return True
            if event == END:
                return False

    def go_to(self, frame: int) -> None:
        """Decodes the frame of that number. An Error where it is lost."""
        gop, here = self.gop, self.number
        ahead = here is not None and (
            here <= frame <= here + 1
            or (gop is not None and here < frame < gop.first_frame + gop.frame_count)
        )
        self.last_damage = None
        if not ahead:
            self.begin_at(frame)
        while self.number is None or self.number < frame:
            if not self.advance():
                break
        if self.number != frame:
            damage = self.last_damage
            if damage is None:
                raise Error(Code.MALFORMED, f"frame {frame} is lost", None, frame)
            raise Error(damage.code, f"frame {frame} is lost: {damage.text}", damage.byte_offset, frame)

    def copy_positions(self, target: Floats) -> None:
        """The frame's positions into a C-contiguous float32 array [vertex, 3]."""
        code = self._lib.tvg_decoder_copy_positions(self._decoder, target.ctypes.data, target.nbytes, 12)
        _check(code, "the frame's positions cannot be copied")

    def vertex_count(self) -> int:
        """Of the mesh that is there."""
        return 0 if self.mesh is None else self.mesh.vertex_count

    def frame(self, buffer: Optional[Floats] = None) -> Frame:
        """The frame that is there now, in `buffer` where that fits, else in memory of its own."""
        mesh = self.mesh
        assert mesh is not None and self.number is not None
        if buffer is None or len(buffer) != mesh.vertex_count:
            buffer = np.empty((mesh.vertex_count, 3), np.float32)
        self.copy_positions(buffer)
        normals: Optional[Floats] = None
        if self._settings.normals:
            normals = np.empty_like(buffer)
            code = self._lib.tvg_decoder_compute_normals(
                self._decoder, normals.ctypes.data, normals.nbytes, 12
            )
            self._check(code)
        info = self._frame_info
        return Frame(
            buffer,
            mesh,
            self.number,
            self._attributes_now(mesh),
            normals,
            self.gop,
            info.packet_bytes,
            PREDICTORS.get(info.predictor, str(info.predictor)),
        )

    def _step(self) -> int:
        """The next event but NEED_BYTES, which is seen to. An Error where there is no way on."""
        self.number = None
        while True:
            event: int = self._lib.tvg_decoder_poll(self._decoder)
            if event == FRAME:
                self._lib.tvg_decoder_get_frame(self._decoder, self._frame_info_ref)
                self.number = self._frame_info.number
            elif event == NEED_BYTES:
                self._feed()
                continue
            elif event == METADATA:
                self._take_metadata()
            elif event == MESH:
                self._take_mesh()
            elif event == GOP:
                self._take_gop()
            elif event == DAMAGE:
                self._take_damage()
            elif event == DATA:
                self._take_data()
            elif event == ERROR:
                raise self._error()
            return event

    def _feed(self) -> None:
        if self._source.size is not None:
            self._offset += self._lib.tvg_decoder_skip(self._decoder)
        piece = self._source.read(self._offset, PIECE)
        if piece is None:
            raise BlockingIOError("the file does not block: tvg reads what waits for its bytes")
        if len(piece) == 0:
            self._lib.tvg_decoder_finish(self._decoder)
            return
        address, size, _keep = address_of(piece)
        self._check(self._lib.tvg_decoder_push(self._decoder, address, size))
        self._offset += size

    def _seek(self, frame: int) -> None:
        offset = ctypes.c_uint64()
        self._check(self._lib.tvg_decoder_seek(self._decoder, frame, ctypes.byref(offset)))
        self._offset = offset.value
        self._at_head = False
        self.gop = self.number = None

    def _load_index(self) -> None:
        size = self._source.size
        assert size is not None
        if size < s.TAIL_BYTES:
            return
        tail = bytes(self._source.read(size - s.TAIL_BYTES, s.TAIL_BYTES))
        at, count = ctypes.c_uint64(), ctypes.c_uint64()
        found = self._lib.tvg_locate_index(tail, len(tail), size, ctypes.byref(at), ctypes.byref(count))
        if found != 0:
            return
        index = bytes(self._source.read(at.value, count.value))
        if self._lib.tvg_decoder_load_index(self._decoder, index, len(index)) != 0:
            return  # as if there were none: the decoder reports it where it comes to it
        info = s.sized(s.StreamInfo)
        self._lib.tvg_decoder_get_stream(self._decoder, ctypes.byref(info))
        # An index that lies is found out where frames are read; until then no list is made as long as it says.
        if info.frame_count <= size:
            self.frame_count = info.frame_count

    def _take_metadata(self) -> None:
        self.metadata = {}
        while True:
            key = self._lib.tvg_decoder_metadata_key(self._decoder, len(self.metadata))
            if key is None:
                return
            value = self._lib.tvg_decoder_metadata(self._decoder, key)
            self.metadata[_text(key)] = _text(value)

    def _take_mesh(self) -> None:
        mesh = self._read_mesh()
        self.gop = None
        # One that comes again, as after a seek, stays the same object.
        if self.mesh is None or not same_mesh(self.mesh, mesh):
            self.mesh = mesh

    def _read_mesh(self) -> Mesh:
        info = s.sized(s.MeshInfo)
        self._check(self._lib.tvg_decoder_get_mesh(self._decoder, ctypes.byref(info)))
        faces = np.zeros((info.face_count, 3), np.uint32)
        if info.face_count:
            faces[...] = np.ctypeslib.as_array(info.faces, shape=(info.face_count, 3))
        mesh = Mesh(faces, info.vertex_count, lods=info.lod_count)
        properties = s.sized(s.PropertiesInfo)
        if self._lib.tvg_decoder_get_properties(self._decoder, ctypes.byref(properties)) != 0:
            return mesh
        mesh.attributes = Attributes(
            [self._read_attribute(i, len(faces)) for i in range(properties.attribute_count)]
        )
        mesh.parts = [self._read_part(i) for i in range(properties.part_count)]
        if mesh.parts:
            mesh.face_parts = np.empty(len(faces), np.uint32)
            self._lib.tvg_decoder_copy_face_parts(self._decoder, mesh.face_parts.ctypes.data, len(faces))
        if properties.polygon_count:
            mesh.polygons = np.empty((properties.polygon_count, 2), np.uint32)
            self._lib.tvg_decoder_copy_polygons(
                self._decoder, mesh.polygons.ctypes.data, properties.polygon_count
            )
        return mesh

    def _read_attribute(self, number: int, face_count: int) -> Attribute:
        info = self._attribute_info(number)
        domain, animated = DOMAINS[info.domain], bool(info.animated)
        corners = None
        if domain == "corner":
            corners = np.empty((face_count, 3), np.uint32)
            self._check(
                self._lib.tvg_decoder_copy_corners(self._decoder, number, corners.ctypes.data, corners.size)
            )
        values = None if animated else self._values(number, info)
        return Attribute(
            values, KINDS[info.kind], domain, corners, info.bits, animated, _text(info.name), info.components
        )

    def _attribute_info(self, number: int) -> Any:
        info = s.sized(s.AttributeInfo)
        self._check(self._lib.tvg_decoder_get_attribute(self._decoder, number, ctypes.byref(info)))
        return info

    def _values(self, number: int, info: Any) -> Floats:
        values = np.empty((info.value_count, info.components), np.float32)
        self._check(
            self._lib.tvg_decoder_copy_attribute(
                self._decoder, number, values.ctypes.data, values.nbytes, 4 * info.components
            )
        )
        return values

    def _attributes_now(self, mesh: Mesh) -> Attributes:
        """Those of the mesh, with the values of the frame where they are animated."""
        attributes = list(mesh.attributes.values())
        if not any(attribute.animated for attribute in attributes):
            return mesh.attributes
        for number, attribute in enumerate(attributes):
            if attribute.animated:
                attributes[number] = Attribute(
                    self._values(number, self._attribute_info(number)),
                    attribute.kind,
                    attribute.domain,
                    attribute.corners,
                    attribute.bits,
                    name=attribute.name,
                )
        return Attributes(attributes)

    def _read_part(self, number: int) -> Part:
        info = s.sized(s.PartInfo)
        self._check(self._lib.tvg_decoder_get_part(self._decoder, number, ctypes.byref(info)))
        return Part(_text(info.object), _text(info.group), _text(info.material))

    def _take_gop(self) -> None:
        info = s.sized(s.GopInfo)
        self._check(self._lib.tvg_decoder_get_gop(self._decoder, ctypes.byref(info)))
        flags = np.zeros(self.vertex_count(), np.uint8)
        if len(flags):
            self._lib.tvg_decoder_copy_flags(self._decoder, flags.ctypes.data, flags.nbytes)
        important = flags.view(np.bool_)
        important.flags.writeable = False
        mode = MODES[info.mode] if info.mode < len(MODES) else str(info.mode)
        self.gop = Gop(
            info.first_frame,
            info.source_frame,
            info.frame_count,
            mode,
            info.fine_step,
            info.coarse_step,
            info.components,
            important,
        )

    def _take_damage(self) -> None:
        info = s.sized(s.DamageInfo)
        self._check(self._lib.tvg_decoder_get_damage(self._decoder, ctypes.byref(info)))
        offset = None if info.byte_offset == s.UNKNOWN else info.byte_offset
        damage = Damage(code_of(info.code), _text(info.text), info.first_frame, info.frame_count, offset)
        self.last_damage = damage
        if self._settings.on_damage is not None:
            self._settings.on_damage(damage)
        else:
            warnings.warn(DamageWarning(damage), stacklevel=6)

    def _take_data(self) -> None:
        info = s.sized(s.DataInfo)
        self._check(self._lib.tvg_decoder_get_data(self._decoder, ctypes.byref(info)))
        target = np.empty(info.size, np.uint8)
        if self._lib.tvg_decoder_copy_data(self._decoder, target.ctypes.data, target.nbytes) == 0:
            self.data[_text(info.name)] = target.tobytes()

    def _error(self) -> Error:
        text = _text(self._lib.tvg_decoder_error_text(self._decoder))
        return error_of(self._lib.tvg_decoder_error_code(self._decoder), text)

    def _check(self, code: int) -> None:
        if code != 0:
            raise error_of(code, _text(self._lib.tvg_decoder_error_text(self._decoder)))


def _limits(given: Mapping[str, int]) -> s.Limits:
    limits = s.sized(s.Limits)
    library().tvg_limits_init(ctypes.byref(limits))
    names: List[str] = [name for name, _ in s.Limits._fields_[1:]]
    most: Dict[str, int] = {name: 2 ** (8 * ctypes.sizeof(kind)) - 1 for name, kind in s.Limits._fields_[1:]}
    for name, value in given.items():
        if name not in names:
            raise ValueError(f"limits: there is no {name!r}; they are {', '.join(names)}")
        if not 0 <= int(value) <= most[name]:
            raise ValueError(f"limits: {name} is {value}: write a number from 0 to {most[name]}")
        setattr(limits, name, int(value))
    return limits


def _check(code: int, what: str, kind: Type[Error] = Error) -> None:
    if code != 0:
        raise error_of(code, what, kind)


def _text(text: Optional[bytes]) -> str:
    return "" if text is None else text.decode("utf-8", "replace")
