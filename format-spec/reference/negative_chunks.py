"""Negative streams of §3, and of the payloads of §4 without the GOP's."""
import struct

import tvg_writer as writer
from negative_base import (BOUNDS, CHUNKS, CONNECTIVITY, FRAMES, MESH_ID, META, OTHER_ID, OTHER_MESH, PLAN,
                           PLANES_BOUNDS, PLANES_HEAD, extra, flipped, gop, of_broken_meshes, put, put_bytes, put_indx,
                           put_named, stream, without)
from tvg_writer import chunk, chunk_header, sized, varint

def signature():
    yield "signature", "not TVG", "3.1", 0, b"\x8bTVGX\n\x1a\n" + stream()[8:]
    yield "signature_as_text", "not TVG", "3.1", 0, stream().replace(b"\r\n", b"\n", 1)
    yield "signature_cut", "truncated", "3.4", 0, stream()[:5]
    yield "nothing", "truncated", "3.4", 0, b""

def chunks():
    damaged = bytearray(chunk(b"META", META))
    damaged[13] ^= 1
    yield "header_checksum", "malformed", "3.2", FRAMES, stream(META=put_bytes(damaged))
    yield "type_characters", "malformed", "3.2", FRAMES, stream(before=("GOP1", put(b"x\x1fxx", b"?", 1)))
    yield "reserved_flag", "malformed", "3.2", FRAMES, stream(META=put(b"META", META, 3))
    yield "chunk_length", "malformed", "3.2", FRAMES, stream(META=put_bytes(chunk_header(b"META", 2 ** 31)))
    places = {"head": "HEAD", "meta": "META", "mesh": "MESH", "gop": "GOP1", "indx": "INDX", "tail": "TAIL"}
    left = {"head": 0, "mesh": 0, "gop": FRAMES - 2}
    for name in ("head", "meta", "data", "mesh", "plan", "gop", "indx", "tail"):
        kind, payload = CHUNKS[name]
        wrong, broken = put(kind, payload, 1 - writer.ANCILLARY[kind]), flipped(payload, kind)
        for fault, part, error, section, frames in (
                ("flag", wrong, "malformed", "3.2", left.get(name, FRAMES)),
                ("checksum", broken, "checksum-mismatch", "3.3", FRAMES if name == "gop" else left.get(name, FRAMES))):
            planes = PLANES_HEAD if name == "plan" else {}
            changed = stream(**{places[name]: part}) if name in places else stream(before=("GOP1", part), **planes)
            yield f"{fault}_of_{name}", error, section, frames, changed
    yield ("checksum_of_unknown", "checksum-mismatch", "3.3", FRAMES,
           stream(before=("GOP1", flipped(b"?", b"xtra", 1))))

def order():
    """A stream for each cell of the table of §3.4 that is no state."""
    for name in CHUNKS:
        if name != "head":
            yield f"start_{name}", "malformed", "3.4", 0, stream(without("HEAD"), before=("META", extra(name)))
    yield "start_end", "truncated", "3.4", 0, stream(())
    for name, parts in (("head", {}), ("plan", PLANES_HEAD)):
        yield f"open_{name}", "malformed", "3.4", FRAMES, stream(before=("META", extra(name)), **parts)
    early = ("HEAD", "META", "GOP0", "MESH", "GOP1", "GOP2", "INDX", "TAIL")
    early_gop = put(b"GOP ", gop(0))
    yield "open_gop", "malformed", "3.4", FRAMES - 2, stream(early, GOP0=early_gop)
    yield "open_tail", "malformed", "3.4", 0, stream(("HEAD", "META", "TAIL"))
    yield "open_critical", "unsupported version", "3.2", 0, stream(before=("META", extra("critical")))
    yield "open_end", "truncated", "3.4", 0, stream(("HEAD", "META"))
    yield "body_head", "malformed", "3.4", FRAMES, stream(before=("GOP1", extra("head")))
    yield "body_tail", "malformed", "3.4", FRAMES, stream(without("INDX"))
    yield "body_critical", "unsupported version", "3.2", 2, stream(before=("GOP1", extra("critical")))
    yield "body_end", "truncated", "3.4", FRAMES, stream(without("INDX", "TAIL"))
    for name in ("head", "meta", "data", "mesh", "plan", "gop", "indx"):
        yield f"indexed_{name}", "malformed", "3.4", FRAMES, stream(before=("TAIL", extra(name)))
    yield "indexed_critical", "unsupported version", "3.2", FRAMES, stream(before=("TAIL", extra("critical")))
    yield "indexed_end", "truncated", "3.4", FRAMES, stream(without("TAIL"))
    for name in CHUNKS:
        yield f"ended_{name}", "malformed", "3.4", FRAMES, stream(end=extra(name))
    yield "ended_byte", "malformed", "3.4", FRAMES, stream(end=put_bytes(b"\n"))
    whole = stream(without("INDX", "TAIL"))
    last = len(chunk(b"GOP ", gop(2)))
    yield "cut_in_chunk_header", "truncated", "3.4", FRAMES - 2, whole[:len(whole) - last + 9]
    yield "cut_in_gop", "truncated", "3.4", FRAMES - 2, whole[:len(whole) - last + 30]
    yield "cut_in_digest", "truncated", "3.4", FRAMES, whole[:-8]
    yield "cut_in_tail", "truncated", "3.4", FRAMES, stream()[:-1]

def head():
    def changed(*arguments, **bounds):
        return stream(HEAD=put(b"HEAD", writer.head(*arguments, **(BOUNDS | bounds))))

    for version in ((0, 1), (0, 3), (1, 2)):
        yield f"version_{version[0]}_{version[1]}", "unsupported version", "4.1", 0, changed(version)
    for name in BOUNDS:
        yield f"without_{name}", "malformed", "4.1", 0, changed(**{name: None})
    large = {"decoder_memory": 2 ** 62}
    for name in ("vertices", "faces", "frames_per_gop", "packet_bytes", "mesh_bytes"):
        yield f"{name}_above_32_bits", "malformed", "4.1", 0, changed(**(large | {name: 2 ** 32}))
    yield "decoder_memory_low", "malformed", "4.1", 0, changed(decoder_memory=BOUNDS["decoder_memory"] - 1)
    yield "decoder_memory_above_63_bits", "malformed", "4.1", 0, changed(decoder_memory=2 ** 63)
    yield "meshes_none", "malformed", "4.1", 0, changed(meshes=0)
    yield "meshes_too_many", "malformed", "4.1", 0, changed(**(large | {"meshes": 65537}))
    yield "head_unknown_odd_key", "unsupported version", "4.1", 0, changed(others={23: 1})
    for name, bound, value in (("plan_bytes_above_32_bits", "plan_bytes", 2 ** 32), ("plans_none", "plans", 0),
                               ("components_too_many", "components", 65536), ("plans_too_many", "plans", 257)):
        yield name, "malformed", "4.1", 0, changed(**(PLANES_BOUNDS | large | {bound: value}))
    low = PLANES_BOUNDS["decoder_memory"] - 1
    yield "decoder_memory_low_for_planes", "malformed", "4.1", 0, changed(**(PLANES_BOUNDS | {"decoder_memory": low}))
    payload = writer.head(**BOUNDS)
    for name, section, tail in (("descending_key", "3.5", b"\0\0"), ("repeated_key", "3.5", b"\x0d\x64"),
                                ("key_without_value", "4.1", b"\x10"), ("long_varint", "2.2", b"\x10\x81\0"),
                                ("wide_varint", "2.2", b"\x10" + b"\xff" * 9 + b"\2")):
        yield f"head_{name}", "malformed", section, 0, stream(HEAD=put(b"HEAD", payload + tail))
    yield "head_cut", "malformed", "4.1", 0, stream(HEAD=put(b"HEAD", payload[:3]))
    wide = {name: 2 ** 32 - 1 for name in ("vertices", "faces", "packet_bytes")}
    yield ("limits_of_the_decoder", "limit-exceeded", "8.1", 0, changed(**(wide | {"decoder_memory": 2 ** 62})))

def meta():
    def entries(*pairs):
        return writer.meta(pairs)

    payloads = {
        "empty": b"", "count": varint(2) + entries((b"a", b""))[1:], "huge_count": varint(2 ** 40),
        "left_over": entries((b"a", b"")) + b"\0", "size": varint(1) + sized(b"key") + varint(9) + b"short",
        "empty_key": entries((b"", b"x")), "key_order": entries((b"b", b""), (b"a", b"")),
        "key_twice": entries((b"a", b""), (b"a", b"")), "zero_in_key": entries((b"a\0", b"")),
        "zero_in_value": entries((b"a", b"\0")), "over_long": entries((b"a", b"\xc0\x80")),
        "surrogate": entries((b"a", b"\xed\xa0\x80")), "beyond_unicode": entries((b"a", b"\xf4\x90\x80\x80")),
    }
    for name, payload in payloads.items():
        yield f"meta_{name}", "malformed", "4.2", FRAMES, stream(META=put(b"META", payload))

def mesh():
    part = (1, CONNECTIVITY)
    many = bytes(BOUNDS["mesh_bytes"])
    cases = {
        "vertex_count_zero": ("malformed", "4.3", writer.mesh(0, 1, [part])),
        "vertex_count_large": ("malformed", "4.3", writer.mesh(2 ** 31, 1, [part])),
        "face_count_large": ("malformed", "4.3", writer.mesh(4, 2 ** 31, [part])),
        "vertices_exceeded": ("limit-exceeded", "4.1", writer.mesh(9, 1, [part])),
        "faces_exceeded": ("limit-exceeded", "4.1", writer.mesh(4, 5, [part])),
        "mesh_bytes_exceeded": ("limit-exceeded", "4.3", writer.mesh(4, 1, [part, (8, many)])),
        "without_connectivity": ("malformed", "4.3", writer.mesh(4, 1, [(8, b"")])),
        "sections_descend": ("malformed", "3.5", writer.mesh(4, 1, [part, (0, b"")])),
        "section_twice": ("malformed", "3.5", writer.mesh(4, 1, [part, part])),
        "section_beyond": ("malformed", "4.3", writer.mesh(4, 1, [part]) + varint(8) + varint(5) + b"four"),
        "section_without_size": ("malformed", "4.3", writer.mesh(4, 1, [part]) + varint(8)),
        "section_unknown": ("unsupported", "4.3", writer.mesh(4, 1, [part, (2 ** 40 + 1, b"?")])),
        "mesh_cut": ("malformed", "4.3", writer.mesh(4, 1, [part])[:1]),
    }
    yield from of_broken_meshes(cases)
    # The second mesh takes the place of the first, where only one is in force.
    one = put(b"HEAD", writer.head(**(BOUNDS | {"meshes": 1})))
    yield "mesh_gone", "malformed", "4.5.1", 2, stream(HEAD=one, before=("GOP1", put_named(b"MESH", OTHER_MESH)))

def indx():
    def fields(*values):
        return b"".join(map(varint, values))

    def entry(place, kind=None, distance=0, values=None):
        def edit(entries):
            old_kind, offset, old = entries[place]
            entries[place] = (old_kind if kind is None else kind, offset + distance, old if values is None else values)
            return entries
        return edit

    edits = {
        "entry_missing": lambda entries: entries[:-1],
        "entry_too_many": lambda entries: entries + [(3, 2000, fields(2, 1, 0))],
        "mesh_missing": lambda entries: entries[1:], "kind": entry(0, kind=2), "kind_skipped": entry(3, kind=6),
        "kind_4": entry(2, kind=4), "distance": entry(2, distance=1), "frame_count": entry(1, values=fields(3, 1, 0)),
        "mesh_back": entry(1, values=fields(2, 2, 0)), "mesh_back_zero": entry(1, values=fields(2, 0, 0)),
        "planes": entry(1, values=fields(2, 1, 1, 1)), "fields_left_over": entry(1, values=fields(2, 1, 0, 0)),
        "fields_cut": entry(1, values=fields(2, 1)), "fields_of_mesh": entry(0, values=b"\0"),
        "distance_zero": lambda entries: entries[:1] + [(6, entries[0][1], b"???")] + entries[1:],
    }
    for name, edit in edits.items():
        yield f"indx_{name}", "malformed", "4.6", FRAMES, stream(INDX=put_indx(edit))
    for name, payload in {"empty": b"", "count_zero": varint(0), "count_huge": varint(10 ** 9),
                          "count_of_no_bytes": varint(2 ** 63)}.items():
        yield (f"indx_{name}", "malformed", "4.6", FRAMES,
               stream(INDX=lambda stream, payload=payload: stream.add_indx(payload)))
    yield "indx_left_over", "malformed", "4.6", FRAMES, stream(
        INDX=lambda stream: stream.add_indx(writer.indx(stream.entries) + b"\0"))

def tail():
    for name, payload in {"distance": struct.pack("<Q", 1), "short": bytes(7), "long": bytes(9)}.items():
        yield f"tail_{name}", "malformed", "4.7", FRAMES, stream(TAIL=put(b"TAIL", payload))

def data_and_plan():
    cases = {
        "name_empty": (b"", 0, 0, b""), "name_long": (b"n" * 1025, 0, 0, b""), "name_zero": (b"\0", 0, 0, b""),
        "name_no_text": (b"\xff", 0, 0, b""), "stored_short": (b"n", 0, 3, b"xy"), "stored_long": (b"n", 0, 1, b"xy"),
        "coded_long": (b"n", 1, 1, b"xy"), "decoded_size": (b"n", 1, 2 ** 26 + 1, b"xy"),
    }
    for name, fields in cases.items():
        error = "limit-exceeded" if name == "decoded_size" else "malformed"
        yield f"data_{name}", error, "4.8", FRAMES, stream(before=("GOP1", put(b"DATA", writer.data(*fields))))
    yield "data_cut", "malformed", "4.8", FRAMES, stream(before=("GOP1", put(b"DATA", sized(b"n") + b"\0")))
    for name, payload in {"mesh_not_there": writer.plan(OTHER_ID, 0, 9), "mode_elp": writer.plan(MESH_ID, 0, 0),
                          "cut": PLAN[:4]}.items():
        plan = put_named(b"PLAN", payload)
        yield f"plan_{name}", "malformed", "4.9", FRAMES, stream(before=("GOP1", plan), **PLANES_HEAD)
    long = put_named(b"PLAN", writer.plan(MESH_ID, 0, 9, bytes(15)))
    yield "plan_bytes_exceeded", "limit-exceeded", "4.9", FRAMES, stream(before=("GOP1", long), **PLANES_HEAD)
    yield "plan_without_bound", "limit-exceeded", "4.9", FRAMES, stream(before=("GOP1", put_named(b"PLAN", PLAN)))

def cases():
    for group in (signature, chunks, order, head, meta, mesh, indx, tail, data_and_plan):
        yield from group()
