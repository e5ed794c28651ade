"""Negative streams of mode lossless (§4.5.1, §7.9)."""
import tvg_reference as reference
import tvg_writer as writer
from negative_base import (FRAMES, MESH_ID, PLAN, PLANES_HEAD, at_meeting, packets_of, put_gop, put_named, recoded,
                           stream)
from negative_pyramid import MESH_ID as SHAPED_ID
from negative_pyramid import SHAPE, TURNS, of_shape
from tvg_reference import PYRAMID, SPACE

def choose(v, axis, rounded, line):
    return reference.clamp(rounded + 40 * v - 30 * axis, -1 - line.most, line.most)

def gop(header=None, fields=None, edit=None, choose_number=choose, predictor=PYRAMID):
    """The payload of a GOP of two frames, as negative_base.gop() makes those of mode elp."""
    frames = writer.LosslessWriter(TURNS, SHAPE, 0, 0, choose_number)
    *coded, digest = packets_of(frames, (PYRAMID, PYRAMID))
    packets = [(32 + predictor, content) for _, content in coded] + [digest]
    packets = edit(packets) if edit else packets
    values = {"mesh_id": SHAPED_ID, "first_frame": 2, "frame_count": 2, "packet_count": len(packets), "mode": 2,
              "fields": writer.lossless_fields(0, 0) if fields is None else fields} | (header or {})
    return writer.gop([(0, writer.gop_header(**values))] + packets)

def headers():
    def case(name, error, fields=None, section="4.5.1", **changed):
        return f"lossless_{name}", error, section, FRAMES - 2, of_shape(gop(fields=fields, **changed))

    fields = writer.lossless_fields
    cases = {"kind_unknown": fields(2, 0), "low_bits_many": fields(0, 24), "exponent_large": fields(1, 253),
             "fields_cut": fields(0, 0)[:-1], "fields_left_over": fields(0, 0) + b"\0",
             "channels_none": fields(0, 0, ()), "without_positions": fields(0, 0, (2,))}
    for name, data in cases.items():
        yield case(name, "malformed", data)
    yield case("channels_descend", "malformed", fields(0, 0, (1, 4, 2)), "3.5")
    yield case("channel_unknown", "unsupported", fields(0, 0, (1, 3)))
    yield case("predicted_by_space", "malformed", section="4.5.2", predictor=SPACE)
    yield ("lossless_without_shape", "malformed", "4.5.1", FRAMES - 2,
           stream(GOP1=put_gop(gop(header={"mesh_id": MESH_ID}))))
    planes = {"mesh_id": MESH_ID, "planes": (writer.checksum(PLAN),)}
    yield ("lossless_with_planes", "malformed", "4.5.1", FRAMES - 2,
           stream(before=("GOP1", put_named(b"PLAN", PLAN)),
                  GOP1=lambda stream: stream.add_gop(gop(header=planes), MESH_ID, 2, planes["planes"]), **PLANES_HEAD))

def frames():
    def case(name, section, error="malformed", **changed):
        return f"lossless_{name}", error, section, FRAMES - 2, of_shape(gop(**changed))

    yield case("infinite", "7.9.2", choose_number=lambda v, axis, rounded, line: line.most + 1)
    yield case("minus_infinite", "7.9.2", choose_number=lambda v, axis, rounded, line: -2 - line.most)
    yield case("no_number", "7.9.2", choose_number=lambda v, axis, rounded, line: 2 ** 31 - 1)
    yield case("empty", "6.1", edit=recoded(lambda content: b""))
    yield case("between_the_ends", "6.1", edit=recoded(at_meeting(0, b"\0")))
    yield case("cut", "6.1", edit=recoded(at_meeting(1, b"")))
    yield case("out_of_range", "6.1", edit=recoded(lambda content: b"\xff" * len(content)))
    yield case("digest", "7.6", "digest-mismatch",
               edit=lambda packets: packets[:2] + [(1, writer.digest([(1, 0x0123456789ABCDEF)]))])

def cases():
    for group in (headers, frames):
        yield from group()
