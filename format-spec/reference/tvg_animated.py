"""5.7.7 Values of a frame: attributes that are animated. coding: as in tvg_attributes.py."""
import struct

from tvg_attribute_values import Fields, Normals, unfold
from tvg_corners import minus, plus, times, unit

class Changing:
    """What both kinds have in common when they are predicted by time."""
    LEARNT = ("models", "running", "usual")

    def __init__(self, attribute, coder, surface, coding):
        super().__init__(attribute, coder, surface, coding)
        channel = attribute.channel
        self.before, self.older = channel.integers, channel.older
        for name, value in channel.learnt.items():
            setattr(self, name, value)
        self.models.coder = coder
        channel.learnt = {name: getattr(self, name) for name in self.LEARNT}

class ChangingFields(Changing, Fields):
    LEARNT = Changing.LEARNT + ("by_mean", "by_before", "sign")

    def __init__(self, attribute, coder, surface, coding):
        super().__init__(attribute, coder, surface, coding)
        self.flat, self.K = False, 4

    def base(self, w):
        return self.coded_numbers(self.before[w])

    def number_at(self, w, c, m):
        return self.base(w)[c] + m

    def x_of(self, w, numbers):
        return tuple(a - b for a, b in zip(numbers, self.base(w)))

    def fourth(self, w, _said):
        if self.older is None:
            return [0.0] * self.attribute.C
        return [a - b for a, b in zip(self.base(w), self.coded_numbers(self.older[w]))]

class ChangingNormals(Changing, Normals):
    LEARNT = Changing.LEARNT + ("nones",)

    def __init__(self, attribute, coder, surface, coding):
        self.nones = (coding.Bit(), coding.Bit())
        super().__init__(attribute, coder, surface, coding)

    def normal(self, integers):
        return (0.0, 0.0, 0.0) if integers[0] == self.L + 1 else unfold(*integers, self.m)

    def opinions(self, w, beside):
        before, D = self.normal(self.before[w]), (0.0, 0.0, 0.0)
        for u in beside:
            D = plus(D, minus(self.x[u], self.normal(self.before[u])))
        G = [before, unit(plus(before, times(1.0 / len(beside), D))) if beside else before]
        older = self.older and minus(before, self.normal(self.older[w]))
        return G + [unit(plus(before, older)) if older else before]

    def none_of(self, w):
        return self.nones[self.before[w][0] == self.L + 1]

class Channel:
    """The values of an animated attribute, frame after frame of a GOP."""
    CHANGING_FIELDS, CHANGING_NORMALS = ChangingFields, ChangingNormals

    def __init__(self, attribute, surface, coding):
        self.attribute, self.surface, self.coding = attribute, surface, coding
        self.integers = self.older = self.values = None
        self.learnt, self.hashed = {}, bytearray()
        attribute.channel = self

    def take(self, piece):
        """The piece of a frame."""
        coding, attribute, first = self.coding, self.attribute, self.integers is None
        if not piece:
            coding.require(not first, "5.7.7", "the first values repeat others")
            self.keep(self.integers)
            return
        reader = coding.Reader(piece, "5.7")
        predictor = reader.unsigned(1)
        coding.require(predictor <= (0 if first else 1), "5.7.7", "predictor of values")
        if first:
            self.begin(reader)
        coder = coding.RangeDecoder(reader.rest(), "5.7.7")
        self.code(coder, predictor)
        coder.finish()

    def begin(self, reader):
        """The grid, which the digest begins with (7.6)."""
        start = reader.at
        self.attribute.read_steps(reader, self.coding)
        self.hashed += reader.data[start:reader.at]

    def code(self, coder, predictor):
        attribute = self.attribute
        kinds = (self.CHANGING_FIELDS, self.CHANGING_NORMALS) if predictor else (attribute.FIELDS, attribute.NORMALS)
        decoder = attribute.read_values(coder, self.surface, self.coding, kinds)
        self.values = attribute.values
        self.keep(decoder.integers)

    def keep(self, integers):
        self.integers, self.older = integers, self.integers
        self.hashed += b"".join(struct.pack(f"<{len(value)}i", *value) for value in integers)
