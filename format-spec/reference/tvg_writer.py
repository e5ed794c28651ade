"""Writes TVG streams, from format-spec/tvg.md alone: what random_streams.py and negative_streams.py stand on.

Chunks, packets and payloads are made from their fields, whether they are valid or not. Range-coder streams are written
by the reference decoder's own code: it asks a coder for symbols and bits, and a RangeEncoder answers with what it was
told to say and writes it down.
"""
import struct
from bisect import bisect_left
from collections import deque

import tvg_levels
import tvg_reference as reference
from tvg_lossless import LosslessFrames, line_of
from tvg_reference import ANCILLARY, NONE, SIGNATURE, checksum, xxh64

class Random:
    """The same numbers from the same seed everywhere: splitmix64."""
    def __init__(self, seed):
        self.state = seed

    def below(self, bound):
        self.state = self.state + 0x9E3779B97F4A7C15 & reference.MASK
        z = (self.state ^ self.state >> 30) * 0xBF58476D1CE4E5B9 & reference.MASK
        z = (z ^ z >> 27) * 0x94D049BB133111EB & reference.MASK
        return (z ^ z >> 31) % bound

    def between(self, low, high):
        return low + self.below(high - low + 1)

    def chance(self, percent):
        return self.below(100) < percent

    def pick(self, values):
        return values[self.below(len(values))]

    def shuffled(self, values):
        values = list(values)
        for i in range(len(values) - 1, 0, -1):
            j = self.below(i + 1)
            values[i], values[j] = values[j], values[i]
        return values

    def some_bytes(self, size):
        return bytes(self.below(256) for _ in range(size))

# 2.2 Varint
def varint(value):
    data = b""
    while value >= 0x80:
        data += bytes([value & 0x7F | 0x80])
        value >>= 7
    return data + bytes([value])

def sized(data):
    return varint(len(data)) + data

# 3.2 Chunks
def chunk_header(kind, length, flags=None):
    header = kind + struct.pack("<2I", ANCILLARY[kind] if flags is None else flags, length)
    return header + struct.pack("<I", checksum(header))

def chunk(kind, payload, flags=None):
    return chunk_header(kind, len(payload), flags) + payload + struct.pack("<I", checksum(payload))

# 4.1 HEAD
KEYS = {"vertices": 1, "faces": 3, "frames_per_gop": 5, "packet_bytes": 7, "decoder_memory": 9, "meshes": 11,
        "mesh_bytes": 13, "plan_bytes": 15, "components": 17, "plans": 19, "property_bytes": 21}

def memory(vertices, faces, packet_bytes, meshes, mesh_bytes, plan_bytes=0, components=0, plans=1, property_bytes=0,
           shapes=False, lods=False, **_):
    """8.2 Memory. shapes, lods: whether meshes have reference shapes, coarse meshes."""
    planes = plan_bytes + plans * (4096 + components * (64 + 4 * vertices) + 8 * vertices) + 128 * vertices + 1536 * components
    return (2 ** 20 + 160 * vertices + 96 * faces + 4 * packet_bytes + mesh_bytes
            + (meshes - 1) * (512 + 24 * vertices + 16 * faces)
            + ((meshes + 1) * property_bytes + 192 * vertices + 512 * faces if property_bytes else 0)
            + (vertices * (400 + 128 * meshes) + 96 * faces if shapes or lods or plan_bytes else 0)
            + (planes if plan_bytes else 0)
            + (plans * plan_bytes + 2 ** 18 + vertices * (64 + 16 * meshes) + faces * (96 + 16 * meshes) if lods else 0))

def head(version=(0, 2), others=None, **bounds):
    """others: values of keys that have no name. A bound that is None is left out."""
    pairs = {KEYS[name]: value for name, value in bounds.items() if value is not None} | (others or {})
    return struct.pack("<2H", *version) + b"".join(varint(key) + varint(pairs[key]) for key in sorted(pairs))

# 4.2 META
def meta(entries):
    return varint(len(entries)) + b"".join(sized(key) + sized(value) for key, value in entries)

# 4.3 MESH
def mesh(V, F, sections):
    """sections: pairs of kind and content."""
    return varint(V) + varint(F) + b"".join(varint(kind) + sized(content) for kind, content in sections)

# 4.5 GOP
def packet(kind, content, seed=0):
    covered = bytes([kind]) + sized(content)
    return covered + struct.pack("<I", checksum(covered, seed))

def gop(packets):
    """A payload of packets: pairs of kind and content, the header first."""
    payload = packet(*packets[0])
    seed = int.from_bytes(payload[-4:], "little") * 2 ** 32
    return payload + b"".join(packet(kind, content, seed + k) for k, (kind, content) in enumerate(packets[1:], 1))

def gop_header(mesh_id, first_frame, frame_count, packet_count, planes=(), mode=0, fields=b""):
    """4.5.1 The header packet."""
    counts = varint(first_frame) + varint(frame_count) + varint(packet_count) + varint(len(planes))
    return struct.pack(f"<I{len(counts)}s{len(planes)}I", mesh_id, counts, *planes) + varint(mode) + fields

def predictors_of(packets):
    """The predictors of the frames among packets, as a header names them."""
    kinds = {kind for kind, _ in packets if 32 <= kind <= 35}
    return sum(1 << kind - 32 for kind in kinds)

def channel_fields(channels=(1,)):
    """All fields of mode basis, and the first of the others."""
    return varint(len(channels)) + b"".join(map(varint, channels))

def elp_fields(predictors, fine_bits, coarse_bits, origin, step, flags=b"", channels=(1,)):
    return (channel_fields(channels) + bytes([predictors, fine_bits, coarse_bits])
            + struct.pack("<4d", *origin, step) + flags)

def lossless_fields(kind, amount, channels=(1,)):
    return channel_fields(channels) + bytes([kind, amount])

def digest(values):
    """4.5.3 The digest packet. values: the digest of each channel."""
    return b"".join(varint(channel) + struct.pack("<Q", value) for channel, value in values)

# 4.6 INDX
def indx(entries):
    """entries: kind, offset of the chunk, fields."""
    payload, last = varint(len(entries)), 0
    for kind, offset, fields in entries:
        payload += varint(kind) + varint(offset - last) + sized(fields)
        last = offset
    return payload

# 4.8 DATA
def data(name, encoding, decoded_size, content):
    return sized(name) + bytes([encoding]) + varint(decoded_size) + content

# 4.9 PLAN
def plan(mesh_id, adds_to, mode, fields=b""):
    return struct.pack("<I", mesh_id) + varint(adds_to) + varint(mode) + fields

class Stream:
    """Puts chunks one behind the other and keeps what INDX holds of them (4.6)."""
    def __init__(self):
        self.data, self.entries, self.index_at = bytearray(SIGNATURE), [], None
        self.latest = {1: [], 2: []}  # ids of meshes and planes, in the order of their entries

    def add(self, kind, payload, flags=None):
        """Adds a chunk that needs no entry. Returns its id."""
        self.data += chunk(kind, payload, flags)
        return checksum(payload)

    def add_named(self, kind, payload):
        """Adds a mesh or a plan. Returns its id."""
        entry = {b"MESH": 1, b"PLAN": 2}[kind]
        self.entries.append((entry, len(self.data), b""))
        self.latest[entry].append(checksum(payload))
        return self.add(kind, payload)

    def back(self, entry, identity):
        """How many entries to go back to the latest of an id; 1 where there is none."""
        latest = self.latest[entry][::-1]
        return latest.index(identity) + 1 if identity in latest else 1

    def add_gop(self, payload, mesh_id, frame_count, planes=()):
        backs = [self.back(2, plane) for plane in planes]
        fields = (frame_count, self.back(1, mesh_id), len(planes), *backs)
        self.entries.append((3, len(self.data), b"".join(map(varint, fields))))
        self.add(b"GOP ", payload)

    def add_indx(self, payload=None):
        self.index_at = len(self.data)
        self.add(b"INDX", indx(self.entries) if payload is None else payload)

    def add_tail(self):
        self.add(b"TAIL", struct.pack("<Q", len(self.data) - (self.index_at or 0)))

# 6.1 The range coder
class RangeEncoder:
    """Answers as a RangeDecoder would, with the values of the queue, and writes them down."""
    def __init__(self):
        self.queue, self.low, self.range, self.shifted, self.data = deque(), 0, 2 ** 15, 0, b""

    def say(self, *values):
        self.queue.extend(values)

    def clear(self):
        """Takes back what has not been asked for."""
        self.queue.clear()

    def interval(self, low, high):
        self.low += low
        self.range = high - low
        while self.range < 2 ** 15:
            self.range *= 2
            self.low *= 2
            self.shifted += 1

    def symbol(self, a, b=None):
        s = self.queue.popleft()
        cumulative = [x + y + 8 * i for i, (x, y) in enumerate(zip(a.c, (b or a).c))] + [2 ** 16]
        cumulative[0] = 0
        self.interval(*(boundary * self.range >> 16 for boundary in cumulative[s:s + 2]))
        for model in {a, b or a}:
            model.adapt(s)
        return s

    def bit(self, model):
        value, boundary = self.queue.popleft(), model.zero() * self.range >> 15
        self.interval(*((boundary, self.range) if value else (0, boundary)))
        model.adapt(value)
        return value

    def raw(self, k):
        value = self.queue.popleft()
        self.low = (self.low << k) + value * self.range
        self.shifted += k
        return value

    bits = raw

    def finish(self):
        """Settles the final interval by one bit more: the shortest stream that leads into it, whatever follows."""
        assert not self.queue
        length = (self.shifted + 8) // 8
        settled = -(-self.low // 2 ** 14)  # the bits above the last 14, rounded up
        self.data = (settled << 8 * length - self.shifted - 1).to_bytes(length, "big")

class Ends(bytes):
    """The bytes of a two-ended stream."""
    front = 0  # how many of them are read from the front

class TwoEnded:
    """6.1.1 Streams with two ends."""
    def __init__(self):
        self.front, self.back, self.data = RangeEncoder(), RangeEncoder(), b""

    def lane(self, axis):
        return self.back if axis == 1 else self.front

    def clear(self):
        self.front.clear()
        self.back.clear()

    def finish(self):
        self.front.finish()
        self.back.finish()
        self.data = Ends(self.front.data + self.back.data[::-1])
        self.data.front = len(self.front.data)

# 5.1 Connectivity
class RandomConnectivity(reference.Connectivity):
    """Chooses a valid mesh at random and writes it; its bytes are in coder.data after decode()."""
    def __init__(self, V, F, random):
        super().__init__(RangeEncoder(), V, F)
        self.random = random

    def root(self):
        seen = len(self.gates)
        for _ in range(3):
            known = seen > 0 and (seen == self.V or self.random.chance(15))
            if seen > 0:
                self.coder.say(int(known))
            if known:
                self.coder.say(self.random.below(seen))
            seen += not known
        super().root()

    def step(self, e):
        a, b, seen = e.start, e.to, len(self.gates)
        before, after = e.previous.start, e.next.to
        previous = reference.meets_previous(e) and before not in (a, b)
        following = reference.meets_next(e) and after not in (a, b)
        choices = [5] + [0] * 6 * (seen < self.V) + [1] * 2 * previous + [2] * 2 * following
        choices += [3] * 4 * (previous and following and before == after) + [4] * (seen > 2)
        operation = self.random.pick(choices)
        self.coder.say(operation)
        if operation == 4:
            self.choose_reference(e)
        super().step(e)

    def choose_reference(self, e):
        """A vertex other than those of the edge, by its first candidate or by its number."""
        v = self.random.pick([v for v in range(len(self.gates)) if v not in (e.start, e.to)])
        x, y, candidates = e, e, []
        for _ in range(7):
            x, y = x.next, y.previous
            candidates += [x.to, y.start]
        self.coder.say(*([candidates.index(v)] if v in candidates else [14, v]))

    def padding(self):
        self.coder.say(0)
        super().padding()

def padded(V):
    """The connectivity of V vertices and no faces, with padding (5.1.6)."""
    coder = RangeEncoder()
    coder.say(1, 0)
    faces_and_gates = reference.Connectivity(coder, V, 0).decode()
    return coder.data, faces_and_gates

# 5.2 Vertex order
def identity_order():
    return b"\0"

def say_number(coder, d):
    """number() of 5.2.1."""
    k = d.bit_length()
    coder.say(min(k, 15))
    if k >= 15:
        coder.say(k - 15)
    if k > 1:
        coder.say(d - 2 ** (k - 1))

def near_order(order, gates, random):
    """5.2.1 Near. Which rank an index is near to is chosen at random."""
    coder, unused = RangeEncoder(), list(range(len(order)))

    def rank(v):
        return bisect_left(unused, order[v]) if v != NONE else 0

    for i, (n, p, o) in enumerate(gates):
        around = max(0, min(order[n] + order[p] - order[o], len(order))) if o != NONE else 0
        ranks = [rank(i - 1 if i > 0 else NONE), rank(n), rank(p), rank(o), bisect_left(unused, around)]
        choice, target = random.below(5), bisect_left(unused, order[i])
        distance = target - ranks[choice]
        coder.say(choice, int(distance < 0))
        say_number(coder, distance if distance >= 0 else -distance - 1)
        del unused[target]
        # The reference reads it in step, so that its models adapt.
    assert reference.near_order(coder, gates, list(range(len(order)))) == list(order)
    coder.finish()
    return b"\1" + coder.data

def uniform_order(order):
    """5.2.2 Uniform."""
    coder, unused = RangeEncoder(), list(range(len(order)))
    for index in order:
        rank, bound = bisect_left(unused, index), len(unused)
        k = bound.bit_length() - 1
        u = 2 ** (k + 1) - bound
        coder.say(*([rank] if rank < u else [rank + u >> 1, rank + u & 1]))
        unused.remove(index)
    assert reference.uniform_order(coder, order, list(range(len(order)))) == list(order)
    coder.finish()
    return b"\2" + coder.data

# 5.5 Levels
def levels(level, gates):
    """The section of these levels, valid or not."""
    n, coder = max(level) + 1, RangeEncoder()
    for l in level:
        coder.say(*([0] * (n - 1 - l) + [1] * (l > 0)))
    tvg_levels.level_bits(coder, gates, n, tvg_levels.level_models(reference), NONE)
    coder.finish()
    return bytes([n]) + coder.data

# 5.6 Coarse meshes
def lods(meshes):
    """meshes: levels, vertex_count, face_count, connectivity and order of each."""
    return varint(len(meshes)) + b"".join(b"".join(map(varint, fields)) + sized(connectivity) + sized(order)
                                          for *fields, connectivity, order in meshes)

# 5.3 Reference shape
class ShapeWriter(reference.ReferenceShape):
    """Writes a shape whose indices are chosen by a function of vertex, axis, guess and number of cells."""
    def __init__(self, faces, V, bits, choose):
        super().__init__(RangeEncoder(), faces, V, bits)
        self.choose = choose

    def residual(self, v, axis, p, mirrored, g, models):
        d = self.choose(v, axis, p, 2 ** self.bits) - p
        value = -d if mirrored else d
        say_high(self.coder, value >> g)
        if g > 0:
            self.coder.say(value >> g - 1 & 1, value % 2 ** (g - 1))
        return super().residual(v, axis, p, mirrored, g, models)

def reference_shape(bits, neighbours, origin, step, stream):
    return struct.pack("<2B4d", bits, neighbours, *origin, step) + stream

# 7.4 Flags
def flags(fine, gates):
    coder = RangeEncoder()
    coder.say(*fine)
    reference.flag_bits(coder, gates)
    coder.finish()
    return coder.data

# 7. Frames
def symbol_of(high):
    return high + 7 if -7 <= high <= 7 else 15

def say_escape(coder, high):
    """What a symbol does not say."""
    if symbol_of(high) == 15:
        rest = abs(high) - 7
        length = rest.bit_length() - 1
        coder.say(int(high < 0), *[1] * length, *[0] * (length < 27), rest - 2 ** length)

def say_high(coder, high):
    """A symbol, and its escape."""
    coder.say(symbol_of(high))
    say_escape(coder, high)

def say_rest(coder, value, k):
    """rest() of 7.3.2."""
    high = value >> k
    say_escape(coder, high)
    if k > 0:
        coder.say(value - (high << k))

def say_residual(coder, value, k):
    """7.3.2 The value."""
    coder.say(symbol_of(value >> k))
    say_rest(coder, value, k)

class FrameWriter(reference.Frames):
    """Writes frames whose indices are chosen by a function of vertex, axis, prediction and number of cells."""
    def __init__(self, gates, fine, fine_bits, coarse_bits, choose, turns=None):
        super().__init__(gates, fine, fine_bits, coarse_bits)
        self.choose, self.hashed, self.values = choose, b"", [0] * 3
        self.pyramid = PyramidWriter(self, turns) if turns else None

    def predict(self, v, axis):
        found = super().predict(v, axis)
        cells = 2 ** (self.B2 - self.shift[v])
        level = sum(found[2] >= threshold for threshold in reference.THRESHOLDS)
        self.values[axis] = self.choose(v, axis, found[0], cells) - found[0]
        self.coder.lane(axis).say(symbol_of(self.values[axis] >> reference.RAW[level]))
        return found

    def rest(self, coder, v, axis, prediction, s, k, longer):
        say_rest(coder, self.values[axis], k)
        return super().rest(coder, v, axis, prediction, s, k, longer)

    def write(self, predictor):
        """Returns the stream of the next frame (7.5)."""
        self.coder = TwoEnded()
        self.frame(self.coder, predictor)
        self.hashed += b"".join(struct.pack("<3i", *index) for index in self.X)
        return self.coder.data

    def digest(self):
        """7.6 The digest."""
        return xxh64(self.hashed)

class PyramidWriter(reference.PyramidFrames):
    """7.7: what a FrameWriter writes along the pyramid."""
    def residual(self, coder, v, axis, rounded, mirrored, k, models):
        cells = 2 ** (self.frames.B2 - self.frames.shift[v])
        d = self.frames.choose(v, axis, rounded, cells) - rounded
        say_residual(coder, -d if mirrored else d, k)
        return super().residual(coder, v, axis, rounded, mirrored, k, models)

class LosslessWriter(LosslessFrames):
    """7.9: writes frames whose numbers are chosen by a function of vertex, axis, rounded prediction and line."""
    def __init__(self, turns, shape, kind, amount, choose):
        super().__init__(turns, shape, line_of(kind, amount), reference.require, reference.Symbol, reference.Bit)
        self.choose, self.hashed = choose, b""

    def residual(self, coder, v, axis, rounded, known):
        wanted = (self.choose(v, axis, rounded, self.line) - rounded + 2 ** 31) % 2 ** 32 - 2 ** 31
        length = abs(wanted).bit_length()
        symbol = reference.clamp(length - known.base + 9, 0, 15)
        coder.say(symbol, *[length] * (symbol in (0, 15)))
        if length > 0:
            coder.say(int(wanted < 0))
        if length > 1:
            coder.say(abs(wanted) >> length - 2 & 1, abs(wanted) % 2 ** (length - 2))
        return super().residual(coder, v, axis, rounded, known)

    def write(self, predictor):
        """Returns the stream of the next frame."""
        self.coder = TwoEnded()
        self.frame(self.coder, predictor)
        self.hashed += b"".join(struct.pack("<3i", *values) for values in self.hashed_values())
        return self.coder.data

    def digest(self):
        """7.6 The digest."""
        return xxh64(self.hashed)
