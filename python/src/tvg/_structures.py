"""The structures of tvg.h, tvg_encoder.h, tvg_properties.h and tvg_measure.h, member by member."""
from __future__ import annotations

import ctypes
from ctypes import c_char_p, c_double, c_int, c_size_t, c_uint16, c_uint32, c_uint64, c_void_p
from typing import Any, Type, TypeVar

UNKNOWN = 0xFFFFFFFFFFFFFFFF
EXACT_BITS = 32
TAIL_BYTES = 28


class Limits(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_uint32),
        ("faces", c_uint32),
        ("frames_per_gop", c_uint32),
        ("packet_bytes", c_uint32),
        ("memory_bytes", c_uint64),
        ("meshes", c_uint32),
        ("mesh_bytes", c_uint32),
        ("plan_bytes", c_uint32),
        ("components", c_uint32),
        ("plans", c_uint32),
        ("property_bytes", c_uint32),
    ]


class StreamInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("format_major", c_uint16),
        ("format_minor", c_uint16),
        ("vertices", c_uint32),
        ("faces", c_uint32),
        ("frames_per_gop", c_uint32),
        ("memory_bytes", c_uint64),
        ("frame_count", c_uint64),
        ("meshes", c_uint32),
    ]


class MeshInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertex_count", c_uint32),
        ("face_count", c_uint32),
        ("faces", ctypes.POINTER(c_uint32)),
        ("lod_count", c_uint32),
        ("lod", c_uint32),
    ]


class GopInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("first_frame", c_uint64),
        ("source_frame", c_uint64),
        ("frame_count", c_uint32),
        ("important_vertices", c_uint32),
        ("fine_step", c_double),
        ("coarse_step", c_double),
        ("mode", c_uint32),
        ("components", c_uint32),
    ]


class FrameInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("number", c_uint64),
        ("packet_bytes", c_uint64),
        ("predictor", c_uint32),
    ]


class DamageInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("first_frame", c_uint64),
        ("frame_count", c_uint64),
        ("code", c_int),
        ("byte_offset", c_uint64),
        ("text", c_char_p),
    ]


class PropertiesInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("attribute_count", c_uint32),
        ("part_count", c_uint32),
        ("polygon_count", c_uint32),
    ]


class AttributeInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("kind", c_uint32),
        ("domain", c_uint32),
        ("components", c_uint32),
        ("bits", c_uint32),
        ("animated", c_uint32),
        ("value_count", c_uint32),
    ]


class PartInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("object", c_char_p),
        ("group", c_char_p),
        ("material", c_char_p),
    ]


class DataInfo(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("size", c_uint64),
        ("encoding", c_uint32),
        ("packed", c_void_p),
        ("packed_size", c_uint64),
    ]


class AttributeGiven(ctypes.Structure):
    """tvg_attribute."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("kind", c_uint32),
        ("domain", c_uint32),
        ("components", c_uint32),
        ("bits", c_uint32),
        ("values", c_void_p),
        ("stride", c_size_t),
        ("value_count", c_uint32),
        ("corners", c_void_p),
        ("corner_count", c_size_t),
        ("animated", c_uint32),
    ]


class EncoderOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("fine_bits", c_uint32),
        ("coarse_bits", c_uint32),
        ("step", c_double),
        ("important_share", c_double),
        ("predictor", c_uint32),
        ("gop_frames", c_uint32),
        ("threads", c_uint32),
        ("reorder", c_uint32),
        ("low_delay", c_uint32),
        ("max_vertices", c_uint32),
        ("max_faces", c_uint32),
        ("first_frame", c_uint64),
        ("has_box", c_uint32),
        ("box_low", c_double * 3),
        ("box_high", c_double * 3),
        ("max_meshes", c_uint32),
        ("mode", c_uint32),
        ("period_frames", c_uint32),
        ("effort", c_uint32),
        ("max_error", c_double),
        ("texcoord_bits", c_uint32),
        ("normal_bits", c_uint32),
        ("colour_bits", c_uint32),
        ("generic_bits", c_uint32),
        ("max_property_bytes", c_uint32),
        ("max_animated_frame_bytes", c_uint32),
    ]


class EncodeReport(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("frames", c_uint64),
        ("gops", c_uint64),
        ("bytes", c_uint64),
        ("largest_error", c_double),
    ]


class Criterion(ctypes.Structure):
    _fields_ = [("name", c_char_p), ("weight", c_double)]


class Importance(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("criteria", ctypes.POINTER(Criterion)),
        ("criterion_count", c_size_t),
        ("share", c_double),
        ("has_threshold", c_uint32),
        ("threshold", c_double),
        ("smoothing", c_uint32),
        ("curvature_alpha", c_double),
        ("viewpoint", c_double * 3),
        ("weights", c_void_p),
        ("weight_count", c_size_t),
        ("low_delay", c_uint32),
    ]


class ComparisonReport(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("frames", c_uint64),
        ("extent", c_double),
        ("diagonal", c_double),
        ("max_coordinate_error", c_double),
        ("rms_coordinate_error", c_double),
        ("mean_coordinate_error", c_double),
        ("max_vertex_distance", c_double),
        ("rms_vertex_distance", c_double),
        ("worst_frame", c_uint64),
        ("worst_vertex", c_uint32),
        ("snr_db", c_double),
        ("kg_percent", c_double),
        ("mean_quadric_error", c_double),
        ("max_quadric_error", c_double),
        ("sted", c_double),
        ("sted_spatial", c_double),
        ("sted_temporal", c_double),
        ("hausdorff_frames", c_uint64),
        ("hausdorff", c_double),
    ]


class StreamBytes(ctypes.Structure):
    _fields_ = [("bytes", c_void_p), ("size", c_size_t)]


Structure = TypeVar("Structure", bound=ctypes.Structure)


def sized(structure: Type[Structure], /, **members: Any) -> Structure:
    """A structure whose struct_size is set, as every call asks for."""
    return structure(struct_size=ctypes.sizeof(structure), **members)
