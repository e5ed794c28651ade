"""Negative streams of the GOP (§4.5), of the mesh (§5), of entropy coding (§6) and of frames (§7)."""
import struct

import tvg_reference as reference
import tvg_writer as writer
from negative_base import (BOUNDS, CONNECTIVITY, ELP_FIELDS, FRAMES, GATES, MESH, MESH_ID, OTHER_ID, OTHER_MESH, PLAN,
                           PLANES_HEAD, at_meeting, choose, connectivity, gop, of_broken_meshes, put, put_gop,
                           put_named, recoded, stream,
                           written)
from tvg_reference import TIME
from tvg_writer import varint

def replaced(place, *new):
    return lambda packets: packets[:place] + list(new) + packets[place + 1:]

def inserted(place, *new):
    return lambda packets: packets[:place] + list(new) + packets[place:]

def packets():
    def case(name, error, section, lost, payload):
        return f"gop_{name}", error, section, FRAMES - lost, stream(GOP1=put_gop(payload))

    content, space = gop(edit=None), (32, b"\0")
    aside = (255, b"?")
    kinds = {"header_twice": inserted(1, (0, b"")), "frame_too_many": inserted(2, space),
             "frame_too_few": replaced(1, aside), "without_digest": replaced(2, aside)}
    for name, edit in kinds.items():
        yield case(name, "malformed", "4.5", 2, gop(edit=edit))
    yield case("digest_twice", "malformed", "4.5", 0, gop(edit=lambda packets: packets + packets[-1:]))
    yield case("frame_behind_digest", "malformed", "4.5", 0, gop(edit=lambda packets: packets + [space]))
    for kind in (2, 31, 64, 127):
        yield case(f"kind_{kind}", "unsupported", "4.5", 1, gop(edit=inserted(1, (kind, b"?"))))
    for kind in (36, 37):
        yield f"gop_kind_{kind}", "malformed", "4.5.2", FRAMES - 2, stream(GOP1=put_gop(gop(
            edit=lambda packets, kind=kind: replaced(1, (kind, packets[1][1]))(packets))))
    for kind in (38, 63):
        yield case(f"kind_{kind}", "unsupported", "4.5", 1, gop(edit=lambda packets, kind=kind: replaced(
            1, (kind, packets[1][1]))(packets)))
    yield case("kind_2_behind_frames", "unsupported", "4.5", 0, gop(edit=inserted(2, (2, b"?"))))
    yield case("first_packet_is_a_frame", "malformed", "4.5", 2, b"\x20" + resealed(content)[1:])
    yield case("empty", "malformed", "4.5", 2, b"")
    for k, name, lost in ((0, "header", 2), (1, "first_frame", 2), (2, "second_frame", 1), (3, "digest", 0)):
        yield case(f"checksum_of_{name}", "checksum-mismatch", "4.5", lost, damaged_packet(content, k))
    yield case("checksum_of_ancillary", "checksum-mismatch", "4.5", 1,
               damaged_packet(gop(edit=inserted(1, (200, b"?"))), 2))
    split = split_packets(content)
    other = split_packets(gop(0))
    yield case("packets_swapped", "checksum-mismatch", "4.5", 2, b"".join((split[0], split[2], split[1], split[3])))
    yield case("packet_of_another", "checksum-mismatch", "4.5", 1, b"".join((split[0], split[1], other[2], split[3])))
    yield case("packet_beyond", "malformed", "4.5", 1, b"".join(split[:2]) + b"\x22" + varint(99) + split[2][2:])
    yield case("packet_cut", "malformed", "4.5", 1, b"".join(split[:2]) + split[2][:1])
    yield case("packet_bytes_exceeded", "limit-exceeded", "4.1", 1, gop(edit=inserted(1, (128, bytes(301)))))
    yield case("packet_count_low", "malformed", "4.5.1", 2, gop(header={"packet_count": 2}))
    yield case("packet_count_high", "malformed", "4.5", 0, gop(header={"packet_count": 4}))
    yield case("bytes_behind", "malformed", "4.5", 0, content + b"\0")
    yield case("first_by_time", "malformed", "4.5.2", 2, gop(fields={"predictors": 7}, edit=lambda packets: replaced(
        0, (32 + TIME, packets[0][1]))(packets)))
    two = {"channels": (1, 2)}
    digests = writer.digest([(1, 0), (2, 0)])
    yield case("piece_beyond", "malformed", "4.5.2", 2, gop(fields=two, edit=lambda _: [
        (32, varint(9) + b"four"), (32, b"\0"), (1, digests)]))
    digest = gop_digest()
    contents = {"digest_of_another_channel": writer.digest([(2, digest)]), "digest_cut": varint(1) + b"seven..",
                "digest_of_too_many": writer.digest([(1, digest), (2, 0)]), "digest_empty": b""}
    for name, payload in contents.items():
        yield case(name, "malformed", "4.5.3", 2, gop(edit=replaced(2, (1, payload))))
    wrong = (1, writer.digest([(1, digest ^ 1)]))
    yield case("digest_differs", "digest-mismatch", "7.6", 2, gop(edit=replaced(2, wrong)))

def split_packets(payload):
    """The packets of a GOP, as they stand."""
    reader, packets = reference.Reader(payload, "4.5"), []
    while reader.at < len(payload):
        begin = reader.at
        reader.unsigned(1)
        reader.take(reader.varint())
        reader.unsigned(4)
        packets.append(payload[begin:reader.at])
    return packets

def gop_digest():
    return int.from_bytes(split_packets(gop())[3][3:11], "little")

def damaged_packet(payload, k):
    """The GOP with the last byte of packet k changed."""
    split = split_packets(payload)
    split[k] = split[k][:-1] + bytes([split[k][-1] ^ 1])
    return b"".join(split)

def resealed(payload):
    """The GOP with its first packet sealed as one of kind 32."""
    split = split_packets(payload)
    first = b"\x20" + split[0][1:-4]
    return first + struct.pack("<I", writer.checksum(first)) + b"".join(split[1:])

def headers():
    def case(name, error, section, header=None, fields=None, **parts):
        return (f"gop_{name}", error, section, FRAMES - 2,
                stream(GOP1=put_gop(gop(header=header, fields=fields)), **parts))

    yield case("mesh_not_there", "malformed", "4.5.1", {"mesh_id": OTHER_ID})
    yield case("first_frame", "malformed", "4.5.1", {"first_frame": 2 ** 62 + 1})
    yield case("frame_count_zero", "malformed", "4.5.1", {"frame_count": 0})
    yield case("frame_count_exceeded", "limit-exceeded", "4.1", {"frame_count": 4, "packet_count": 5})
    yield case("packet_count_large", "malformed", "4.5.1", {"packet_count": 2 ** 31})
    yield case("planes_too_many", "malformed", "4.5.1", {"planes": (1,) * 257, "mode": 9},
               HEAD=put(b"HEAD", writer.head(**wide_packets())))
    yield case("plane_not_there", "malformed", "4.5.1", {"planes": (1,), "mode": 9})
    named = {"planes": (writer.checksum(PLAN),)}
    yield case("planes_in_elp", "malformed", "4.5.1", named, before=("GOP1", put_named(b"PLAN", PLAN)), **PLANES_HEAD)
    yield from plans()
    yield case("mode_unknown", "unsupported", "4.5.1", {"mode": 2 ** 40, "fields": b""})
    yield ("gop_mode_with_planes", "unsupported", "4.5.1", FRAMES - 2, stream(
        before=("GOP1", put_named(b"PLAN", PLAN)), GOP1=lambda stream: stream.add_gop(
            gop(header=named | {"mode": 9, "fields": b"?"}), MESH_ID, 2, named["planes"]), **PLANES_HEAD))
    yield case("header_cut_in_prefix", "malformed", "4.5.1", {"mode": 0, "fields": b""})
    nan, infinity = float("nan"), float("inf")
    cases = {
        "channels_none": {"channels": ()}, "channels_descend": {"channels": (1, 4, 2)},
        "channel_twice": {"channels": (1, 1)}, "channel_first": {"channels": (0, 1)},
        "without_positions": {"channels": (2,)}, "fine_bits_zero": {"fine_bits": 0, "coarse_bits": 0},
        "fine_bits_large": {"fine_bits": 25}, "coarse_bits_zero": {"coarse_bits": 0},
        "coarse_bits_large": {"coarse_bits": 7},
        "origin_nan": {"origin": (0.0, nan, 0.0)}, "origin_infinite": {"origin": (infinity, 0.0, 0.0)},
        "step_zero": {"step": 0.0}, "step_negative": {"step": -1.0}, "step_nan": {"step": nan},
        "step_infinite": {"step": infinity}, "flags_of_one_lattice": {"coarse_bits": 6},
    }
    for name, fields in cases.items():
        section = "3.5" if name in ("channels_descend", "channel_twice") else "4.5.1"
        yield case(name, "malformed", section, fields=fields)
    yield case("channel_unknown", "unsupported", "4.5.1", fields={"channels": (1, 3)})
    for name, flags in {"flags_none": b"", "flags_left_over": ELP_FIELDS["flags"] + b"\0",
                        "flags_cut": b"\xff"}.items():
        yield case(name, "malformed", "6.1", fields={"flags": flags})

def plans():
    """GOPs that name planes which are not in force any more, or are no planes of theirs."""
    def case(name, error, section, payload, *chunks, mode=9):
        identity = writer.checksum(payload)

        def before(stream):
            for chunk in chunks:
                put_named(*chunk)(stream)

        header = {"planes": (identity,), "mode": mode, "fields": b"?"}
        return f"gop_plan_{name}", error, section, FRAMES - 2, stream(
            before=("GOP1", before), GOP1=lambda stream: stream.add_gop(gop(header=header), MESH_ID, 2, (identity,)),
            **PLANES_HEAD)

    later = [(b"PLAN", writer.plan(MESH_ID, 0, 9, bytes([k]))) for k in range(2)]
    yield case("gone", "malformed", "4.5.1", PLAN, (b"PLAN", PLAN), *later)
    yield case("before_its_mesh", "malformed", "4.5.1", PLAN, (b"PLAN", PLAN), (b"MESH", MESH))
    yield case("of_another_mode", "malformed", "4.5.1", PLAN, (b"PLAN", PLAN), mode=1)
    added = writer.plan(MESH_ID, 1, 1)
    yield case("that_adds", "malformed", "4.9", added, (b"PLAN", added), mode=1)

def wide_packets():
    bounds = BOUNDS | {"packet_bytes": 2000}
    return bounds | {"decoder_memory": writer.memory(**bounds)}

def geometry():
    def section(V, F, bytes_of_connectivity):
        return writer.mesh(V, F, [(1, bytes_of_connectivity)])

    def ordered(data):
        return writer.mesh(4, 1, [(1, CONNECTIVITY), (3, data)])

    def near(*values):
        return b"\1" + written(lambda coder: reference.near_order(coder, GATES, [0, 1, 2, 3]), *values)

    def uniform(*values):
        return b"\2" + written(lambda coder: reference.uniform_order(coder, GATES, [0, 1, 2, 3]), *values)

    root = (0, 0)
    cases = {
        "connectivity_empty": ("limit-exceeded", "5.1", section(4, 1, b"")),
        "connectivity_cut": ("malformed", "6.1", section(8, 4, connectivity(8, 4, *root, 0, 0, 0, 0)[:1])),
        "connectivity_left_over": ("malformed", "6.1", section(4, 1, CONNECTIVITY + b"\0")),
        "vertices_too_many": ("malformed", "5.1.1", section(2, 1, connectivity(3, 1, *root, 0))),
        "operation_unknown": ("malformed", "5.1.2", section(4, 2, connectivity(4, 2, *root, 6))),
        "candidate_unknown": ("malformed", "5.1.2", section(4, 2, connectivity(4, 2, *root, 4, 15))),
        "vertex_not_seen": ("malformed", "5.1.4", section(4, 2, connectivity(4, 2, *root, 4, 14, 3))),
        "edge_not_met": ("malformed", "5.1.5", section(4, 2, connectivity(4, 2, *root, 5, 2))),
        "triangle_degenerate": ("malformed", "5.1.5", section(4, 2, connectivity(4, 2, *root, 4, 14, 0))),
        "padding": ("malformed", "5.1.6", section(4, 1, connectivity(4, 1, *root, 1, 1))),
        "order_empty": ("malformed", "5.2", ordered(b"")), "order_mode": ("malformed", "5.2", ordered(b"\3")),
        "order_identity_long": ("malformed", "5.2", ordered(b"\0\0")),
        "order_left_over": ("malformed", "6.1", ordered(writer.uniform_order([3, 1, 0, 2]) + b"\0")),
        "order_without_stream": ("malformed", "6.1", ordered(b"\2")),
        "order_choice": ("malformed", "5.2.1", ordered(near(5))),
        "order_rank": ("malformed", "5.2.1", ordered(near(0, 0, 3, 0))),
        "order_rank_below": ("malformed", "5.2.1", ordered(near(0, 1, 0))),
        "order_number": ("malformed", "5.2.1", ordered(near(0, 0, 15, 18))),
    }
    yield from of_broken_meshes(cases)

def frames():
    def frame(name, section, edit=None, choose_index=choose):
        return f"frame_{name}", "malformed", section, FRAMES - 2, stream(
            GOP1=put_gop(gop(edit=edit, choose_index=choose_index)))

    yield frame("above_the_lattice", "7.5", choose_index=lambda v, axis, prediction, cells: cells)
    yield frame("below_the_lattice", "7.5", choose_index=lambda v, axis, prediction, cells: -1)
    yield frame("far_outside", "7.5", choose_index=lambda v, axis, prediction, cells: 2 ** 27)
    yield frame("empty", "6.1", edit=recoded(lambda content: b""))
    yield frame("between_the_ends", "6.1", edit=recoded(at_meeting(0, b"\0")))
    yield frame("cut", "6.1", edit=recoded(at_meeting(1, b"")))
    for end in ("front", "back"):
        for name, change in ((f"last_bits_of_the_{end}", with_last_bit), (f"{end}_not_settled", with_next_code)):
            yield frame(name, "6.1", choose_index=choose_unsettled, edit=recoded(changed(end, change)))

def changed(end, change):
    """Changes one of the streams that a two-ended one is made of."""
    def result(content):
        front, back = content[:content.front], content[content.front:]
        return change(front) + back if end == "front" else front + change(back[::-1])[::-1]
    return result

def with_last_bit(data):
    """A bit that is set in what fills the last byte."""
    assert data[-1] % 2 == 0
    return data[:-1] + bytes([data[-1] | 1])

def choose_unsettled(v, axis, prediction, cells):
    """Streams of both ends that have bits to fill the last byte, and a next code that is decoded to the same."""
    return (2 * v + 2 * axis + prediction // 2) % cells

def with_next_code(data):
    """The next larger stream of as many bits, which is decoded to the same frame."""
    code = int.from_bytes(data, "big")
    return (code + (code & -code)).to_bytes(len(data), "big")

def cases():
    for group in (packets, headers, geometry, frames):
        yield from group()
