"""5.7 Attributes: their heads, the order of their wedges, and what they count for. The values are in
tvg_attribute_values.py. coding: a module with the coder (6), Reader and text()."""
import math
import struct
from collections import deque

import tvg_attribute_values as values
from tvg_corners import next_of, prev_of, seams, wedges

TEXCOORD, NORMAL, COLOUR, GENERIC = range(4)
VERTICES, CORNERS, PARTS = range(3)

class Attribute:
    """An attribute: its head, then `values` (tuples of binary32 numbers), of wedges by their numbers, and `wedge`."""
    FIELDS, NORMALS = values.Fields, values.Normals

    def __init__(self, reader, coding):
        def require(condition, what):
            coding.require(condition, "5.7", what)

        self.kind, self.domain, self.C, self.bits = (reader.unsigned(1) for _ in range(4))
        self.animated, self.domain = self.domain >= 128, self.domain % 128
        require(self.kind <= GENERIC, "kind of an attribute")
        require(self.domain <= PARTS, "domain of an attribute")
        require(self.C in {NORMAL: (3,), COLOUR: (3, 4)}.get(self.kind, (1, 2, 3, 4)), "components of an attribute")
        low, high = (2, 16) if self.kind == NORMAL else (1, 24)
        require(self.bits == 0 or low <= self.bits <= high, "bits of an attribute")
        self.name = reader.take(reader.varint())
        coding.text(self.name, "5.7")
        self.octahedral = self.kind == NORMAL and self.bits > 0
        self.origin, self.range = [0.0] * self.C, 0.0
        if not self.animated:
            self.read_steps(reader, coding)

    def read_steps(self, reader, coding):
        if self.bits > 0 and not self.octahedral:
            self.origin = list(struct.unpack(f"<{self.C}f", reader.take(4 * self.C)))
            self.range = reader.f64()
            coding.require(all(map(math.isfinite, self.origin)), "5.7", "origin of an attribute")
            coding.require(math.isfinite(self.range) and self.range >= 0, "5.7", "range of an attribute")

    def cost(self, surface, P):
        size = {VERTICES: 4 * self.C * surface.V, CORNERS: 12 * surface.F * (1 + self.C), PARTS: 4 * self.C * P}
        cost = 256 + len(self.name) + size[self.domain]
        return 5 * cost + 2 ** 15 + 48 * surface.F if self.animated else cost

    def read_wedges(self, coder, surface, P, earlier, coding):
        """5.7.2: wedge[c] of each corner, the corners of each wedge, and how many those are."""
        if self.domain == CORNERS:
            earlier.append(seams(coder, surface, list(earlier), coding))
            self.wedge, self.W = wedges(surface, earlier[-1])
        else:
            self.wedge, self.W = surface.corners, surface.V if self.domain == VERTICES else P
        self.corners_of = [[] for _ in range(self.W)]
        if self.domain != PARTS:
            for c, w in enumerate(self.wedge):
                self.corners_of[w].append(c)

    def read_values(self, coder, surface, coding, kinds=None):
        fields, normals = kinds or (self.FIELDS, self.NORMALS)
        decoder = (normals if self.octahedral else fields)(self, coder, surface, coding)
        self.decoded = [False] * self.W
        for w in self.order():
            beside = [self.wedge[i] for c in self.corners_of[w] for i in (next_of(c), prev_of(c))]
            decoder.decode(w, [u for u in beside if self.decoded[u]])
            self.decoded[w] = True
        self.values = decoder.numbers
        return decoder

    def order(self):
        """5.7.3 Each wedge in its turn; the one before is decoded by then."""
        standing, queues, lowest = [0] * self.W, [deque() for _ in range(16)], 0
        for _ in range(self.W):
            w = None
            for high in range(15, 0, -1):
                while w is None and queues[high]:
                    u = queues[high].popleft()
                    w = u if standing[u] == high and not self.decoded[u] else None  # else it has left the queue
            while w is None and self.decoded[lowest]:
                lowest += 1
            w = lowest if w is None else w
            yield w
            for c in self.corners_of[w]:
                for u in (self.wedge[next_of(c)], self.wedge[prev_of(c)]):
                    if not self.decoded[u] and standing[u] < 15:
                        standing[u] += 1
                        queues[standing[u]].append(u)

def attributes_of(data, surface, P, room, coding):
    """The attributes of a section, and what they count for, which is at most room."""
    reader = coding.Reader(data, "5.7")
    count = reader.varint()
    coding.require(1 <= count <= 64, "5.7", "number of attributes")
    attributes = [Attribute(reader, coding) for _ in range(count)]
    cost = sum(attribute.cost(surface, P) for attribute in attributes)
    coding.require(cost <= room, "5.7", "more than property_bytes", "limit-exceeded")
    coder, earlier = coding.RangeDecoder(reader.rest(), "5.7"), []
    for attribute in attributes:
        attribute.read_wedges(coder, surface, P, earlier, coding)
        if attribute.animated:
            attribute.values = [(0.0,) * attribute.C] * attribute.W
        else:
            attribute.read_values(coder, surface, coding)
    coder.finish()
    return attributes, cost
