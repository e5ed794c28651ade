"""The stream that each of negative_streams.py's breaks in one place: three GOPs of two frames of a triangle."""
import struct

import tvg_reference as reference
import tvg_writer as writer
from tvg_reference import ELP, SPACE
from tvg_writer import RangeEncoder, Stream, chunk, varint

FRAMES = 6
BOUNDS = {"vertices": 8, "faces": 4, "frames_per_gop": 3, "packet_bytes": 300, "meshes": 2, "mesh_bytes": 100}
BOUNDS["decoder_memory"] = writer.memory(**BOUNDS)
# The same for streams with planes.
PLANES_BOUNDS = BOUNDS | {"plan_bytes": 20, "components": 3, "plans": 2}
PLANES_BOUNDS["decoder_memory"] = writer.memory(**PLANES_BOUNDS)

def written(use, *values):
    """The range-coder stream of what use(coder) reads while the coder says these values, valid or not."""
    coder = RangeEncoder()
    coder.say(*values)
    try:
        use(coder)
    except (reference.Invalid, IndexError):  # it has read what breaks a rule, or all that there is
        coder.clear()
    coder.finish()
    return coder.data

def connectivity(V, F, *values):
    return written(lambda coder: reference.Connectivity(coder, V, F).decode(), *values)

# A triangle of three new vertices, beside one of no face; and the same vertices in another order.
CONNECTIVITY = connectivity(4, 1, 0, 0, 0)
GATES = reference.Connectivity(reference.RangeDecoder(CONNECTIVITY, "5.1"), 4, 1).decode()[1]
MESH = writer.mesh(4, 1, [(1, CONNECTIVITY)])
OTHER_MESH = writer.mesh(4, 1, [(1, CONNECTIVITY), (3, writer.uniform_order([3, 1, 0, 2]))])
MESH_ID, OTHER_ID = writer.checksum(MESH), writer.checksum(OTHER_MESH)
META = writer.meta([(b"fps", b"30")])
DATA = writer.data(b"extras", 0, 2, b"{}")
PLAN = writer.plan(MESH_ID, 0, 9)
FINE = [1, 0, 1, 1]
ELP_FIELDS = {"fine_bits": 6, "coarse_bits": 4, "origin": (0.0, -1.0, 0.5), "step": 0.25,
              "flags": writer.flags(FINE, GATES)}

def choose(v, axis, prediction, cells):
    return (v * 5 + axis * 3 + prediction // 2) % cells

def at_meeting(remove, insert):
    """Changes the bytes of a stream between its ends: some before they meet are removed, others inserted."""
    return lambda content: content[:content.front - remove] + insert + content[content.front:]

def recoded(change):
    """Changes the second frame's stream."""
    return lambda packets: [packets[0], (packets[1][0], change(packets[1][1])), packets[2]]

def packets_of(frames, predictors):
    """Packets of frames with these predictors, those that cannot be coded as far as they can, and their digest."""
    packets = []
    for predictor in predictors:
        try:
            content = frames.write(predictor)
        except reference.Invalid:
            frames.coder.clear()
            frames.coder.finish()
            content = frames.coder.data
        packets.append((32 + predictor, content))
    return packets + [(1, writer.digest([(1, frames.digest())]))]

def gop(number=1, header=None, fields=None, edit=None, choose_index=choose, predictors=(SPACE, ELP), turns=None):
    """The payload of GOP number: with changed fields of the header, and its packets behind the header edited."""
    packets = packets_of(writer.FrameWriter(GATES, FINE, 6, 4, choose_index, turns), predictors)
    fields = ELP_FIELDS | {"predictors": writer.predictors_of(packets)} | (fields or {})
    packets = edit(packets) if edit else packets
    values = {"mesh_id": MESH_ID, "first_frame": 2 * number, "frame_count": 2, "packet_count": len(packets),
              "fields": writer.elp_fields(**fields)} | (header or {})
    return writer.gop([(0, writer.gop_header(**values))] + packets)

# A stream is a list of parts: a name, and what puts it into a Stream.
def put(kind, payload, flags=None):
    return lambda stream: stream.add(kind, payload, flags)

def put_named(kind, payload):
    return lambda stream: stream.add_named(kind, payload)

def put_gop(payload, mesh_id=MESH_ID):
    return lambda stream: stream.add_gop(payload, mesh_id, 2)

def put_bytes(data):
    return lambda stream: stream.data.extend(data)

def put_indx(edit=None):
    """The index, with its entries edited."""
    return lambda stream: stream.add_indx(writer.indx(edit(list(stream.entries))) if edit else None)

PARTS = {"HEAD": put(b"HEAD", writer.head(**BOUNDS)), "META": put(b"META", META), "MESH": put_named(b"MESH", MESH),
         "GOP0": put_gop(gop(0)), "GOP1": put_gop(gop(1)), "GOP2": put_gop(gop(2)), "INDX": put_indx(),
         "TAIL": Stream.add_tail}
ORDER = tuple(PARTS)
PLANES_HEAD = {"HEAD": put(b"HEAD", writer.head(**PLANES_BOUNDS))}

def stream(order=ORDER, before=None, end=None, **parts):
    """The stream of these parts, some of them others than PARTS, with something put before one."""
    result, parts = Stream(), PARTS | parts
    for name in order:
        if before and before[0] == name:
            before[1](result)
        parts[name](result)
    if end:
        end(result)
    return bytes(result.data)

def without(*names):
    return tuple(name for name in ORDER if name not in names)

def flipped(payload, kind, flags=None):
    """A chunk whose payload checksum is wrong."""
    data = bytearray(chunk(kind, payload, flags))
    data[-1] ^= 0x40
    return put_bytes(data)

CHUNKS = {"head": (b"HEAD", writer.head(**BOUNDS)), "meta": (b"META", META), "data": (b"DATA", DATA),
          "mesh": (b"MESH", MESH), "plan": (b"PLAN", PLAN), "gop": (b"GOP ", gop(1)), "indx": (b"INDX", varint(0)),
          "tail": (b"TAIL", struct.pack("<Q", 99)), "ancillary": (b"xtra", b"?"), "critical": (b"XTRA", b"?")}

def extra(name):
    """A chunk of any kind, known or not, that stands where it need not."""
    kind, payload = CHUNKS[name]
    return put(kind, payload, {"ancillary": 1, "critical": 0}.get(name))

def of_broken_meshes(cases, **parts):
    """Streams all of whose frames are of the broken mesh. cases: by name, the error, the section and the payload."""
    for name, (error, section, payload) in cases.items():
        gops = {f"GOP{k}": put_gop(gop(k, {"mesh_id": writer.checksum(payload)}), writer.checksum(payload))
                for k in range(3)}
        yield name, error, section, 0, stream(MESH=put_named(b"MESH", payload), **(gops | parts))
