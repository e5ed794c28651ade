"""Negative streams of animated attributes (§5.7.7)."""
import struct

import tvg_properties as properties
import tvg_properties_writer as properties_writer
import tvg_reference as reference
import tvg_writer as writer
from negative_base import BOUNDS, FRAMES, choose, of_broken_meshes, put, put_gop, put_named, stream
from negative_properties import CONNECTIVITY, FACES, attribute, attributes, mesh
from tvg_attributes import CORNERS, GENERIC, NORMAL, VERTICES
from tvg_reference import SPACE
from tvg_writer import sized, varint

GATES = reference.Connectivity(reference.RangeDecoder(CONNECTIVITY, "5.1"), 4, 2).decode()[1]
MOVES = 128
# A number on a grid, an exact one, and a normal; the channels of the three and of positions.
HEADS = (bytes([GENERIC, VERTICES, 1, 4]) + sized(b""), attribute(GENERIC, VERTICES, 1, 0),
         attribute(NORMAL, VERTICES, 3, 2))
CHANNELS = (1, 2, 4, 6)

def moving(head):
    return head[:1] + bytes([head[1] + MOVES]) + head[2:]

SECTION = varint(3) + b"".join(map(moving, HEADS)) + b"\0"
MESH = mesh((4, SECTION))
MESH_ID = writer.checksum(MESH)
ANIMATED_BOUNDS = BOUNDS | {"mesh_bytes": 300, "property_bytes": 10 ** 6}
ANIMATED_BOUNDS["decoder_memory"] = writer.memory(**ANIMATED_BOUNDS)
HEAD = put(b"HEAD", writer.head(**ANIMATED_BOUNDS))
GRID = struct.pack("<fd", 0.5, 1.0)

def channels_of():
    parsed = properties.Properties({4: SECTION}, FACES, 4, None, 10 ** 6, reference)
    return parsed.channels(reference)

def piece(channel, predictor, *values, grid=b"", usual=7):
    """The piece of a frame whose values begin with those said; what is decoded is kept as far as it is valid."""
    coder = properties_writer.Usual(values, usual)
    try:
        if grid:
            channel.begin(reference.Reader(grid, "5.7"))
        channel.code(coder, predictor)
    except reference.Invalid:
        coder.clear()
    coder.finish()
    return bytes([predictor]) + grid + coder.data

def pieces():
    """The pieces of two frames, and the digests of the channels."""
    known = channels_of()
    first = {2: piece(known[2], 0, grid=GRID), 4: piece(known[4], 0, usual=8), 6: piece(known[6], 0)}
    second = {2: piece(known[2], 1), 4: b"", 6: piece(known[6], 1)}
    known[4].keep(known[4].integers)
    return [first, second], {channel: reference.xxh64(bytes(known[channel].hashed)) for channel in known}

def gop(number=1, change=lambda frames: None, channels=CHANNELS, digests=None):
    """A GOP of two frames whose pieces are changed."""
    frames, right = pieces()
    change(frames)
    positions = writer.FrameWriter(GATES, [1] * 4, 4, 4, choose, None)
    packets = []
    for others in frames:
        content = [positions.write(SPACE)] + [others.get(channel, b"") for channel in channels[1:]]
        packets.append((32 + SPACE, b"".join(map(sized, content[:-1])) + content[-1]))
    values = {1: positions.digest()} | right | (digests or {})
    packets.append((1, writer.digest([(channel, values[channel]) for channel in channels])))
    fields = writer.elp_fields(1 << SPACE, 4, 4, (0.0, 0.0, 0.0), 1.0, b"", channels)
    header = writer.gop_header(MESH_ID, 2 * number, 2, len(packets), fields=fields)
    return writer.gop([(0, header)] + packets)

def whole(payload):
    gops = {f"GOP{k}": put_gop(payload if k == 1 else gop(k), MESH_ID) for k in range(3)}
    return stream(HEAD=HEAD, MESH=put_named(b"MESH", MESH), **gops)

def changed(frame, channel, edit):
    """The piece of one frame edited."""
    def change(frames):
        frames[frame][channel] = edit(frames[frame][channel])
    return gop(change=change)

def coded(frame, channel, predictor, *values, grid=b""):
    """The piece of one frame coded anew, so that it breaks a rule."""
    def anew(_piece):
        known = channels_of()[channel]
        if frame > 0:
            piece(known, 0, grid=GRID if channel == 2 else b"", usual=8 if channel == 4 else 7)
        return piece(known, predictor, *values, grid=grid)
    return changed(frame, channel, anew)

def cases():
    infinite, none = struct.pack("<f", float("inf")), struct.pack("<d", float("nan"))
    tail = GRID[4:]
    pieces_of = {
        "first_repeats": changed(0, 2, lambda old: b""),
        "first_by_time": changed(0, 2, lambda old: b"\1" + old[1:]),
        "predictor_unknown": changed(1, 2, lambda old: b"\2" + old[1:]),
        "predictor_of_first_unknown": changed(0, 4, lambda old: b"\2" + old[1:]),
    }
    values = {
        "value_above": coded(0, 2, 0, 15, 0, 0, 0, 0, 0, grid=GRID),
        "change_above": coded(1, 2, 1, 15, 0, 0, 0, 0, 0),
        "exact_infinite": coded(0, 4, 0, 15, 31, 0, 0x3F800000),
        "change_infinite": coded(1, 4, 1, 15, 31, 0, 0x3F800000),
        "normal_beyond": coded(0, 6, 0, 0, 15, 0, 0, 0, 0, 0),
        "normal_change_beyond": coded(1, 6, 1, 0, 15, 0, 0, 0, 0, 0),
    }
    grids = {
        "origin_infinite": changed(0, 2, lambda old: b"\0" + infinite + tail + old[13:]),
        "range_none": changed(0, 2, lambda old: old[:5] + none + old[13:]),
        "range_below_zero": changed(0, 2, lambda old: old[:5] + struct.pack("<d", -1.0) + old[13:]),
        "grid_cut": changed(0, 2, lambda old: old[:9]),
    }
    streams = {
        "left_over": changed(0, 2, lambda old: old + b"\0"),
        "left_over_by_time": changed(1, 2, lambda old: old + b"\0"),
        "predictor_alone": changed(1, 6, lambda old: old[:1]),
    }
    for section, named in (("5.7.7", pieces_of), ("5.7", values | grids), ("6.1", streams)):
        for name, payload in named.items():
            yield f"animated_{name}", "malformed", section, FRAMES - 2, whole(payload)
    yield "animated_without_channel", "malformed", "4.5.1", FRAMES - 2, whole(gop(channels=(1, 2, 6)))
    yield "animated_without_channels", "malformed", "4.5.1", FRAMES - 2, whole(gop(channels=(1,)))
    for channel in CHANNELS[1:]:
        payload = gop(digests={channel: 1})
        yield f"animated_digest_{channel}", "digest-mismatch", "7.6", FRAMES - 2, whole(payload)
    broken = {"head_unknown": varint(1) + attribute(GENERIC, 3 + MOVES, 1, 0) + b"\0",
              "seam_unknown": attributes(moving(attribute(GENERIC, CORNERS, 1, 0)), values=(2,))}
    for name, section in broken.items():
        yield from of_broken_meshes({f"animated_{name}": ("malformed", "5.7", mesh((4, section)))}, HEAD=HEAD)
    limits = ANIMATED_BOUNDS | {"property_bytes": 5 * (256 + 16) + 2 ** 15 + 48 * 2 - 1}
    one = {"animated_exceeds": ("limit-exceeded", "5.7", mesh((4, varint(1) + moving(HEADS[1]) + b"\0")))}
    yield from of_broken_meshes(one, HEAD=put(b"HEAD", writer.head(**limits)))
