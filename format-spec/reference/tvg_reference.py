#!/usr/bin/env python3
"""A second decoder of TVG streams, written from format-spec/tvg.md alone: slow, plain and strict.

It follows the order of the specification and uses its names (§5.4 is in tvg_pyramid.py, §5.5 and §5.6 in tvg_levels.py, §5.7 to §5.9 in
tvg_properties.py and what that imports, §7.8 in tvg_basis.py and tvg_rows.py, §7.9 in tvg_lossless.py). It does not recover from damage (§8.3): the first violation ends a stream.
Python 3, standard library only.

    python3 tvg_reference.py FILE.tvg...

prints for each stream what corpus/conformance/digests.txt has of it: its name; its bytes; its frames; the vertices and
the faces of its meshes, summed; and the XXH64 of all lattice indices (i32), positions (binary32) and faces (u32) in
output order (of what stands for indices in other modes than elp), and of its meshes' properties (§5.7). A mesh counts when a frame has other faces or another number of vertices than the frame before it.

    python3 tvg_reference.py --check FILE.tvg...

prints for each stream "valid", or its first violation: the error (§8.4), the section that is violated, and what is
wrong.

Exit status: 0; 2 usage, or a file cannot be read; 3 a stream is not valid.
"""
import math
import os
import struct
import sys
from bisect import bisect_left
from collections import deque

from tvg_basis import Basis, BasisFrames  # 7.8
from tvg_levels import levels_of, lods_of  # 5.5, 5.6
from tvg_lossless import LosslessFrames, line_of  # 7.9
from tvg_properties import Properties, dumped  # 5.7 to 5.9
from tvg_pyramid import pyramid  # 5.4

class Invalid(Exception):
    """The stream violates a section of the specification; error is one of those of §8.4."""
    def __init__(self, error, section, what):
        super().__init__(error.replace(' ', '-') + f" §{section}: {what}")
        self.error, self.section = error, section

def require(condition, section, what, error="malformed"):
    """Refuse the stream unless the condition holds."""
    if not condition:
        raise Invalid(error, section, what)

# 1. Terms and conventions
NONE = 0xFFFFFFFF

def clamp(x, a, b):
    """The nearest value to x in a..b."""
    return max(a, min(x, b))

# 2. Primitive types
class Reader:
    """Reads the values of §2.1 and §2.2 from bytes; too few, or bytes left over, violate the section given."""
    def __init__(self, data, section):
        self.data, self.at, self.section = data, 0, section

    def take(self, size):
        require(size <= len(self.data) - self.at, self.section, "too few bytes")
        self.at += size
        return self.data[self.at - size:self.at]

    def rest(self):
        return self.take(len(self.data) - self.at)

    def end(self):
        require(self.at == len(self.data), self.section, "bytes left over (§4)")

    def unsigned(self, size):  # 2.1 Fixed-size values
        return int.from_bytes(self.take(size), "little")

    def f64(self):
        return struct.unpack("<d", self.take(8))[0]

    def varint(self):  # 2.2 Varint
        value = 0
        for i in range(10):
            byte = self.unsigned(1)
            require(i < 9 or byte <= 1, "2.2", "varint of 2^64 or more")
            value |= (byte & 0x7F) << (7 * i)
            if byte < 0x80:
                require(byte > 0 or i == 0, "2.2", "varint is not in its shortest form")
                return value

# 2.3 Checksum
MASK = 2 ** 64 - 1
P1, P2, P3 = 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9
P4, P5 = 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5

def rotl(x, r):
    x &= MASK
    return (x << r | x >> (64 - r)) & MASK

def xxh_round(acc, lane):
    return rotl(acc + lane * P2, 31) * P1 & MASK

def xxh64(data, seed=0):
    """The 64-bit hash XXH64."""
    at = len(data) // 32 * 32
    h = seed + P5
    if at > 0:
        v = [seed + P1 + P2, seed + P2, seed, seed - P1]
        for block in struct.iter_unpack("<4Q", data[:at]):
            v = [xxh_round(acc, lane) for acc, lane in zip(v, block)]
        h = sum(rotl(acc, r) for acc, r in zip(v, (1, 7, 12, 18)))
        for acc in v:
            h = (h ^ xxh_round(0, acc)) * P1 + P4  # merge
    h = h + len(data) & MASK
    while len(data) - at >= 8:
        h = rotl(h ^ xxh_round(0, struct.unpack_from("<Q", data, at)[0]), 27) * P1 + P4 & MASK
        at += 8
    if len(data) - at >= 4:
        h = rotl(h ^ struct.unpack_from("<I", data, at)[0] * P1, 23) * P2 + P3 & MASK
        at += 4
    for byte in data[at:]:
        h = rotl(h ^ byte * P5, 11) * P1 & MASK
    h = (h ^ h >> 33) * P2 & MASK
    h = (h ^ h >> 29) * P3 & MASK
    return h ^ h >> 32

def checksum(data, seed=0):
    return xxh64(data, seed) & 0xFFFFFFFF

# 3. The stream
SIGNATURE = bytes.fromhex("8B5456470D0A1A0A")
ANCILLARY = {b"HEAD": 0, b"META": 1, b"DATA": 1, b"MESH": 0, b"PLAN": 0, b"GOP ": 0, b"INDX": 1, b"TAIL": 0}  # 3.2

# 3.4 Order of chunks: for each state the next one, by the chunk.
COLUMNS = (*ANCILLARY, "ancillary", "critical", "no more bytes")
BAD, VERSION = "malformed", "unsupported version"
ORDER = {
    "start": ("open", BAD, BAD, BAD, BAD, BAD, BAD, BAD, BAD, BAD, "truncated"),
    "open": (BAD, "open", "open", "body", BAD, BAD, "indexed", BAD, "open", VERSION, "truncated"),
    "body": (BAD, "body", "body", "body", "body", "body", "indexed", BAD, "body", VERSION, "truncated"),
    "indexed": (BAD, BAD, BAD, BAD, BAD, BAD, BAD, "ended", "indexed", VERSION, "truncated"),
    "ended": (BAD, BAD, BAD, BAD, BAD, BAD, BAD, BAD, BAD, BAD, "complete"),
}
# §8.1, by key of §4.1
LIMITS = {1: 2 ** 24, 3: 2 ** 25, 5: 2 ** 16, 7: 2 ** 28, 9: 2 ** 36, 13: 2 ** 30, 15: 2 ** 30, 17: 2 ** 14}
MESH_ENTRY, PLAN_ENTRY, GOP_ENTRY = 1, 2, 3  # kinds of §4.6
SPACE, TIME, ELP, PYRAMID, SHAPE = 0, 1, 2, 3, 5  # predictors of §7.2, §7.7 and §7.10
ROWS = 4  # of frames in mode basis
MODE_ELP, MODE_BASIS, MODE_LOSSLESS = 0, 1, 2

def unknown_text(key):
    """3.5: what is even may be skipped."""
    return f"number {key} is required and not known"

class Mesh:
    """A mesh in force (4.3); number: that of its latest entry of the index among the meshes', from 1."""
    def __init__(self, V, gates, order, turns, shape, levels, lods):
        self.gates, self.order, self.number = gates, order, 0
        self.turns = turns  # of the pyramid (5.4); None without a reference shape
        self.shape = shape  # lattice indices, origin and step; None without one
        self.levels, self.lods, self.lod = levels, lods, 0
        self.has = None  # what it has beside its connectivity (5.7 to 5.9), where that is drawn
        self.drawn, self.properties = range(V), b""  # of the whole mesh, as digests.txt has them

    def draw(self, vertices, faces):
        """What is given out: these vertices, in output order, with these faces, all in traversal indices."""
        self.drawn = sorted(vertices, key=lambda v: self.order[v])
        place = {v: i for i, v in enumerate(self.drawn)}
        self.V, self.faces = len(self.drawn), [tuple(place[corner] for corner in face) for face in faces]

    def parts(self):
        """7.8.1 The vertices of each part of a basis."""
        bounds = [0] + [lod.levels for lod in self.lods[::-1]]
        if not self.lods:
            return [range(len(self.gates))]
        return [[v for v, level in enumerate(self.levels) if low <= level < high]
                for low, high in zip(bounds, bounds[1:] + [64])]

class Plan:
    """One of the latest PLAN chunks (4.9), and whether it is in force; number: that of its latest entry of the index among the plans', from 1."""
    def __init__(self, mesh, adds_to, mode, base):
        self.mesh, self.adds_to, self.mode, self.base, self.number = mesh, adds_to, mode, base, 0
        self.part = base.part + 1 if base else 0
        self.basis = None  # of the last part that is wanted

class Decoder:
    """Decodes one stream, and of its meshes draws lod (5.6); the results are in its fields."""
    def __init__(self, data, lod=0):
        self.lod = lod
        self.data, self.metadata, self.named_data, self.frames = data, {}, {}, 0
        self.meshes, self.plans = {}, {}  # in force, or among the latest, by id; the latest comes last (4.3, 4.9)
        self.index = []  # what INDX should hold: (kind, offset of the chunk, fields)
        self.shown, self.shown_vertices, self.shown_faces = None, 0, 0  # the mesh of the last frame; sums
        self.face_bytes, self.index_bytes, self.position_bytes = bytearray(), bytearray(), bytearray()
        self.shown_properties = bytearray()

    def facts(self):
        """What digests.txt says of the stream, without its name."""
        hashed = self.index_bytes, self.position_bytes, self.face_bytes, self.shown_properties
        digests = [f"{xxh64(bytes(values)):016x}" for values in hashed]
        return " ".join(map(str, (len(self.data), self.frames, self.shown_vertices, self.shown_faces, *digests)))

    def decode(self):
        """3.1 Signature, and 3.4 Order of chunks."""
        hint = " (damaged by a transfer in text mode?)" if self.data[:4] == SIGNATURE[:4] else ""
        require(SIGNATURE.startswith(self.data[:8]), "3.1", "wrong signature" + hint, "not TVG")
        require(len(self.data) >= 8, "3.4", "the stream ends in the signature", "truncated")
        at, state, index_at = 8, "start", None
        parse = {b"HEAD": self.head, b"META": self.meta, b"DATA": self.data_chunk, b"MESH": self.mesh,
                 b"PLAN": self.plan, b"GOP ": self.gop}
        while at < len(self.data):
            require(state != "ended", "3.4", "bytes behind TAIL")
            offset = at
            kind, ancillary, payload_at, at = self.chunk_header(offset)
            known = kind in ANCILLARY
            column = kind if known else "ancillary" if ancillary else "critical"
            following = ORDER[state][COLUMNS.index(column)]
            require(following != BAD, "3.4", f"chunk {kind} in the state {state}")
            require(following != VERSION, "3.2", f"unknown chunk {kind}", VERSION)
            require(not known or ancillary == ANCILLARY[kind], "3.2", f"wrong ancillary flag of chunk {kind}")
            payload, payload_checksum = self.payload(kind, payload_at, at)
            if kind == b"INDX":
                self.indx(payload)
                index_at = offset
            elif kind == b"TAIL":
                self.tail(payload, offset - index_at)
            elif known:
                parse[kind](payload, payload_checksum, offset)
            state = following
        require(state == "ended", "3.4", f"the stream ends in the state {state}", "truncated")

    def chunk_header(self, at):
        """3.2 Chunks. Returns type, ancillary bit, offset of the payload, offset of the next chunk."""
        require(at + 16 <= len(self.data), "3.4", "the stream ends in a chunk header", "truncated")
        kind, chunk_flags, length, header_checksum = struct.unpack_from("<4s3I", self.data, at)
        require(header_checksum == checksum(self.data[at:at + 12]), "3.2", "wrong header checksum")
        require(all(0x20 <= c <= 0x7E for c in kind), "3.2", "wrong characters of a chunk type")
        require(chunk_flags <= 1, "3.2", "reserved flags are set")
        require(length <= 2 ** 31 - 1, "3.2", "length of a chunk")
        return kind, chunk_flags, at + 16, at + 16 + length + 4

    def payload(self, kind, at, end):
        """3.3 Payload checksums. Returns the payload and its checksum."""
        require(end <= len(self.data), "3.4", "the stream ends in a chunk", "truncated")
        payload, payload_checksum = self.data[at:end - 4], int.from_bytes(self.data[end - 4:end], "little")
        require(payload_checksum == checksum(payload), "3.3", f"wrong payload checksum of chunk {kind}",
                "checksum-mismatch")
        return payload, payload_checksum

    # 4. Payloads
    def head(self, payload, *_):
        """4.1 HEAD."""
        require(len(payload) <= 2 ** 16, "4.1", "size of the payload")
        reader, bounds, last = Reader(payload, "4.1"), {}, -1
        major, minor = reader.unsigned(2), reader.unsigned(2)
        require((major, minor) == (0, 2), "4.1", f"version {major}.{minor}, not 0.2", VERSION)
        while reader.at < len(payload):
            key, value = reader.varint(), reader.varint()
            require(key > last, "3.5", "keys do not ascend")
            require(key <= 21 or key % 2 == 0, "4.1", unknown_text(key), VERSION)
            bounds[key] = value
            last = key
        for key in (1, 3, 5, 7, 9, 11, 13):
            require(key in bounds, "4.1", f"key {key} is missing")
            require(bounds[key] < (2 ** 63 if key == 9 else 2 ** 32), "4.1", f"value of key {key}")
        require(1 <= bounds[11] <= 65536, "4.1", "meshes")
        bounds = {15: 0, 17: 0, 19: 1, 21: 0} | bounds
        require(bounds[15] < 2 ** 32, "4.1", "plan_bytes")
        require(bounds[17] <= 65535, "4.1", "components")
        require(1 <= bounds[19] <= 256, "4.1", "plans")
        require(bounds[21] < 2 ** 32, "4.1", "property_bytes")
        self.vertices, self.faces, self.frames_per_gop, self.packet_bytes = (bounds[key] for key in (1, 3, 5, 7))
        self.meshes_in_force, self.mesh_bytes = bounds[11], bounds[13]
        self.plan_bytes, self.components, self.plans_in_force = bounds[15], bounds[17], bounds[19]
        self.property_bytes = bounds[21]
        # 8.2 Memory
        memory = 2 ** 20 + 160 * self.vertices + 96 * self.faces + 4 * self.packet_bytes + self.mesh_bytes
        memory += (self.meshes_in_force - 1) * (512 + 24 * self.vertices + 16 * self.faces)
        if self.property_bytes > 0:
            memory += (self.meshes_in_force + 1) * self.property_bytes + 192 * self.vertices + 512 * self.faces
        shapes = (400 + 128 * self.meshes_in_force) * self.vertices + 96 * self.faces
        planes = self.plans_in_force * (4096 + self.components * (64 + 4 * self.vertices) + 8 * self.vertices)
        planes += self.plan_bytes + 128 * self.vertices + 1536 * self.components
        require(bounds[9] >= memory + (shapes + planes if self.plan_bytes > 0 else 0), "4.1", "decoder_memory")
        self.room_for_shapes = bounds[9] >= memory + shapes
        lods = 2 ** 18 + (64 + 16 * self.meshes_in_force) * self.vertices + (96 + 16 * self.meshes_in_force) * self.faces
        lods += self.plans_in_force * self.plan_bytes + (planes if self.plan_bytes > 0 else 0)
        self.room_for_lods = bounds[9] >= memory + shapes + lods
        for key, limit in LIMITS.items():
            require(bounds[key] <= limit, "8.1", f"key {key}: more than this decoder allows", "limit-exceeded")

    def meta(self, payload, *_):
        """4.2 META."""
        require(len(payload) <= 2 ** 20, "4.2", "size of the metadata")
        reader, metadata, last = Reader(payload, "4.2"), {}, b""
        count = reader.varint()
        require(count <= (len(payload) - reader.at) // 2, "4.2", "number of entries")
        for _ in range(count):
            key, value = reader.take(reader.varint()), reader.take(reader.varint())
            require(key > last, "4.2", "keys are empty or do not ascend")
            metadata[text(key, "4.2")] = text(value, "4.2")
            last = key
        reader.end()
        self.metadata = metadata

    def mesh(self, payload, identity, offset):
        """4.3 MESH."""
        require(len(payload) <= self.mesh_bytes, "4.3", "size of a mesh's payload", "limit-exceeded")
        mesh = self.meshes.pop(identity, None) or self.read_mesh(payload)
        self.meshes[identity] = mesh
        for plan in self.plans.values():  # 4.9
            plan.in_force = plan.in_force and plan.mesh != identity
        if len(self.meshes) > self.meshes_in_force:
            del self.meshes[next(iter(self.meshes))]
        self.index.append((MESH_ENTRY, offset, ()))
        mesh.number = self.entries(MESH_ENTRY)

    def read_mesh(self, payload):
        reader, sections, last = Reader(payload, "4.3"), {}, -1
        V, F = reader.varint(), reader.varint()
        require(1 <= V <= 2 ** 31 - 1, "4.3", "vertex_count")
        require(F <= 2 ** 31 - 1, "4.3", "face_count")
        require(V <= self.vertices and F <= self.faces, "4.1", "size of a mesh", "limit-exceeded")
        while reader.at < len(payload):
            kind, section = reader.varint(), reader.take(reader.varint())
            require(kind > last, "3.5", "kinds of sections do not ascend")
            sections[kind] = section
            last = kind
        require(1 in sections, "4.3", "no connectivity")
        for kind in sections:
            require(kind < 10 or kind % 2 == 0, "4.3", unknown_text(kind), "unsupported")
        require(5 not in sections or self.room_for_shapes, "8.2", "decoder_memory is too little for shapes",
                "limit-exceeded")
        require(9 not in sections or 7 in sections, "5.6", "coarse meshes without levels")
        require(9 not in sections or self.room_for_lods, "8.2", "decoder_memory is too little for coarse meshes",
                "limit-exceeded")
        require(V + F <= 128 * len(sections[1]) and F <= 2 ** 30, "5.1", "too many vertices or faces",
                "limit-exceeded")
        faces, gates = Connectivity(RangeDecoder(sections[1], "5.1"), V, F).decode()
        order = vertex_order(sections[3], gates) if 3 in sections else list(range(V))
        levels = levels_of(sections[7], gates, sys.modules[__name__]) if 7 in sections else ()
        lods = lods_of(sections[9], levels, F, sys.modules[__name__]) if 9 in sections else []
        turns = shape = None
        if 5 in sections:
            shape, turns = shape_and_turns(sections[5], faces, V, levels)
        properties = None
        if sections.keys() & {2, 4, 6}:
            properties = Properties(sections, faces, V, shape, self.property_bytes, sys.modules[__name__])
            faces = properties.faces()
        mesh = Mesh(V, gates, order, turns, shape, levels, lods)
        mesh.lod = min(self.lod, len(lods))
        if mesh.lod > 0:
            lod = lods[mesh.lod - 1]
            mesh.draw(lod.vertices, lod.faces(sys.modules[__name__]))
        else:
            mesh.draw(range(V), faces)
            mesh.properties, mesh.has = properties.dump(mesh.drawn) if properties else b"", properties
        return mesh

    def entries(self, kind):
        """How many entries of a kind the index has so far."""
        return sum(entry[0] == kind for entry in self.index)

    def gop(self, payload, _, offset):
        """4.5 GOP."""
        reader, number = Reader(payload, "4.5"), 0

        def packet(seed):
            """Kind, content and checksum of the next packet."""
            at = reader.at
            kind, size = reader.unsigned(1), reader.varint()
            require(size <= self.packet_bytes, "4.1", "size of a packet", "limit-exceeded")
            content = reader.take(size)
            covered, packet_checksum = payload[at:reader.at], reader.unsigned(4)
            require(packet_checksum == checksum(covered, seed), "4.5", "wrong packet checksum", "checksum-mismatch")
            return kind, content, packet_checksum

        kind, content, header_checksum = packet(0)
        require(kind == 0, "4.5", "the first packet is no header")
        header = Header(content, self)
        mesh = self.meshes[header.mesh]
        backs = [self.entries(PLAN_ENTRY) + 1 - self.plans[plane].number for plane in header.planes]
        fields = (header.frame_count, self.entries(MESH_ENTRY) + 1 - mesh.number, len(backs), *backs)
        self.index.append((GOP_ENTRY, offset, fields))
        frames = header.frames(mesh)
        channels = mesh.has.channels(sys.modules[__name__]) if mesh.has else {}
        require(channels.keys() <= set(header.channels), "4.5.1", "no channel for an animated attribute")
        hashed, digested, decoded = bytearray(), False, 0
        while number < header.packet_count:
            number += 1
            kind, content, _ = packet(header_checksum * 2 ** 32 + number)
            if 128 <= kind:
                continue
            if kind == 1:
                require(not digested, "4.5", "a second digest")
                require(decoded == header.frame_count, "4.5", "the digest comes before the last frame")
                self.digest(header, content, {1: bytes(hashed)} | {c: bytes(channels[c].hashed) for c in channels})
                digested = True
                continue
            require(kind != 0, "4.5", "a second header")
            require(32 <= kind <= 32 + SHAPE, "4.5", f"packets of kind {kind} are not known", "unsupported")
            require(decoded < header.frame_count, "4.5", "more frames than frame_count")
            require(header.predictors >> kind - 32 & 1, "4.5.2", "a predictor that the header does not name")
            require(decoded > 0 or kind - 32 in (SPACE, PYRAMID, ROWS, SHAPE), "4.5.2", "nothing is there to predict the first frame from")
            ends = RangeDecoder if kind - 32 == ROWS else TwoEnded
            pieces = header.pieces(content)
            frames.frame(ends(pieces[1], "7.5"), kind - 32)
            for number_of, channel in channels.items():
                channel.take(pieces[number_of])
            decoded += 1
            hashed += b"".join(struct.pack("<3i", *values) for values in frames.hashed_values())
            self.output(mesh, frames, channels)
        require(digested, "4.5", "no digest")
        reader.end()

    def digest(self, header, content, values):
        """4.5.3 The digest packet, and 7.6 The digest."""
        reader = Reader(content, "4.5.3")
        for channel in header.channels:
            require(reader.varint() == channel, "4.5.3", "channels of the digest")
            expected = reader.unsigned(8)
            right = channel not in values or expected == xxh64(values[channel])
            require(right, "7.6", "wrong digest", "digest-mismatch")
        reader.end()

    def output(self, mesh, frames, channels):
        """Give out one frame, in output order (4.3)."""
        if self.shown is None or (mesh.V, mesh.faces) != (self.shown.V, self.shown.faces):
            self.shown_vertices += mesh.V
            self.shown_faces += len(mesh.faces)
            self.face_bytes += b"".join(struct.pack("<3I", *face) for face in mesh.faces)
        if mesh.properties != (self.shown.properties if self.shown else b""):
            self.shown_properties += mesh.properties
        for channel in channels.values():
            self.shown_properties += dumped(channel.attribute, channel.values, mesh.drawn)
        for v in mesh.drawn:
            index, at = frames.given_out(v)
            self.index_bytes += struct.pack("<3i", *index)
            self.position_bytes += struct.pack("<3f", *at)
        self.frames += 1
        self.shown = mesh

    def indx(self, payload):
        """4.6 INDX."""
        require(len(payload) <= 2 ** 20 + 1024 * len(self.index), "4.6", "size of the index")
        reader, offset, entries = Reader(payload, "4.6"), 0, []
        count = reader.varint()
        require(count <= (len(payload) - reader.at) // 3, "4.6", "number of entries")
        for _ in range(count):
            kind, distance = reader.varint(), reader.varint()
            fields, values = Reader(reader.take(reader.varint()), "4.6"), []
            offset += distance
            require(distance >= 1 and offset <= 2 ** 62, "4.6", "distance")
            if kind in (1, 2, 3, 4):
                while fields.at < len(fields.data):
                    values.append(fields.varint())
                entries.append((kind, offset, tuple(values)))
        reader.end()
        require(entries == self.index, "4.6", "the index does not match the stream")

    def tail(self, payload, distance):
        """4.7 TAIL."""
        reader = Reader(payload, "4.7")
        require(reader.unsigned(8) == distance, "4.7", "distance to INDX")
        reader.end()

    def data_chunk(self, payload, *_):
        """4.8 DATA."""
        require(len(payload) <= 2 ** 26 + 2048, "4.8", "size of the payload", "limit-exceeded")
        reader = Reader(payload, "4.8")
        size = reader.varint()
        require(1 <= size <= 1024, "4.8", "size of the name")
        name, encoding, decoded_size = text(reader.take(size), "4.8"), reader.unsigned(1), reader.varint()
        require(decoded_size <= 2 ** 26, "4.8", "decoded_size", "limit-exceeded")
        content = reader.rest()
        require(len(content) <= decoded_size, "4.8", "more bytes than decoded_size")
        require(encoding != 0 or len(content) == decoded_size, "4.8", "fewer bytes than decoded_size")
        self.named_data[name] = (encoding, decoded_size, content)

    def plan(self, payload, identity, offset):
        """4.9 PLAN."""
        require(len(payload) <= self.plan_bytes, "4.9", "size of the payload of planes", "limit-exceeded")
        reader = Reader(payload, "4.9")
        mesh, adds_to, mode = reader.unsigned(4), reader.varint(), reader.varint()
        require(mesh in self.meshes, "4.9", "the mesh is not in force")
        require(mode != MODE_ELP, "4.9", "mode elp shares nothing")
        require(adds_to <= 2 ** 32, "4.9", "adds_to")
        base = self.plans.get(adds_to - 1) if adds_to > 0 else None
        owner = (base.mesh, base.mode) if base and base.in_force else None
        require(adds_to == 0 or owner == (mesh, mode), "4.9", "what planes add to is not in force, or not theirs")
        self.index.append((PLAN_ENTRY, offset, ()))
        plan = self.plans.pop(identity, None)
        if plan is None:
            plan = Plan(mesh, adds_to, mode, base)
            if mode == MODE_BASIS:
                self.basis_part(plan, reader)
        self.plans[identity], plan.number, plan.in_force = plan, self.entries(PLAN_ENTRY), True
        if len(self.plans) > self.plans_in_force:
            del self.plans[next(iter(self.plans))]

    def basis_part(self, plan, reader):
        """7.8.1 The plan: with the last part that is wanted, all of them are decoded."""
        mesh = self.meshes[plan.mesh]
        require(plan.part <= len(mesh.lods), "7.8.1", "planes add to the last part")
        plan.fields = reader.rest()
        if plan.part != len(mesh.lods) - mesh.lod:
            return
        readers, part = [], plan
        while part:
            readers.insert(0, Reader(part.fields, "7.8.1"))
            part = part.base
        plan.basis = Basis(readers, mesh, self.components, sys.modules[__name__])

def text(data, section):
    """Text as in 4.2."""
    require(b"\0" not in data, section, "U+0000 in a text")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        require(False, section, "not UTF-8")

class Header:
    """4.5.1 The header packet: first what does not depend on the mode."""
    def __init__(self, content, decoder):
        self.reader = reader = Reader(content, "4.5.1")
        self.mesh = reader.unsigned(4)
        require(self.mesh in decoder.meshes, "4.5.1", "the mesh is not in force")
        self.first_frame, self.frame_count, self.packet_count = (reader.varint() for _ in range(3))
        require(self.first_frame <= 2 ** 62, "4.5.1", "first_frame")
        require(self.frame_count >= 1, "4.5.1", "frame_count")
        require(self.frame_count <= decoder.frames_per_gop, "4.1", "frames of a GOP", "limit-exceeded")
        require(self.frame_count + 1 <= self.packet_count <= 2 ** 31 - 1, "4.5.1", "packet_count")
        planes = reader.varint()
        require(planes <= 256, "4.5.1", "planes")
        self.planes = [reader.unsigned(4) for _ in range(planes)]
        named = [decoder.plans.get(plane) for plane in self.planes]
        require(all(plan and plan.in_force for plan in named), "4.5.1", "a plane is not in force")
        self.mode = reader.varint()
        require(self.mode in (MODE_ELP, MODE_BASIS, MODE_LOSSLESS), "4.5.1", f"mode {self.mode}", "unsupported")
        for plan in named:
            require((plan.mesh, plan.mode) == (self.mesh, self.mode), "4.5.1", "planes of another mesh or mode")
        self.named = named

    def frames(self, mesh):
        """Reads the fields of the mode; what decodes the frames of the GOP."""
        require(len(self.planes) == (1 + len(mesh.lods) if self.mode == MODE_BASIS else 0), "4.5.1", "number of planes")
        for plan, base in zip(self.named, [None] + self.named):
            require(plan.base is base, "4.5.1", "planes that are no basis")
        self.read_channels()
        if self.mode == MODE_BASIS:
            return self.rows(self.named[len(mesh.lods) - mesh.lod].basis)
        return self.elp(mesh) if self.mode == 0 else self.lossless(mesh)

    def read_channels(self):
        reader = self.reader
        count = reader.varint()
        require(1 <= count <= 256, "4.5.1", "number of channels")
        self.channels = [reader.varint() for _ in range(count)]
        require(all(a < b for a, b in zip(self.channels, self.channels[1:])), "3.5", "channels do not ascend")
        require(self.channels[0] == 1, "4.5.1", "the first channel is not positions")

    def refuse_unknown_channels(self):
        for channel in self.channels[1:]:
            require(channel % 2 == 0, "4.5.1", unknown_text(channel), "unsupported")

    def rows(self, basis):
        """The fields of mode basis."""
        self.predictors = 1 << ROWS
        self.reader.end()
        self.refuse_unknown_channels()
        return BasisFrames(basis, sys.modules[__name__])

    def lossless(self, mesh):
        """The fields of mode lossless."""
        self.predictors = 1 << PYRAMID
        kind, amount = self.reader.unsigned(1), self.reader.unsigned(1)
        require(kind < 2 and amount <= (23, 252)[kind], "4.5.1", "kind and amount")
        self.reader.end()
        require(mesh.turns, "4.5.1", "the mesh has no reference shape")
        self.refuse_unknown_channels()
        return LosslessFrames(mesh.turns, mesh.shape, line_of(kind, amount), require, Symbol, Bit)

    def elp(self, mesh):
        """The fields of mode elp."""
        reader = self.reader
        self.predictors = reader.unsigned(1)
        require(self.predictors & ~0b101111 == 0, "4.5.1", f"predictors {self.predictors}", "unsupported")
        require(self.predictors & (1 << SPACE | 1 << PYRAMID | 1 << SHAPE), "4.5.1", "nothing can predict the first frame")
        require(mesh.turns or not self.predictors >> PYRAMID, "4.5.1", "the mesh has no reference shape")
        self.fine_bits, self.coarse_bits = reader.unsigned(1), reader.unsigned(1)
        by_shape = self.predictors >> SHAPE & 1
        require(not by_shape or self.fine_bits == self.coarse_bits == mesh.shape.bits, "4.5.1", "the shape's bits")
        require(1 <= self.fine_bits <= 24, "4.5.1", "fine_bits")
        require(1 <= self.coarse_bits <= self.fine_bits, "4.5.1", "coarse_bits")
        self.origin, self.step = [reader.f64() for _ in range(3)], reader.f64()
        require(all(map(math.isfinite, self.origin)), "4.5.1", "origin")
        require(math.isfinite(self.step) and self.step > 0, "4.5.1", "step")
        self.refuse_unknown_channels()
        fine = flags(reader.rest(), mesh.gates, self.fine_bits == self.coarse_bits)
        turns = mesh.turns if self.predictors >> PYRAMID & 1 else None
        frames = Frames(mesh.gates, fine, self.fine_bits, self.coarse_bits, turns, mesh.shape)
        frames.origin, frames.step = self.origin, self.step
        return frames

    def pieces(self, content):
        """4.5.2 A frame's packet: the piece of each channel."""
        reader, pieces = Reader(content, "4.5.2"), []
        for _ in self.channels[1:]:
            pieces.append(reader.take(reader.varint()))
        return dict(zip(self.channels, pieces + [reader.rest()]))

# 5. The mesh
class Edge:
    """A border edge; its field "from" is called start. Its own number is kept too."""
    def __init__(self, start, to, across, number):
        self.start, self.to, self.across, self.number, self.open = start, to, across, number, True
        self.previous = self.next = self

def link(x, y):
    x.next, y.previous = y, x

def insert_before(edge, e):
    link(edge.previous, e)
    link(e, edge)

def meets_previous(e):
    return e.previous.to == e.start and e.previous.start != e.to

def meets_next(e):
    return e.next.start == e.to and e.next.to != e.start

class Connectivity:
    """5.1 Connectivity. Where the specification has numbers of edges, there are the edges themselves here."""
    def __init__(self, coder, V, F):
        self.coder, self.V, self.F = coder, V, F
        # 5.1.1 State
        self.faces, self.gates, self.edges, self.degree, self.edge_at = [], [], [], [0] * V, [None] * V
        # 5.1.2 Models
        self.op_coarse, self.op_fine = [Symbol(6) for _ in range(125)], [Symbol(6) for _ in range(320)]
        self.near = Symbol(weights=(2000, 2000, 15000, 15000, 5000, 5000, 2500, 2500, 1500, 1500, 1000, 1000, 500, 500,
                                    10535, 0))
        self.known = [Bit() for _ in range(3)]

    def open(self, start, to, across):
        edge = Edge(start, to, across, len(self.edges))
        self.edges.append(edge)
        self.edge_at[start] = edge
        self.edge_at[to] = self.edge_at[to] or edge
        return edge

    def close(self, edge):
        before, after = edge.previous, edge.next
        edge.open = False
        link(before, after)
        if self.edge_at[edge.start] is edge:
            self.edge_at[edge.start] = before if before is not edge and before.to == edge.start else None
        if self.edge_at[edge.to] is edge:
            self.edge_at[edge.to] = after if after is not edge and after.start == edge.to else None

    def splice(self, incoming, known):
        other = known.previous if known.start == incoming.to else known
        x, y = incoming.next, other.next
        link(incoming, y)
        link(other, x)

    def last_open(self):
        while self.edges and not self.edges[-1].open:
            self.edges.pop()
        return self.edges[-1] if self.edges else None

    def add_vertex(self, gate):
        require(len(self.gates) < self.V, "5.1.1", "too many vertices")
        self.gates.append(gate)

    def add_face(self, *corners):
        self.faces.append(corners)
        for v in corners:
            self.degree[v] = min(self.degree[v] + 1, 8)

    def decode(self):
        """5.1.3 Main loop. Returns faces and gates."""
        while len(self.faces) < self.F:
            e = self.last_open()
            if e is None:
                self.root()
            else:
                self.step(e)
        self.gates += [(NONE, NONE, NONE)] * (self.V - len(self.gates))
        self.padding()
        self.coder.finish()
        return self.faces, self.gates

    def root(self):
        """5.1.4 Root triangle."""
        n, p, c = NONE, NONE, [NONE] * 3
        for i in range(3):
            if self.gates and self.coder.bit(self.known[i]):
                c[i] = self.any_vertex()
            else:
                c[i] = len(self.gates)
                self.add_vertex((n, p, NONE))
            if i == 0:
                n = c[0]
            if i == 1 and c[1] != c[0]:
                p = c[1]
        self.add_face(*c)
        if len(set(c)) == 3:
            e0, e1, e2 = self.open(c[0], c[1], c[2]), self.open(c[1], c[2], c[0]), self.open(c[2], c[0], c[1])
            link(e0, e1)
            link(e1, e2)
            link(e2, e0)

    def any_vertex(self):
        value = self.coder.bits((len(self.gates) - 1).bit_length())
        require(value < len(self.gates), "5.1.4", "a vertex that has not been seen")
        return value

    def step(self, e):
        """5.1.5 A step over a border edge."""
        a, b, o, prev, nxt = e.start, e.to, e.across, e.previous, e.next
        situation = meets_previous(e) + 2 * meets_next(e)
        if situation == 3 and prev.start == nxt.to:
            situation = 4
        A, B = self.degree[a], self.degree[b]
        coarse = (situation * 5 + clamp(A, 3, 7) - 3) * 5 + clamp(B, 3, 7) - 3
        op = self.coder.symbol(self.op_coarse[coarse], self.op_fine[(situation * 8 + A - 1) * 8 + B - 1])
        require(op < 6, "5.1.2", "operation")
        new, to_previous, to_next, reference, boundary = op == 0, op in (1, 3), op in (2, 3), op == 4, op == 5
        if boundary:
            self.close(e)
            return
        require(meets_previous(e) or not to_previous, "5.1.5", "the previous edge does not meet")
        require(meets_next(e) or not to_next, "5.1.5", "the next edge does not meet")
        if new:
            v = len(self.gates)
            self.add_vertex((a, b, o))
        elif reference:
            v = self.near_vertex(e)
        else:
            v = prev.start if to_previous else nxt.to
        require(v == nxt.to or not (to_previous and to_next), "5.1.5", "close")
        require(v not in (a, b), "5.1.5", "degenerate triangle")
        self.add_face(b, a, v)
        known_edge = self.edge_at[v] if reference else None
        if not to_previous:
            incoming = self.open(a, v, b)
            insert_before(e, incoming)
        if not to_next:
            insert_before(e, self.open(v, b, a))
        self.close(e)
        if to_previous:
            self.close(prev)
        if to_next:
            self.close(nxt)
        if known_edge:
            self.splice(incoming, known_edge)

    def near_vertex(self, e):
        x, y, candidate = e, e, []
        for _ in range(7):
            x, y = x.next, y.previous
            candidate += [x.to, y.start]
        s = self.coder.symbol(self.near)
        require(s < 15, "5.1.2", "symbol of near")
        return candidate[s] if s < 14 else self.any_vertex()

    def padding(self):
        """5.1.6 Padding."""
        if self.coder.raw(1):
            require(self.coder.bits((self.V + self.F + 15) // 16) == 0, "5.1.6", "padding")

def vertex_order(data, gates):
    """5.2 Vertex order."""
    require(data and data[0] <= 2, "5.2", "mode")
    unused = list(range(len(gates)))  # ascending: rank(x) is bisect_left, select(r) is unused[r]
    if data[0] == 0:
        require(len(data) == 1, "5.2", "bytes behind mode 0")
        return unused
    coder = RangeDecoder(data[1:], "5.2")
    order = (near_order if data[0] == 1 else uniform_order)(coder, gates, unused)
    coder.finish()
    return order

def near_order(coder, gates, unused):
    """5.2.1 Near."""
    choice, below, length = [Symbol(5) for _ in range(5)], [Bit() for _ in range(5)], [Symbol(16) for _ in range(5)]
    order, last, V = [], 0, len(gates)

    def number(model):
        k = coder.symbol(model)
        if k == 15:
            k += coder.raw(5)
        require(k <= 32, "5.2.1", "number")
        return k if k <= 1 else 2 ** (k - 1) + coder.bits(k - 1)

    for i, (n, p, o) in enumerate(gates):
        r = [bisect_left(unused, order[w]) if w != NONE else 0 for w in (i - 1 if i > 0 else NONE, n, p, o)]
        r.append(bisect_left(unused, clamp(order[n] + order[p] - order[o], 0, V)) if o != NONE else 0)
        last = coder.symbol(choice[last])
        require(last < 5, "5.2.1", "choice")
        is_below = coder.bit(below[last])
        d = number(length[last])
        require(d < (r[last] if is_below else V - i - r[last]), "5.2.1", "rank")
        order.append(unused.pop(r[last] - 1 - d if is_below else r[last] + d))
    return order

def uniform_order(coder, gates, unused):
    """5.2.2 Uniform."""
    def uniform(bound):
        k = bound.bit_length() - 1
        u, value = 2 ** (k + 1) - bound, coder.bits(k)
        return value if value < u else 2 * value + coder.raw(1) - u

    return [unused.pop(uniform(len(unused))) for _ in gates]

# 5.3 Reference shape
def reference_shape(data, faces, V):
    """Returns where the shape has the vertices, and how many neighbours one has in the pyramid."""
    reader = Reader(data, "5.3")
    bits, neighbours = reader.unsigned(1), reader.unsigned(1)
    origin, step = [reader.f64() for _ in range(3)], reader.f64()
    require(1 <= bits <= 24, "5.3", "bits")
    require(4 <= neighbours <= 16, "5.3", "neighbours")
    require(all(map(math.isfinite, origin)), "5.3", "origin")
    require(math.isfinite(step) and step > 0, "5.3", "step")
    indices = ReferenceShape(RangeDecoder(reader.rest(), "5.3"), faces, V, bits).decode()
    return Shape(indices, origin, step, bits), neighbours

def shape_and_turns(data, faces, V, levels=()):
    """5.3 and 5.4."""
    shape, neighbours = reference_shape(data, faces, V)
    return shape, pyramid(faces, shape.indices, neighbours, levels)

class Shape:
    """5.3 Where a reference shape has the vertices: indices on a lattice."""
    def __init__(self, indices, origin, step, bits):
        self.indices, self.origin, self.step, self.bits = indices, origin, step, bits

def surroundings(faces, V):
    """5.3.1 Surroundings. For each vertex its ring and its wings."""
    rings, wings, thirds = [set() for _ in range(V)], [[] for _ in range(V)], {}
    for face in faces:
        if len(set(face)) == 3:
            for third in face:
                a, b = sorted(set(face) - {third})
                thirds.setdefault((a, b), set()).add(third)
    for (a, b), across in sorted(thirds.items()):
        rings[a].add(b)
        rings[b].add(a)
        if len(across) == 2:
            t, u = across
            wings[t].append((a, b, u))
            wings[u].append((a, b, t))
    return [sorted(ring) for ring in rings], wings

def thirds256(x):
    """About 3 log2 x, for x >= 1."""
    q = x.bit_length() - 1
    m = 256 * x // 2 ** q
    return 3 * q + (m >= 323) + (m >= 406)

FALL = (359, 452, 570, 718, 904, 1139, 1434, 1805, 2270, 2852, 3577, 4476, 5580, 6918, 8508, 10348, 12406, 14616, 16885,
        19111, 21207, 23109)

def shape_model(level):
    """model(level) of 5.3.4."""
    fall, shares = FALL[level], [2 ** 20]
    for _ in range(8):
        shares.append(shares[-1] * fall // 2 ** 15)
    shares = shares[7:0:-1] + shares[:8] + [2 * shares[8] * 2 ** 15 // (32768 - fall)]
    return Symbol(weights=scaled(shares))

class Reach:
    """5.3.5 Reach, of one class."""
    def __init__(self):
        self.product = self.square = 2 ** 14
        self.c = 256

    def learn(self, n, E, O, point, z):
        over = [e - 2 * o >> z for e, o in zip(E, O)]
        y = [2 * n * x - e >> z for e, x in zip(E, point)]
        weight = 2 ** 20 // (2 * n + sum(abs(b - (a * self.c >> 8)) for a, b in zip(over, y)))
        self.product += (weight * sum(a * b for a, b in zip(over, y)) >> 16) - (self.product >> 7)
        self.square = max(256, self.square + (weight * sum(a * a for a in over) >> 16) - (self.square >> 7))
        self.c = clamp(trunc(256 * self.product, self.square), 0, 384)

class ReferenceShape:
    """The points of a reference shape, as they are decoded."""
    def __init__(self, coder, faces, V, bits):
        self.coder, self.V, self.bits = coder, V, bits
        self.rings, self.wings = surroundings(faces, V)
        self.shape, self.residuals, self.before = [None] * V, [None] * V, None
        self.running, self.reach = [2 ** bits] * 3, [Reach() for _ in range(9)]  # by min(n, 8)
        self.first = [[[shape_model(level) for _ in range(3)] for level in range(22)] for _ in range(2)]
        self.second = [[shape_model(min(21, 2 * place + 10 + (5 if kind == 0 else 0))) for place in range(16)]
                       for kind in range(4)]
        self.longer, self.top = [[Bit() for _ in range(27)] for _ in range(2)], [Bit() for _ in range(17)]

    def decode(self):
        for v in self.order():
            self.vertex(v)
            self.before = v
        self.coder.finish()
        return self.shape

    def order(self):
        """5.3.2 Order. Each vertex in its turn; the one before is decoded by then."""
        standing, queues, lowest = [0] * self.V, [deque() for _ in range(16)], 0
        for _ in range(self.V):
            v = None
            for high in range(15, 0, -1):
                while v is None and queues[high]:
                    u = queues[high].popleft()
                    v = u if standing[u] == high and self.shape[u] is None else None  # else it has left the queue
            while v is None and self.shape[lowest] is not None:
                lowest += 1
            v = lowest if v is None else v
            yield v
            for u in self.rings[v]:
                if self.shape[u] is None and standing[u] < 15:
                    standing[u] += 1
                    queues[standing[u]].append(u)

    def vertex(self, v):
        """5.3.3 A vertex."""
        W = [wing for wing in self.wings[v][:12] if all(self.shape[u] is not None for u in wing)]
        N = [u for u in self.rings[v][:64] if self.shape[u] is not None]
        n, r, reach = len(W), len(N), self.reach[min(len(W), 8)]
        E = self.sums([u for wing in W for u in wing[:2]])
        O = self.sums([wing[2] for wing in W])
        if n > 0:
            sums, count = [e * (256 + reach.c) - 2 * reach.c * o >> 7 for e, o in zip(E, O)], 4 * n
        elif r > 0:
            sums, count = self.sums(N), r
        else:
            sums, count = [2 ** (self.bits - 1)] * 3 if self.before is None else self.shape[self.before], 1
        point, d = [], []
        for k in range(3):
            total = clamp(sums[k], 0, count * (2 ** self.bits - 1))
            p = (2 * total + count) // (2 * count)
            rest = total - count * p
            around = sum(abs(self.residuals[u][k]) for u in N) * (65536 // r) >> 8 if r > 0 else self.running[k]
            same = (around, 256 * sum(map(abs, d)), 128 * sum(map(abs, d)))[k]
            g, models = self.models((5 * self.running[k] + 6 * around + 5 * same) * (1 if n > 0 else 3) >> 4, around,
                                    2 if 8 * abs(rest) >= 3 * count else 1 if 8 * abs(rest) >= count else 0, min(n, 3))
            d.append(self.residual(v, k, p, rest < 0, g, models))
            point.append(p + d[k])
            require(0 <= point[k] < 2 ** self.bits, "5.3", "an index outside the lattice")
            if n > 0:
                self.running[k] += 256 * abs(d[k]) - self.running[k] >> 5
        self.shape[v], self.residuals[v] = point, d
        if n > 0:
            reach.learn(n, E, O, point, max(0, self.bits - 12))

    def sums(self, vertices):
        return [sum(self.shape[u][k] for u in vertices) for k in range(3)]

    def models(self, size, around, lost, kind):
        """g and the two models of a residual."""
        g = 0
        while size > 640:
            size, g = size >> 1, g + 1
        level, near = thirds256(max(size, 5)) - 6, min(around >> g, 2 ** 30)
        place = 0 if near < 77 else min(15, 1 + (thirds256(near) - 18) // 2)
        return g, (self.first[g > 0][level][lost], self.second[kind][place])

    def residual(self, _v, _axis, _p, mirrored, g, models):
        """5.3.4 A residual; -value() where it is mirrored. (Who writes shapes needs the rest to choose one.)"""
        value = self.value(g, models)
        return -value if mirrored else value

    def value(self, g, models):
        s = self.coder.symbol(*models)
        high = s - 7 if s < 15 else escape(self.coder, self.longer[g > 0])
        if g == 0:
            return high
        low = self.coder.bit(self.top[clamp(high, -8, 8) + 8]) << g - 1
        return clamp(high * 2 ** g + low + self.coder.bits(g - 1), -2 ** 27, 2 ** 27)

# 6. Entropy coding
class RangeDecoder:
    """6.1 The range coder. user: the section whose stream this is, for messages."""
    def __init__(self, data, user):
        self.data, self.user, self.range, self.shifted = data, user, 2 ** 15, 0
        self.code = self.bits_at(0, 15)

    def check(self, condition, what):
        require(condition, "6.1", f"{what}, in the stream of §{self.user}")

    def bits_at(self, place, count):
        """Bits of the stream, zero bits behind its end."""
        begin, end = place // 8, (place + count + 7) // 8
        some = int.from_bytes(self.data[begin:end].ljust(end - begin, b"\0"), "big")
        return some >> -(place + count) % 8 & 2 ** count - 1

    def shift(self, count):
        self.code = self.code << count | self.bits_at(15 + self.shifted, count)
        self.shifted += count
        self.check(self.shifted <= 8 * len(self.data), "more bits are used than there are")

    def interval(self, low, high):
        self.code -= low
        self.range = high - low
        while self.range < 2 ** 15:
            self.range *= 2
            self.shift(1)

    def symbol(self, a, b=None):
        """An adaptive symbol, coded with models a and b, or with a taken twice."""
        first, second, s, low, high = a.c, (b or a).c, -1, 0, 0
        while high <= self.code:
            s, low = s + 1, high
            high = (first[s + 1] + second[s + 1] + 8 * (s + 1)) * self.range >> 16 if s < 15 else self.range
        self.interval(low, high)
        a.adapt(s)
        if b is not None and b is not a:
            b.adapt(s)
        return s

    def bit(self, model):
        """An adaptive bit."""
        boundary = model.zero() * self.range >> 15
        value = self.code >= boundary
        self.interval(*((boundary, self.range) if value else (0, boundary)))
        model.adapt(value)
        return value

    def raw(self, k):
        self.shift(k)
        value, self.code = divmod(self.code, self.range)
        return value

    bits = raw

    def size(self):
        """What must hold after the last symbol; returns how many bytes the stream has."""
        size, behind = (self.shifted + 8) // 8, self.bits_at(self.shifted + 1, 14)
        self.check(size <= len(self.data), "more bits are used than there are")
        self.check(self.bits_at(self.shifted + 1, 8 * size - self.shifted - 1) == 0, "the last bits are not zero")
        self.check(0 <= self.code - behind < 2 ** 14, "the last interval is not settled")
        return size

    def finish(self):
        self.check(self.size() == len(self.data), "wrong length")

class TwoEnded:
    """6.1.1 Streams with two ends."""
    def __init__(self, data, user):
        self.front, self.back = RangeDecoder(data, user), RangeDecoder(data[::-1], user)

    def lane(self, axis):
        return self.back if axis == 1 else self.front

    def finish(self):
        front, back = self.front, self.back
        front.check(front.size() + back.size() == len(front.data), "the ends do not meet")

# 6.2 Adaptive models
class Bit:
    """An adaptive bit."""
    def __init__(self):
        self.fast, self.slow, self.count = 0x8000, 0x8000, 0

    def zero(self):
        m = (self.fast + self.slow) >> 2
        return m - (m >> 9) + 32

    def adapt(self, bit):
        r = min(4 + (self.count >> 2), 7)
        self.fast += -(self.fast >> 4) if bit else (0xFFFF - self.fast) >> 4
        self.slow += -(self.slow >> r) if bit else (0xFFFF - self.slow) >> r
        self.count = min(self.count + 1, 12)

def start(weights, whole):
    """The first state of an adaptive symbol with 16 weights, of a whole."""
    return [(2 ** 15 - 64) * sum(weights[:i]) // whole for i in range(16)]

def scaled(shares):
    """Weights in the proportion of the shares."""
    return [share * 65535 // sum(shares) for share in shares]

EVEN = {N: start([1] * N + [0] * (16 - N), N) for N in range(2, 17)}

class Symbol:
    """An adaptive symbol: of N equally likely ones, or with 16 weights. seen: c[0] at first."""
    S = 2 ** 15 - 64

    def __init__(self, N=16, weights=None, seen=0):
        self.c = start(weights, 65535) if weights else EVEN[N][:]
        self.c[0] = seen

    def adapt(self, s):
        S, c, age = self.S, self.c, self.c[0] >> 8
        rate = 2 + (age >= 44) + (age >= 82) + (age >= 105) + (age >= 114)
        self.c = [x + ((S if i == 0 or i > s else 0) - x >> rate) for i, x in enumerate(c)]

# 7. Frames
LARGEST = (2 - 2.0 ** -23) * 2.0 ** 127  # the largest finite binary32

def position(origin, i, edge):
    """7.1 The position of lattice index i in one axis; instead of an infinite binary32, the largest finite one."""
    return clamp(origin + (i + 0.5) * edge, -LARGEST, LARGEST)

class Level:
    """The models of one level of one set (7.3.1)."""
    def __init__(self):
        self.first, self.second = [Symbol(16) for _ in range(15)], [Symbol(16) for _ in range(15)]
        self.longer = [Bit() for _ in range(27)]

RAW = (0,) * 9 + (1, 1, 1, 2, 2, 3, 3)  # k of §7.3.2, by level
THRESHOLDS = (2, 3, 6, 9, 12, 18, 24, 33, 45, 60, 81, 108, 144, 190, 252)

def sgn2(x):
    return clamp(x, -2, 2) + 2

def sgn1(x):
    return clamp(x, -1, 1) + 1

def half(x):
    """trunc(x / 2)."""
    return x // 2 if x >= 0 else -(-x // 2)

class Frames:
    """The frames of one GOP. turns: of the pyramid, where frames may be predicted along it."""
    def __init__(self, gates, fine, fine_bits, coarse_bits, turns=None, shape=None):
        self.gates, self.fine = gates, fine
        self.B2, self.D = fine_bits, fine_bits - coarse_bits
        self.shift = [0 if is_fine else self.D for is_fine in fine]
        self.X, self.before = None, None  # padded indices of this frame and of the one before
        self.R = [[0, 0, 0] for _ in gates]
        self.levels = {}  # by set and level, made when they are first used
        self.shape = shape  # of the mesh
        self.pyramid = PyramidFrames(self, turns) if turns else None

    def hashed_values(self):
        """7.6 What the digest covers of a frame, for each vertex."""
        return self.X

    def given_out(self, v):
        """Indices and position of a vertex."""
        index, edge = [x >> self.shift[v] for x in self.X[v]], self.step * 2.0 ** self.shift[v]
        return index, [position(o, i, edge) for o, i in zip(self.origin, index)]

    def frame(self, coder, predictor):
        """7.5 A frame, from a two-ended stream."""
        self.before, self.X, self.predictor = self.X, [[0, 0, 0] for _ in self.gates], predictor
        if predictor == PYRAMID:
            self.pyramid.frame(coder)
        elif predictor == SHAPE:
            # 7.10 Frames by the shape
            self.X = [list(point) for point in self.shape.indices]
        else:
            self.frame_by_gates(coder)
        coder.finish()
        if self.pyramid:
            self.pyramid.end(predictor)

    def frame_by_gates(self, coder):
        for v, shift in enumerate(self.shift):
            found = []
            for axis in range(3):
                prediction, model_set, activity, first, second = self.predict(v, axis)
                level = sum(activity >= threshold for threshold in THRESHOLDS)
                if (model_set, level) not in self.levels:
                    self.levels[model_set, level] = Level()
                models = self.levels[model_set, level]
                s = coder.lane(axis).symbol(models.first[first], models.second[second])
                found.append((prediction, level, models, s))
            for axis, (prediction, level, models, s) in enumerate(found):
                value = self.rest(coder.lane(axis), v, axis, prediction, s, RAW[level], models.longer)
                index = prediction + value
                require(0 <= index < 2 ** (self.B2 - shift), "7.5", "an index outside its lattice")
                self.X[v][axis], self.R[v][axis] = index << shift, value << shift

    def rest(self, coder, _v, _axis, _prediction, s, k, longer):
        """rest() of 7.3.2. (Who writes frames needs the others to say it.)"""
        return rest(coder, s, k, longer)

    def predict(self, v, axis):
        """Prediction, set, activity, first and second for a vertex in an axis."""
        (n, p, o), shift, R_v, predictor = self.gates[v], self.shift[v], self.R[v][axis], self.predictor

        def now(w):
            return self.X[w][axis] >> shift

        def before(w):
            return self.before[w][axis] >> shift

        def motion(w):
            return now(w) - before(w)

        # 7.2 Predictors
        if o == NONE:
            if predictor == SPACE:
                near = n if n != NONE else v - 1
                prediction = now(near) if near >= 0 else 2 ** (self.B2 - 1) >> shift
            else:
                prediction = before(v) + (motion(n) if predictor == ELP and n != NONE else 0)
            activity = 8 * abs(R_v) if self.before else 64 if n != NONE else 255
            return prediction, 0, activity >> shift, 7, 6 + sgn1(R_v)
        if predictor == SPACE:
            prediction, lean = now(n) + now(p) - now(o), 0
        elif predictor == TIME:
            prediction, lean = before(v), -motion(n) - motion(p)
        else:
            prediction = before(v) + motion(n) + motion(p) - motion(o)
            lean = motion(n) + motion(p) - 2 * motion(o)

        # 7.3.1 Which models
        R_n, R_p, R_o = (self.R[w][axis] for w in (n, p, o))
        fine_gate = [w for w in (n, p, o) if self.fine[w]]
        h = len(fine_gate)
        if self.D == 0 or (self.fine[v] and h == 3):
            model_set = 0
        else:
            model_set = 1 + h if self.fine[v] else 4 if h == 0 else 5
        activity = (2 * (abs(R_n) + abs(R_p)) + abs(R_o) + 3 * abs(R_v)) >> shift
        first, second = 3 * sgn2(lean) + sgn1(R_n + R_p), 3 * sgn2(lean) + sgn1(R_v)
        if model_set in (1, 2, 3) and predictor != SPACE:
            if h == 0:
                pull = lean >> 1
            else:
                mean = sum(motion(w) for w in fine_gate) >> (h - 1)
                pull = sum(motion(w) - mean for w in (n, p) if not self.fine[w])
                pull -= 0 if self.fine[o] else motion(o) - mean
            pull >>= max(0, self.D - 2)
            first = clamp(pull, -7, 7) + 7
            if model_set != 3:
                second = 3 * sgn2(half(pull + (pull > 0))) + sgn1(half(R_v))
        return prediction, model_set, activity, first, second

def residual(coder, k, first, second, longer):
    """7.3.2 The value."""
    return rest(coder, coder.symbol(first, second), k, longer)

def rest(coder, s, k, longer):
    high = s - 7 if s < 15 else escape(coder, longer)
    return high if k == 0 else clamp(high * 2 ** k + coder.raw(k), -2 ** 27, 2 ** 27)

def escape(coder, longer):
    negative, length = coder.raw(1), 0
    while length < len(longer) and coder.bit(longer[length]):
        length += 1
    size = min(2 ** length + coder.bits(length) + 7, 2 ** 27)
    return -size if negative else size

# 7.7 Frames along the pyramid
NEARNESS = (4096, 2048, 1365, 1024, 819, 682, 585, 512)
PLACES = (51, 72, 102, 145, 205, 290, 410, 579, 819)
MIDDLE = (26, *PLACES)
SLOW = (None, 32768, 21845, 16384, 13107, 10922, 9362, 8192, 7281, 6553)
SHARE = (13107, 7281, 5041, 3855, 3120, 2621, 2259)
EIGHTH = (65536, 60097, 55109, 50535, 46341, 42495, 38968, 35734)

def trunc(a, b):
    """trunc(a / b), b above 0."""
    return a // b if a >= 0 else -(-a // b)

def octaves(x):
    """About 16 log2 x, for x >= 1."""
    z = x.bit_length() - 1
    return 16 * z + ((16 * x >> z) & 15)

def thirds64(x):
    """About 3 log2 x, for x >= 1."""
    q = x.bit_length() - 1
    m = 64 * x >> q
    return 3 * q + (m >= 81) + (m >= 101)

def size_level(x):
    """Which of the models by size: 0 to 25."""
    return max(thirds64(x | 1) - 6, 0)

def place_of(x):
    return sum(x >= threshold for threshold in PLACES)

def pyramid_model(x):
    """model(x) of 7.7.4."""
    factor, value, shares = 65536 // (256 + x) * x + 256, 65536, [0] * 16
    for r in range(8):
        shares[7 + r] = shares[7 - r] = value + 16
        value = value * factor >> 16
    shares[15] = value + 16
    return Symbol(weights=scaled(shares), seen=21919)

def level_model(level):
    x = next(x for x in range(5, 1538) if size_level(x) >= level)
    return pyramid_model(x + (x >> 3))

class Details:
    """The details of one vertex in one axis, and their errors (7.7.3)."""
    def __init__(self):
        self.D, self.e = [0] * 4, [256] * 4

    def take(self, d, f):
        if f == 0:
            self.D = [d] * 4
            return
        for r, known in enumerate(self.D):
            missed = clamp(d - known, -16383, 16383)
            self.e[r] += 5 * ((missed * missed >> 4) - self.e[r]) >> 4
            self.D[r] += (d - known) * (65536, 32768, 16384, SLOW[min(f, 9)])[r] >> 16

class PyramidFrames:
    """What the frames of a GOP along the pyramid need, and how they are decoded."""
    def __init__(self, frames, turns):
        self.frames, self.turns, self.f = frames, turns, 0
        V = len(turns)
        self.details = [[Details() for _ in range(3)] for _ in range(V)]
        self.sizes, self.sizes_before = ([[512] * 3 for _ in range(V)] for _ in range(2))
        self.running = [[8192] * 3 for _ in range(turns[-1].level + 1)]
        self.by_size = [[[level_model(i) for _ in range(3)] for i in range(26)],
                        [[pyramid_model(1024) for _ in range(3)] for _ in range(26)]]
        self.by_place = [[[pyramid_model((p + q) // 2) for q in MIDDLE] for p in MIDDLE] for _ in range(2)]
        self.longer = [Bit() for _ in range(27)]

    def frame(self, coder):
        """7.7.1 A vertex, for each of them."""
        self.sizes, self.sizes_before = self.sizes_before, self.sizes
        before = None
        for turn in self.turns:
            for axis in range(3):
                self.index(coder, turn, axis, before)
            self.take_details(turn)
            before = turn.vertex

    def end(self, predictor):
        """Behind a frame: its details, unless it was decoded along the pyramid."""
        if predictor != PYRAMID:
            for turn in self.turns:
                self.take_details(turn)
        self.f += 1

    def index(self, coder, turn, axis, before):
        """Decode an index. before: the vertex of the turn before."""
        v, s = turn.vertex, self.frames.shift[turn.vertex]
        cells, prediction = 2 ** (self.frames.B2 - s), self.prediction(turn, axis, before)
        rounded = clamp(prediction + 32 >> 6, 0, cells - 1)
        lost = clamp(prediction - 64 * rounded, -32, 32)
        k, models = self.models(turn, axis, lost)
        index = rounded + self.residual(coder.lane(axis), v, axis, rounded, lost < 0, k, models)
        require(0 <= index < cells, "7.5", "an index outside its lattice")
        self.frames.X[v][axis] = index << s
        # learn_size() of 7.7.4
        size, running = 4 * min(abs(64 * index - prediction), 2 ** 18), self.running[turn.level]
        self.sizes[v][axis] = size
        running[axis] += 16 * size - running[axis] >> 6

    def prediction(self, turn, axis, before):
        if self.f > 0:
            return clamp(self.mean(turn, axis) + self.detail(turn, axis), 1 - 2 ** 30, 2 ** 30 - 1)
        if turn.neighbours:
            return self.mean(turn, axis)
        nearby = 2 ** (self.frames.B2 - 1) if before is None else self.frames.X[before][axis]
        return 64 * (nearby >> self.frames.shift[turn.vertex])

    def mean(self, turn, axis):
        """7.7.2 The mean."""
        s = self.frames.shift[turn.vertex]
        total = sum(w * (self.frames.X[q][axis] >> s) for q, w in zip(turn.neighbours, turn.weights))
        return clamp(128 + total >> 8, 1 - 2 ** 30, 2 ** 30 - 1)

    def take_details(self, turn):
        """7.7.3 Details."""
        v = turn.vertex
        for axis in range(3):
            d = 64 * (self.frames.X[v][axis] >> self.frames.shift[v]) - self.mean(turn, axis)
            self.details[v][axis].take(clamp(d, -2 ** 29, 2 ** 29), self.f)

    def detail(self, turn, axis):
        own, around = self.details[turn.vertex][axis], turn.neighbours[:6]
        errors = [5 * own.e[r] + 4 * sum(self.details[q][axis].e[r] for q in around) for r in range(4)]
        L = [octaves((E * SHARE[len(around)] >> 16) + 8) for E in errors]
        steps = [min(x - min(L), 128) for x in L]
        credit = [EIGHTH[i & 7] >> (i >> 3) for i in steps]
        return own.D[0] + trunc(sum(c * (D - own.D[0]) for c, D in zip(credit, own.D)), sum(credit))

    def models(self, turn, axis, lost):
        """7.7.4 Sizes and models. Returns k and the models of a residual."""
        v, running, around = turn.vertex, self.running[turn.level][axis] >> 4, turn.neighbours[:8]
        beside = running
        if around:
            total = sum(near * self.sizes[q][axis] for near, q in zip(NEARNESS, around))
            beside = total // sum(NEARNESS[:len(around)])
        other = sum(self.sizes[v][:axis]) // axis if axis > 0 else beside
        if self.f > 0:
            x = 38 * running + 90 * beside + 77 * self.sizes_before[v][axis] + 51 * other >> 8
            other = self.sizes_before[v][axis]
        else:
            x = running + beside >> 1 if around else 51200
        k, part = 0, (abs(lost) > 9) + (abs(lost) > 21)
        while x > 1536:
            x, k = x >> 1, k + 1
        return k, (self.by_size[k > 0][size_level(x)][part],
                   self.by_place[self.f == 0][place_of(beside)][place_of(other)], self.longer)

    def residual(self, coder, _v, _axis, _rounded, mirrored, k, models):
        """signed_residual(). (Who writes frames needs the rest to choose one.)"""
        value = residual(coder, k, *models)
        return -value if mirrored else value

def flags(data, gates, one_lattice):
    """7.4 Flags. Returns for each vertex whether it is fine."""
    if one_lattice:
        require(not data, "4.5.1", "flags where B1 = B2")
        return [1] * len(gates)
    coder = RangeDecoder(data, "7.4")
    flag = flag_bits(coder, gates)
    coder.finish()
    return flag

def flag_bits(coder, gates):
    models, flag = [Bit() for _ in range(5)], []
    for gate in gates:
        flag.append(coder.bit(models[4 if gate[2] == NONE else sum(flag[w] for w in gate)]))
    return flag

def decode(path, lod=0):
    """Decode the stream in a file and draw this lod; the decoder holds what it is."""
    with open(path, "rb") as file:
        decoder = Decoder(file.read(), lod)
    decoder.decode()
    return decoder

def main(arguments):
    """Decode the files named by the arguments and print what is in them."""
    paths = [argument for argument in arguments if argument != "--check"]
    if not paths or any(path.startswith("-") for path in paths):
        print("usage: tvg_reference.py [--check] FILE.tvg...", file=sys.stderr)
        return 2
    status = 0
    for path in paths:
        name = os.path.splitext(os.path.basename(path))[0]
        try:
            decoder = decode(path)
            print(name, "valid" if "--check" in arguments else decoder.facts())
        except Invalid as error:
            print(name, error, file=sys.stdout if "--check" in arguments else sys.stderr)
            status = 3
        except OSError as error:
            print(f"error: {error}", file=sys.stderr)
            return 2
    return status

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
