"""5.8 Parts and 5.9 Polygons. coding: a module with the coder (6), Reader and text()."""
from tvg_corners import next_of, prev_of

class Parts:
    """5.8: names are triples of object, group and material; face_parts: the part of each face, in the order of 5.1."""
    def __init__(self, data, surface, room, coding):
        reader = coding.Reader(data, "5.8")
        self.coding, self.new = coding, []
        P = reader.varint()
        coding.require(1 <= P <= (len(data) - reader.at) // 3, "5.8", "number of parts")
        self.names, last = [], (b"", b"", b"")
        for _ in range(P):
            last = tuple(self.name(reader, before) for before in last)
            self.names.append(last)
        self.cost = sum(192 + sum(map(len, names)) for names in self.names) + 4 * surface.F  # of the bound of 5.7
        coding.require(self.cost <= room, "5.8", "more than property_bytes", "limit-exceeded")
        self.face_parts = [0] * surface.F
        if P > 1:
            coder = coding.RangeDecoder(reader.rest(), "5.8")
            self.face_parts = part_of_faces(coder, P, surface, coding)
            coder.finish()
        reader.end()

    def name(self, reader, before):
        value = reader.varint()
        if value == 0:
            return before
        if value > 1:
            self.coding.require(value - 2 < len(self.new), "5.8", "a name that has not come")
            return self.new[value - 2]
        last, shared = self.new[-1] if self.new else b"", reader.varint()
        self.coding.require(shared <= len(last), "5.8", "bytes shared with the name before")
        name = last[:shared] + reader.take(reader.varint())
        self.coding.text(name, "5.8")
        self.new.append(name)
        return name

def uniform(coder, bound):
    """5.2.2."""
    k = bound.bit_length() - 1
    u, value = 2 ** (k + 1) - bound, coder.bits(k)
    return value if value < u else 2 * value + coder.raw(1) - u

def part_of_faces(coder, P, surface, coding):
    changes, not_beside, not_new = [coding.Bit() for _ in range(18)], [coding.Bit() for _ in range(2)], coding.Bit()
    used, part, least = {0}, [], 0
    partner, NONE = surface.partner, surface.NONE

    def earlier(h):
        return partner[h] // 3 if partner[h] != NONE and partner[h] // 3 < h // 3 else NONE

    for f in range(surface.F):
        gate = earlier(3 * f)
        expected = 0 if f == 0 else part[f - 1] if gate == NONE else part[gate]
        others = [earlier(3 * f + 1 + s) for s in range(2)]
        candidate = [None if other == NONE else part[other] for other in others]
        beside = [0 if c is None else 1 if c == expected else 2 for c in candidate]
        while least in used:
            least += 1
        if not coder.bit(changes[(0 if gate == NONE else 9) + 3 * beside[0] + beside[1]]):
            chosen = expected
        elif beside[0] == 2 and not coder.bit(not_beside[0]):
            chosen = candidate[0]
        elif (beside[1] == 2 and not (beside[0] == 2 and candidate[0] == candidate[1])
              and not coder.bit(not_beside[1])):
            chosen = candidate[1]
        elif least < P and not coder.bit(not_new):
            chosen = least
        else:
            chosen = uniform(coder, P)
        part.append(chosen)
        used.add(chosen)
    return part

class Fans:
    """5.9: fans, each a list of the apexes of its faces in their order."""
    def __init__(self, data, surface, room, coding):
        self.surface, self.require = surface, coding.require
        self.coder = coding.RangeDecoder(data, "5.9")
        self.coarse, self.fine = [coding.Symbol(7) for _ in range(63)], [coding.Symbol(7) for _ in range(343)]
        self.goes_on = [[coding.Bit() for _ in range(8)] for _ in range(2)]
        self.role, self.fans = [1] * (3 * surface.F), []
        for f in range(surface.F):
            if self.role[3 * f] == 1:
                self.fans.append(self.fan(f))
        self.coder.finish()
        cost = 16 * sum(len(fan) > 1 for fan in self.fans)  # of the bound of 5.7
        coding.require(cost <= room, "5.9", "more than property_bytes", "limit-exceeded")

    def across(self, h):
        g = self.surface.partner[h]
        return 0 if g == self.surface.NONE else self.role[g]

    def after(self, c):
        return self.surface.partner[prev_of(c)]

    def before(self, c):
        g = self.surface.partner[c]
        return g if g == self.surface.NONE else next_of(g)

    def fan(self, f):
        a, b, c = (self.across(3 * f + i) for i in range(3))
        start = self.coder.symbol(self.coarse[(a * 3 + min(b, 2)) * 3 + min(c, 2)], self.fine[(a * 7 + b) * 7 + c])
        self.require(start < 7, "5.9", "symbol of a fan")
        h = 3 * f + (max(start, 1) - 1) // 2
        apex = next_of(h) if start > 0 and start % 2 == 0 else h
        fan = [apex]
        self.take(apex)
        if start > 0 and start % 2 == 0:
            self.grow(fan, apex, True, 1)
        if start > 0:
            self.grow(fan, apex, False, start % 2)
        if len(fan) > 1:
            for i, p in enumerate(fan):
                self.role[p], self.role[next_of(p)], self.role[prev_of(p)] = 3, 5 if i else 4, 6
        return fan

    def take(self, p):
        for c in (p, next_of(p), prev_of(p)):
            self.role[c] = 2

    def grow(self, fan, p, is_after, given):
        while True:
            q = self.after(p) if is_after else self.before(p)
            if q == self.surface.NONE or self.role[q] != 1:
                self.require(given == 0, "5.9", "no face can follow in a fan")
                return
            if given > 0:
                given -= 1
            elif not self.coder.bit(self.goes_on[is_after][min(len(fan), 8) - 1]):
                return
            self.take(q)
            fan.insert(len(fan) if is_after else 0, q)
            p = q
