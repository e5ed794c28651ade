"""What a mesh has beside its connectivity: sections 2, 4 and 6 of MESH (5.7 to 5.9), and how they are given out."""
import struct

from tvg_animated import Channel
from tvg_attributes import CORNERS, VERTICES, attributes_of
from tvg_corners import Surface, next_of, prev_of
from tvg_parts import Fans, Parts

class Properties:
    """sections: those of the mesh by kind; room: property_bytes (4.1)."""
    def __init__(self, sections, faces, V, shape, room, coding):
        self.surface = surface = Surface(faces, V, shape, coding)
        self.parts = Parts(sections[2], surface, room, coding) if 2 in sections else None
        room -= self.parts.cost if self.parts else 0
        P = len(self.parts.names) if self.parts else 0
        self.attributes, cost = attributes_of(sections[4], surface, P, room, coding) if 4 in sections else ([], 0)
        self.fans = Fans(sections[6], surface, room - cost, coding) if 6 in sections else None

    def apexes(self):
        """The first corner of each face, in the order in which they are given out (5.9)."""
        if self.fans is None:
            return range(0, 3 * self.surface.F, 3)
        return [apex for fan in self.fans.fans for apex in fan]

    def faces(self):
        """The faces as they are given out, in traversal indices."""
        return [tuple(self.surface.corners[c] for c in (p, next_of(p), prev_of(p))) for p in self.apexes()]

    def polygons(self):
        """The first triangle and the number of corners of each."""
        first = 0
        for fan in self.fans.fans if self.fans else ():
            if len(fan) > 1:
                yield first, len(fan) + 2
            first += len(fan)

    def channels(self, coding):
        """What decodes the animated attributes of a GOP, by the number of the channel (5.7.7)."""
        return {2 + 2 * i: Channel(attribute, self.surface, coding)
                for i, attribute in enumerate(self.attributes) if attribute.animated}

    def dump(self, drawn):
        """What digests.txt covers of them (see corpus/manifest.md); drawn: the vertices in output order."""
        data, polygons = bytearray(), list(self.polygons())
        if not (self.attributes or self.parts or polygons):
            return b""

        def put(*numbers):
            data.extend(struct.pack(f"<{len(numbers)}I", *numbers))

        def put_text(value):
            put(len(value))
            data.extend(value)

        put(len(self.attributes))
        for attribute in self.attributes:
            put(attribute.kind, attribute.domain, attribute.C, attribute.bits)
            put_text(attribute.name)
            put(attribute.W)
            values = [(0.0,) * attribute.C] * attribute.W if attribute.animated else attribute.values
            data.extend(dumped(attribute, values, drawn))
            if attribute.domain == CORNERS:
                put(*(attribute.wedge[c] for p in self.apexes() for c in (p, next_of(p), prev_of(p))))
        put(len(self.parts.names) if self.parts else 0)
        if self.parts:
            for names in self.parts.names:
                for name in names:
                    put_text(name)
            put(*(self.parts.face_parts[p // 3] for p in self.apexes()))
        put(len(polygons))
        for polygon in polygons:
            put(*polygon)
        return bytes(data)

def dumped(attribute, values, drawn):
    """Values as they are given out."""
    if attribute.domain == VERTICES:
        values = [values[v] for v in drawn]
    return b"".join(struct.pack(f"<{attribute.C}f", *value) for value in values)
