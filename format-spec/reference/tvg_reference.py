#!/usr/bin/env python3
"""A second decoder of TVG streams, written from format-spec/tvg.md alone: slow, plain and strict.

It follows the order of the specification and uses its names. It does not recover from damage (§8.3): the first
violation ends it, with the number of the section that is violated. Python 3, standard library only.

    python3 tvg_reference.py FILE.tvg [--digests]

prints one JSON object: the number of frames; vertices and faces of each mesh; the metadata; and the SHA-256 of all
faces (u32), lattice indices (i32) and positions (binary32) in output order. With --digests also the digest of each GOP
(§7.6).
Exit status: 0; 2 usage, or the file cannot be read; 3 the stream is not valid.
"""
import hashlib
import json
import math
import struct
import sys
from bisect import bisect_left

class Invalid(Exception):
    """The stream violates a section of the specification."""

def require(condition, section, what, kind="malformed"):
    """Refuse the stream unless the condition holds."""
    if not condition:
        raise Invalid(f"section {section}: {kind}: {what}")

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
        require(self.at == len(self.data), self.section, "bytes left over (section 4)")

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
ANCILLARY = {b"HEAD": 0, b"META": 1, b"MESH": 0, b"GOP ": 0, b"INDX": 1, b"TAIL": 0}
LIMITS = (2 ** 24, 2 ** 25, 2 ** 16, 2 ** 28)  # §8.1: vertices, faces, frames_per_gop, packet_bytes

class Decoder:
    """Decodes one stream; the results are in its fields."""
    def __init__(self, data):
        self.data, self.metadata, self.meshes, self.frames, self.gop_digests = data, {}, [], 0, []
        self.sha_faces, self.sha_indices, self.sha_positions = hashlib.sha256(), hashlib.sha256(), hashlib.sha256()
        self.index = []  # what INDX should hold: (frame_count or 0, offset of the chunk)

    def decode(self):
        """3.1 Signature, and 3.4 Order of chunks."""
        hint = " (damaged by a transfer in text mode?)" if self.data[:4] == SIGNATURE[:4] else ""
        require(self.data[:8] == SIGNATURE, "3.1", "wrong signature" + hint, "not TVG")
        at, seen, index_at = 8, [], None
        while at < len(self.data):
            offset = at
            kind, ancillary, payload, at = self.chunk(offset)
            require(seen or kind == b"HEAD", "3.4", "the first chunk is not HEAD")
            require(b"TAIL" not in seen, "3.4", "bytes behind TAIL")
            require(ancillary or kind in ANCILLARY, "3.2", f"unknown chunk {kind}", "unsupported version")
            if kind not in ANCILLARY:
                continue
            require(ancillary == ANCILLARY[kind], "3.4", f"wrong ancillary flag of chunk {kind}")
            require(kind in (b"MESH", b"GOP ") or kind not in seen, "3.4", f"a second chunk {kind}")
            require(kind != b"META" or seen == [b"HEAD"], "3.4", "META behind the first MESH")
            require(kind not in (b"GOP ", b"INDX") or self.meshes, "3.4", f"chunk {kind} before any mesh")
            require((kind == b"TAIL") == (b"INDX" in seen), "3.4", "INDX and TAIL do not end the stream")
            seen.append(kind)
            if kind == b"HEAD":
                self.head(payload)
            elif kind == b"META":
                self.meta(payload)
            elif kind == b"MESH":
                self.mesh(payload)
                self.index.append((0, offset))
            elif kind == b"GOP ":
                self.index.append((self.gop(payload), offset))
            elif kind == b"INDX":
                self.indx(payload)
                index_at = offset
            elif kind == b"TAIL":
                self.tail(payload, offset - index_at)
        require(b"TAIL" in seen, "3.4", "no TAIL", "truncated")

    def chunk(self, at):
        """3.2 Chunks, and 3.3 Payload checksums. Returns type, ancillary bit, payload, offset of the next chunk."""
        require(at + 16 <= len(self.data), "3.2", "the stream ends in a chunk header", "truncated")
        kind, chunk_flags, length, header_checksum = struct.unpack_from("<4s3I", self.data, at)
        require(header_checksum == checksum(self.data[at:at + 12]), "3.2", "wrong header checksum")
        require(all(0x20 <= c <= 0x7E for c in kind), "3.2", "wrong characters of a chunk type")
        require(chunk_flags <= 1, "3.2", "reserved flags are set")
        require(length <= 2 ** 31 - 1, "3.2", "length of a chunk")
        end = at + 16 + length
        require(end + 4 <= len(self.data), "3.2", "the stream ends in a chunk", "truncated")
        payload = self.data[at + 16:end]
        if kind in ANCILLARY:
            payload_checksum = int.from_bytes(self.data[end:end + 4], "little")
            require(payload_checksum == checksum(payload), "3.3", f"wrong payload checksum of chunk {kind}")
        return kind, chunk_flags, payload, end + 4

    # 4. Payloads
    def head(self, payload):
        """4.1 HEAD."""
        reader = Reader(payload, "4.1")
        major, minor = reader.unsigned(2), reader.unsigned(2)
        require(major == 0 and minor <= 1, "4.1", f"version {major}.{minor}", "unsupported version")
        require(minor == 1, "4.1", "minor")
        require(reader.unsigned(4) == 0, "4.1", "reserved")
        bounds = [reader.unsigned(4) for _ in range(4)]
        self.vertices, self.faces, self.frames_per_gop, self.packet_bytes = bounds
        memory = 2 ** 20 + 160 * self.vertices + 96 * self.faces + 4 * self.packet_bytes  # §8.2
        require(reader.unsigned(8) == memory, "4.1", "decoder_memory")
        reader.end()
        for bound, limit in zip(bounds, LIMITS):
            require(bound <= limit, "8.1", "more than this decoder allows", "limit-exceeded")

    def meta(self, payload):
        """4.2 META."""
        require(len(payload) <= 2 ** 20, "4.2", "size of the metadata")
        reader = Reader(payload, "4.2")
        count = reader.varint()
        require(count <= (len(payload) - reader.at) // 2, "4.2", "number of entries")
        last = b""
        for _ in range(count):
            key, value = reader.take(reader.varint()), reader.take(reader.varint())
            require(key > last, "4.2", "keys are empty or do not ascend")
            require(b"\0" not in key + value, "4.2", "U+0000 in a text")
            last = key
            try:
                self.metadata[key.decode("utf-8")] = value.decode("utf-8")
            except UnicodeDecodeError:
                require(False, "4.2", "not UTF-8")
        reader.end()

    def mesh(self, payload):
        """4.3 MESH."""
        self.mesh_checksum = checksum(payload)
        require(len(payload) <= 64 + 16 * (self.vertices + self.faces), "4.3", "payload size", "limit-exceeded")
        reader = Reader(payload, "4.3")
        V, F = reader.varint(), reader.varint()
        require(1 <= V <= 2 ** 31 - 1, "4.3", "vertex_count")
        require(F <= 2 ** 31 - 1, "4.3", "face_count")
        require(V <= self.vertices and F <= self.faces, "4.1", "size of a mesh", "limit-exceeded")
        has_order = reader.unsigned(1)
        require(has_order <= 1, "4.3", "order")
        faces, self.gates = Connectivity(reader.take(reader.varint()), V, F).decode()
        self.order = vertex_order(reader.rest(), self.gates) if has_order else list(range(V))
        reader.end()
        self.meshes.append((V, F))
        for face in faces:
            self.sha_faces.update(struct.pack("<3I", *(self.order[corner] for corner in face)))

    def gop(self, payload):
        """4.5 GOP. Returns frame_count."""
        reader = Reader(payload, "4.5")

        def packet(seed):
            size = reader.varint()
            require(size <= self.packet_bytes, "4.1", "size of a packet", "limit-exceeded")
            content, packet_checksum = reader.take(size), reader.unsigned(4)
            require(packet_checksum == checksum(content, seed), "4.5", "wrong packet checksum")
            return content, packet_checksum

        # 4.5.1 The header packet
        content, header_checksum = packet(0)
        header = Reader(content, "4.5.1")
        mode, predictor, fine_bits, coarse_bits = (header.unsigned(1) for _ in range(4))
        require(mode == 0, "4.5.1", "mode")
        require(predictor <= 2, "4.5.1", "predictor")
        require(1 <= fine_bits <= 24, "4.5.1", "fine_bits")
        require(1 <= coarse_bits <= fine_bits, "4.5.1", "coarse_bits")
        origin, step = [header.f64() for _ in range(3)], header.f64()
        require(all(map(math.isfinite, origin)), "4.5.1", "origin")
        require(math.isfinite(step) and step > 0, "4.5.1", "step")
        first_frame, frame_count = header.varint(), header.varint()
        require(first_frame <= 2 ** 62, "4.5.1", "first_frame")
        require(frame_count >= 1, "4.5.1", "frame_count")
        require(frame_count <= self.frames_per_gop, "4.1", "frames of a GOP", "limit-exceeded")
        fine = flags(header.rest(), self.gates, fine_bits == coarse_bits)

        frames = Frames(self.gates, fine, fine_bits, coarse_bits, ("space", "time", "elp")[predictor])
        hashed = bytearray()
        for k in range(1, frame_count + 1):
            frames.frame(packet((header_checksum ^ self.mesh_checksum) * 2 ** 32 + k)[0])
            hashed += b"".join(struct.pack("<4I", *index, 0) for index in frames.X)
            self.output(frames, origin, step)
        # 7.6 The digest
        digest = packet((header_checksum ^ self.mesh_checksum) * 2 ** 32 + frame_count + 1)[0]
        require(len(digest) == 8, "4.5", "size of the digest")
        self.gop_digests.append(xxh64(bytes(hashed)))
        require(int.from_bytes(digest, "little") == self.gop_digests[-1], "7.6", "wrong digest", "digest-mismatch")
        reader.end()
        return frame_count

    def output(self, frames, origin, step):
        """Give out one frame, in output order (4.3)."""
        indices, positions = [None] * len(self.order), [None] * len(self.order)
        for v, place in enumerate(self.order):
            index = [x >> frames.shift[v] for x in frames.X[v]]
            indices[place] = struct.pack("<3i", *index)
            edge = step * 2.0 ** frames.shift[v]
            positions[place] = struct.pack("<3f", *(position(o, i, edge) for o, i in zip(origin, index)))
        self.sha_indices.update(b"".join(indices))
        self.sha_positions.update(b"".join(positions))
        self.frames += 1

    def indx(self, payload):
        """4.6 INDX."""
        reader, last = Reader(payload, "4.6"), 0
        require(reader.varint() == len(self.index), "4.6", "number of entries")
        for count, offset in self.index:
            require(reader.varint() == count, "4.6", "number of frames")
            require(reader.varint() == offset - last, "4.6", "distance")
            last = offset
        reader.end()

    def tail(self, payload, distance):
        """4.7 TAIL."""
        reader = Reader(payload, "4.7")
        require(reader.unsigned(8) == distance, "4.7", "distance to INDX")
        reader.end()

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
    def __init__(self, data, V, F):
        require(V + F <= 128 * len(data) and F <= 2 ** 30, "5.1", "too many vertices or faces", "limit-exceeded")
        self.V, self.F, self.coder = V, F, RangeDecoder(data, "5.1")
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
        value = self.coder.bits(0, (len(self.gates) - 1).bit_length())
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
            require(self.coder.bits(0, (self.V + self.F + 15) // 16) == 0, "5.1.6", "padding")

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
        return k if k <= 1 else coder.bits(1, k - 1)

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
        u, value = 2 ** (k + 1) - bound, coder.bits(0, k)
        return value if value < u else 2 * value + coder.raw(1) - u

    return [unused.pop(uniform(len(unused))) for _ in gates]

# 6. Entropy coding
class RangeDecoder:
    """6.1 The range coder. user: the section whose stream this is, for messages."""
    def __init__(self, data, user):
        self.data, self.user, self.range, self.shifted = data, user, 2 ** 32 - 1, 0
        self.code = int.from_bytes(data[:4].ljust(4, b"\0"), "big")

    def check(self, condition, what):
        require(condition, "6.1", f"{what}, in the stream of section {self.user}")

    def next_bit(self):
        byte, bit = divmod(32 + self.shifted, 8)
        self.shifted += 1
        self.check(self.shifted <= 8 * len(self.data), "more bits are used than there are")
        return self.data[byte] >> (7 - bit) & 1 if byte < len(self.data) else 0

    def interval(self, low, frequency):
        unit = self.range >> 15
        self.code -= unit * low
        self.range = unit * frequency
        while self.range < 2 ** 31:
            self.range *= 2
            self.code = 2 * self.code + self.next_bit()

    def target(self):
        t = self.code // (self.range >> 15)
        self.check(t < 2 ** 15, "code out of range")
        return t

    def symbol(self, a, b=None):
        """An adaptive symbol, coded with models a and b, or with a taken twice."""
        b = b or a
        cumulative = [((a.c[i] + b.c[i] + 1) >> 1) + 4 * i for i in range(16)] + [2 ** 15]
        t, s = self.target(), 0
        while cumulative[s + 1] <= t:
            s += 1
        self.interval(cumulative[s], cumulative[s + 1] - cumulative[s])
        for model in {a, b}:
            model.adapt(s)
        return s

    def bit(self, model):
        """An adaptive bit."""
        zero = model.zero()
        value = self.target() >= zero  # the same as code >= (range >> 15) * zero
        self.interval(*((zero, 2 ** 15 - zero) if value else (0, zero)))
        model.adapt(value)
        return value

    def raw(self, k):
        v = self.target() >> (15 - k)
        self.interval(v << (15 - k), 1 << (15 - k))
        return v

    def bits(self, value, left):
        """The loop of §5 and §7: raw bits appended to value, at most 15 at a time."""
        while left > 0:
            m = min(left, 15)
            left -= m
            value = value * 2 ** m + self.raw(m)
        return value

    def finish(self):
        length = len(self.data)
        self.check(length == (self.shifted + 8) // 8, "wrong length")
        self.check(self.data[-1] % 2 ** (8 * length - self.shifted - 1) == 0, "the last bits are not zero")
        self.check(self.code < 2 ** 31, "the last interval is not settled")

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

class Symbol:
    """An adaptive symbol: of N equally likely ones, or with 16 weights."""
    S = 2 ** 15 - 64

    def __init__(self, N=16, weights=None):
        self.count = 0
        self.c = [self.S * (sum(weights[:i]) if weights else min(i, N)) // (65535 if weights else N) for i in range(16)]

    def adapt(self, s):
        rate = 2 + sum(self.count >= bound for bound in (2, 6, 16, 32))
        for i in range(1, 16):
            self.c[i] += ((self.S if i > s else 0) - self.c[i]) >> rate
        self.count = min(self.count + 1, 32)

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

THRESHOLDS = (2, 3, 6, 9, 12, 18, 24, 33, 45, 60, 81, 108, 144, 190, 252)

def sgn2(x):
    return clamp(x, -2, 2) + 2

def sgn1(x):
    return clamp(x, -1, 1) + 1

def half(x):
    """trunc(x / 2)."""
    return x // 2 if x >= 0 else -(-x // 2)

class Frames:
    """The frames of one GOP."""
    def __init__(self, gates, fine, fine_bits, coarse_bits, predictor):
        self.gates, self.fine, self.predictor = gates, fine, predictor
        self.B2, self.D = fine_bits, fine_bits - coarse_bits
        self.shift = [0 if is_fine else self.D for is_fine in fine]
        self.X, self.before = None, None  # padded indices of this frame and of the one before
        self.R = [[0, 0, 0] for _ in gates]
        self.sets = [[Level() for _ in range(16)] for _ in range(6)]

    def frame(self, packet):
        """7.5 A frame."""
        coder = RangeDecoder(packet, "7.5")
        self.before, self.X = self.X, [[0, 0, 0] for _ in self.gates]
        for v, shift in enumerate(self.shift):
            for axis in range(3):
                prediction, model_set, activity, first, second = self.predict(v, axis)
                level = sum(activity >= threshold for threshold in THRESHOLDS)
                value = residual(coder, level, self.sets[model_set][level], first, second)
                index = prediction + value
                require(0 <= index < 2 ** (self.B2 - shift), "7.5", "an index outside its lattice")
                self.X[v][axis], self.R[v][axis] = index << shift, value << shift
        coder.finish()

    def predict(self, v, axis):
        """Prediction, set, activity, first and second for a vertex in an axis."""
        (n, p, o), shift, R_v = self.gates[v], self.shift[v], self.R[v][axis]
        predictor = self.predictor if self.before else "space"

        def now(w):
            return self.X[w][axis] >> shift

        def before(w):
            return self.before[w][axis] >> shift

        def motion(w):
            return now(w) - before(w)

        # 7.2 Predictors
        if o == NONE:
            if predictor == "space":
                near = n if n != NONE else v - 1
                prediction = now(near) if near >= 0 else 2 ** (self.B2 - 1) >> shift
            else:
                prediction = before(v) + (motion(n) if predictor == "elp" and n != NONE else 0)
            activity = 8 * abs(R_v) if self.before else 64 if n != NONE else 255
            return prediction, 0, activity >> shift, 7, 6 + sgn1(R_v)
        if predictor == "space":
            prediction, lean = now(n) + now(p) - now(o), 0
        elif predictor == "time":
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
        if model_set in (1, 2, 3) and predictor != "space":
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

def residual(coder, level, models, first, second):
    """7.3.2 The value."""
    k = 0 if level <= 10 else (1, 1, 2, 2, 3)[level - 11]
    s = coder.symbol(models.first[first], models.second[second])
    high = s - 7 if s < 15 else escape(coder, models.longer)
    return high if k == 0 else clamp(high * 2 ** k + coder.raw(k), -2 ** 27, 2 ** 27)

def escape(coder, longer):
    negative, length = coder.raw(1), 0
    while length < 27 and coder.bit(longer[length]):
        length += 1
    size = min(coder.bits(1, length) + 7, 2 ** 27)
    return -size if negative else size

def flags(data, gates, one_lattice):
    """7.4 Flags. Returns for each vertex whether it is fine."""
    if one_lattice:
        require(not data, "4.5.1", "flags where B1 = B2")
        return [1] * len(gates)
    coder, models, flag = RangeDecoder(data, "7.4"), [Bit() for _ in range(5)], []
    for gate in gates:
        flag.append(coder.bit(models[4 if gate[2] == NONE else sum(flag[w] for w in gate)]))
    coder.finish()
    return flag

def main(arguments):
    """Decode the file named by the arguments and print what is in it."""
    names = [argument for argument in arguments if argument != "--digests"]
    if len(names) != 1:
        print("usage: tvg_reference.py FILE.tvg [--digests]", file=sys.stderr)
        return 2
    try:
        with open(names[0], "rb") as file:
            decoder = Decoder(file.read())
        decoder.decode()
    except (OSError, Invalid) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3 if isinstance(error, Invalid) else 2
    result = {"frames": decoder.frames, "vertices": [V for V, _ in decoder.meshes],
              "faces": [F for _, F in decoder.meshes], "metadata": decoder.metadata,
              "faces_sha256": decoder.sha_faces.hexdigest(),
              "indices_sha256": decoder.sha_indices.hexdigest(), "positions_sha256": decoder.sha_positions.hexdigest()}
    if "--digests" in arguments:
        result["gop_digests"] = [f"{digest:016x}" for digest in decoder.gop_digests]
    print(json.dumps(result, indent=2))
    return 0

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
