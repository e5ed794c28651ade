"""Finds libtvg and says what its functions take."""
from __future__ import annotations

import ctypes
import ctypes.util
import os
import pathlib
import sys
from ctypes import POINTER, c_char_p, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any, Iterator, Optional, Sequence

from . import _structures as s

# What the package is written for: before 1.0 a minor version may change the interface.
HEADER_VERSION = (0, 2)

SINK = ctypes.CFUNCTYPE(c_int, c_void_p, c_void_p, c_size_t)

_NAMES = {"win32": ("tvg.dll", "libtvg.dll"), "darwin": ("libtvg.dylib",)}
_PLAIN_NAMES = ("libtvg.so.0.2", "libtvg.so")

_PROTOTYPES: "dict[str, tuple[Any, Sequence[Any]]]" = {
    "tvg_version": (c_uint32, []),
    "tvg_code_name": (c_char_p, [c_int]),
    "tvg_limits_init": (c_int, [POINTER(s.Limits)]),
    "tvg_decoder_create": (c_void_p, [POINTER(s.Limits)]),
    "tvg_decoder_destroy": (None, [c_void_p]),
    "tvg_decoder_push": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_decoder_finish": (c_int, [c_void_p]),
    "tvg_decoder_poll": (c_int, [c_void_p]),
    "tvg_decoder_get_stream": (c_int, [c_void_p, POINTER(s.StreamInfo)]),
    "tvg_decoder_metadata": (c_char_p, [c_void_p, c_char_p]),
    "tvg_decoder_metadata_key": (c_char_p, [c_void_p, c_size_t]),
    "tvg_decoder_get_mesh": (c_int, [c_void_p, POINTER(s.MeshInfo)]),
    "tvg_decoder_get_gop": (c_int, [c_void_p, POINTER(s.GopInfo)]),
    "tvg_decoder_copy_flags": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_decoder_get_frame": (c_int, [c_void_p, POINTER(s.FrameInfo)]),
    "tvg_decoder_copy_positions": (c_int, [c_void_p, c_void_p, c_size_t, c_size_t]),
    "tvg_decoder_compute_normals": (c_int, [c_void_p, c_void_p, c_size_t, c_size_t]),
    "tvg_decoder_get_damage": (c_int, [c_void_p, POINTER(s.DamageInfo)]),
    "tvg_locate_index": (c_int, [c_char_p, c_size_t, c_uint64, POINTER(c_uint64), POINTER(c_uint64)]),
    "tvg_decoder_load_index": (c_int, [c_void_p, c_char_p, c_size_t]),
    "tvg_decoder_seek": (c_int, [c_void_p, c_uint64, POINTER(c_uint64)]),
    "tvg_decoder_skip": (c_uint64, [c_void_p]),
    "tvg_decoder_use_components": (c_int, [c_void_p, c_uint32]),
    "tvg_decoder_use_lod": (c_int, [c_void_p, c_uint32]),
    "tvg_decoder_error_text": (c_char_p, [c_void_p]),
    "tvg_decoder_error_code": (c_int, [c_void_p]),
    "tvg_decoder_get_properties": (c_int, [c_void_p, POINTER(s.PropertiesInfo)]),
    "tvg_decoder_get_attribute": (c_int, [c_void_p, c_uint32, POINTER(s.AttributeInfo)]),
    "tvg_decoder_copy_attribute": (c_int, [c_void_p, c_uint32, c_void_p, c_size_t, c_size_t]),
    "tvg_decoder_copy_corners": (c_int, [c_void_p, c_uint32, c_void_p, c_size_t]),
    "tvg_decoder_get_part": (c_int, [c_void_p, c_uint32, POINTER(s.PartInfo)]),
    "tvg_decoder_copy_face_parts": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_decoder_copy_polygons": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_decoder_get_data": (c_int, [c_void_p, POINTER(s.DataInfo)]),
    "tvg_decoder_copy_data": (c_int, [c_void_p, c_void_p, c_size_t]),
}

# A library built with TVG_BUILD_ENCODER=OFF has none of these.
_ENCODER_PROTOTYPES: "dict[str, tuple[Any, Sequence[Any]]]" = {
    "tvg_encoder_options_init": (c_int, [POINTER(s.EncoderOptions)]),
    "tvg_encoder_create": (c_int, [POINTER(s.EncoderOptions), SINK, c_void_p, POINTER(c_void_p)]),
    "tvg_encoder_destroy": (None, [c_void_p]),
    "tvg_encoder_set_metadata": (c_int, [c_void_p, c_char_p, c_char_p]),
    "tvg_encoder_set_mesh": (c_int, [c_void_p, c_uint32, c_void_p, c_uint32]),
    "tvg_encoder_add_frame": (c_int, [c_void_p, c_void_p, c_size_t, c_size_t]),
    "tvg_encoder_finish": (c_int, [c_void_p, POINTER(s.EncodeReport)]),
    "tvg_encoder_error_text": (c_char_p, [c_void_p]),
    "tvg_encoder_add_attribute": (c_int, [c_void_p, POINTER(s.AttributeGiven)]),
    "tvg_encoder_set_values": (c_int, [c_void_p, c_uint32, c_void_p, c_uint32, c_size_t]),
    "tvg_encoder_add_part": (c_int, [c_void_p, POINTER(s.PartInfo)]),
    "tvg_encoder_set_face_parts": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_encoder_set_polygons": (c_int, [c_void_p, c_void_p, c_size_t]),
    "tvg_encoder_clear_properties": (c_int, [c_void_p]),
    "tvg_encoder_add_data": (c_int, [c_void_p, c_char_p, c_char_p, c_size_t]),
    "tvg_encoder_set_importance": (c_int, [c_void_p, POINTER(s.Importance)]),
    "tvg_importance_init": (c_int, [POINTER(s.Importance)]),
    "tvg_criterion_name": (c_char_p, [c_size_t]),
    "tvg_criterion_description": (c_char_p, [c_size_t]),
    "tvg_measure": (
        c_int,
        [
            c_uint32,
            c_void_p,
            c_uint32,
            c_void_p,
            c_size_t,
            POINTER(s.Importance),
            c_void_p,
            c_void_p,
            c_char_p,
        ]
        + [c_size_t],
    ),
    "tvg_comparer_create": (c_int, [c_uint32, c_void_p, c_uint32, POINTER(c_void_p)]),
    "tvg_comparer_destroy": (None, [c_void_p]),
    "tvg_comparer_use_hausdorff": (c_int, [c_void_p, c_uint32]),
    "tvg_comparer_add_frame": (c_int, [c_void_p, c_void_p, c_void_p, c_size_t]),
    "tvg_comparer_get_report": (c_int, [c_void_p, POINTER(s.ComparisonReport)]),
    "tvg_join": (
        c_int,
        [POINTER(s.StreamBytes), c_size_t, SINK, c_void_p, POINTER(s.EncodeReport), c_char_p, c_size_t],
    ),
}


def _candidates() -> Iterator[str]:
    """Where the library may be, in the order in which that is tried."""
    named = os.environ.get("TVG_LIBRARY")
    if named:
        yield named
        return
    names = _NAMES.get(sys.platform, _PLAIN_NAMES)
    beside = pathlib.Path(__file__).parent
    for name in names:
        if (beside / name).exists():
            yield str(beside / name)
    yield from names
    found = ctypes.util.find_library("tvg")
    if found:
        yield found


def _load() -> Any:
    tried = []
    for path in _candidates():
        try:
            library = ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{path}: {error}")
            continue
        _declare(library)
        return library
    raise ImportError(
        "libtvg was not found. Set TVG_LIBRARY to the library (build/release/libcodec/libtvg.so of a build), or "
        "install it for the system (cmake --install build/release && ldconfig). Tried: " + "; ".join(tried)
    )


def _declare(library: Any) -> None:
    try:
        library.tvg_version.restype = c_uint32
        number = int(library.tvg_version())
    except AttributeError:
        raise ImportError(f"{library._name} is no libtvg: it has no tvg_version") from None
    version = (number >> 16, number >> 8 & 255)
    if version != HEADER_VERSION:
        raise ImportError(
            f"{library._name} has version {version[0]}.{version[1]} of the interface, and this package is for "
            f"{HEADER_VERSION[0]}.{HEADER_VERSION[1]}: install the two that belong together"
        )
    for prototypes, needed in ((_PROTOTYPES, True), (_ENCODER_PROTOTYPES, False)):
        for name, (result, arguments) in prototypes.items():
            function = getattr(library, name, None)
            if function is None:
                if needed:
                    raise ImportError(f"{library._name} lacks {name}: it is older than this package")
                continue
            function.restype, function.argtypes = result, arguments


_loaded: Optional[Any] = None


def library() -> Any:
    """The library, loaded once."""
    global _loaded
    if _loaded is None:
        _loaded = _load()
    return _loaded


def encoder_library() -> Any:
    """The library, where it encodes."""
    lib = library()
    for name in ("tvg_encoder_create", "tvg_measure"):
        if not hasattr(lib, name):
            raise ImportError(f"{lib._name} lacks {name}: it only decodes, or is older than this package")
    return lib


def version() -> str:
    """The version of the library in use: "0.2.0".

    >>> tvg.version().count(".")
    2
    """
    number = int(library().tvg_version())
    return f"{number >> 16}.{number >> 8 & 255}.{number & 255}"
