"""5.7.4 Fields, 5.7.5 Normals and 5.7.6 Residuals. Floats are binary64; Python rounds each operation to nearest even
and contracts none."""
import math
import struct

from tvg_corners import apart, cross, dot, minus, next_of, plus, prev_of, times, unit
from tvg_lossless import LARGEST, bits_of, ordered

def clamp(x, a, b):
    return max(a, min(x, b))

def binary32(x):
    return struct.unpack("<f", struct.pack("<f", clamp(x, -LARGEST, LARGEST)))[0]

def float_of(number):
    """The number whose ordered integer (7.9.1) this is."""
    return struct.unpack("<f", struct.pack("<I", number if number >= 0 else 2 ** 31 - 1 - number))[0]

class Values:
    """What both kinds of values have in common: opinions (5.7.3) and residuals on a grid (5.7.6)."""
    def __init__(self, attribute, coder, surface, coding):
        self.attribute, self.coder, self.surface, self.coding = attribute, coder, surface, coding
        self.wedge, self.corners_of = attribute.wedge, attribute.corners_of
        self.models = coding.ReferenceShape(coder, [], 0, 1)
        self.running, self.last = [4096] * 4, None
        self.x, self.numbers, self.integers, self.missed, self.size = ([None] * attribute.W for _ in range(5))

    def require(self, condition, what):
        self.coding.require(condition, "5.7", what)

    def mixed(self, G, beside, usual, least):
        """The mean of the opinions, and their credit."""
        credit = []
        for k in range(len(G)):
            total = 0.0
            for u in beside:
                total += self.missed[u][k]
            error = (total + usual[k]) / (len(beside) + 1) + least
            inverse = 1.0 / (error * error)
            credit.append(inverse * inverse)
        total = summed(credit)
        mixed = [summed(share * value[c] for share, value in zip(credit, G)) / total for c in range(len(G[0]))]
        return mixed, [share / total for share in credit]

    def learn(self, w, missed, usual):
        self.missed[w] = missed
        for k, m in enumerate(missed):
            usual[k] = usual[k] + (m - usual[k]) * 0.05

    def grid_residual(self, w, c, _predicted, beside, lost, spread, kind, alone):
        """(Who writes values needs what is predicted to choose one.)"""
        thirds256, running, size = self.coding.thirds256, self.running[c], self.size[w]
        around = 256 * sum(self.size[u][c] for u in beside) // len(beside) if beside else running
        same = around if c == 0 else 256 * sum(size[:c]) // c
        wide = math.trunc(min(spread, 2.0 ** 24) * 256)
        e, g = (2 * running + 4 * around + 4 * same + 6 * wide) * (2 if alone else 1) >> 4, 0
        while e > 640:
            e, g = e >> 1, g + 1
        level, b = thirds256(max(e, 5)) - 6, min(wide >> g, 2 ** 24)
        place = 0 if b < 77 else min(15, 1 + (thirds256(b) - 18) // 2)
        part = 2 if abs(lost) >= 6 else 1 if abs(lost) >= 2 else 0
        d = self.models.value(g, (self.models.first[g > 0][level][part], self.models.second[kind][place]))
        self.running[c] += 256 * abs(d) - running >> 5
        size.append(abs(d))
        return -d if lost < 0 else d

def summed(terms):
    """Of terms added one by one, beginning with 0 (sum() of Python 3.12 is another)."""
    total = 0.0
    for term in terms:
        total += term
    return total

class Fields(Values):
    """5.7.4."""
    def __init__(self, attribute, coder, surface, coding):
        super().__init__(attribute, coder, surface, coding)
        self.exact, self.L = attribute.bits == 0, 2 ** attribute.bits - 1
        self.flat = attribute.kind == 0 and attribute.C == 2 and surface.places is not None
        self.K = 4 if self.flat else 3 if surface.places else 2
        self.turn, self.usual = 0, [[0.0 if self.exact else 16.0] * 4 for _ in range(4)]
        self.by_mean, self.by_before = ([coding.Symbol(16) for _ in range(34)] for _ in range(2))
        self.sign = [coding.Bit() for _ in range(33)]

    def decode(self, w, beside):
        wings, G = self.opinions(w)
        kind = min(wings, 3)
        m, credit = self.mixed(G, beside, self.usual[kind], 2.0 ** -100 if self.exact else 0.05)
        self.size[w], integers = [], []
        for c in range(self.attribute.C):
            if self.exact:
                integers.append(self.exact_number(w, c, m[c], beside))
                continue
            y = clamp(self.number_at(w, c, m[c]), 0.0, float(self.L))
            predicted = math.floor(y + 0.5)
            lost = math.trunc((y - predicted) * 16)
            spread = summed(share * abs(value[c] - m[c]) for share, value in zip(credit, G))
            i = predicted + self.grid_residual(w, c, predicted, beside, lost, spread, kind, wings == 0)
            self.require(0 <= i <= self.L, "an integer outside the grid")
            integers.append(i)
        self.keep(w, integers)
        self.learn(w, [summed(abs(a - b) for a, b in zip(self.x[w], value)) for value in G], self.usual[kind])
        for c in self.corners_of[w] if self.flat else ():
            n, p = self.x[self.wedge[next_of(c)]], self.x[self.wedge[prev_of(c)]]
            if n is not None and p is not None:
                a = area(n, p, self.x[w])
                self.turn = clamp(self.turn + (a > 0) - (a < 0), -4, 4)

    def number_at(self, _w, _c, m):
        """(What is predicted; by time it is a change, §5.7.7.)"""
        return m

    def x_of(self, _w, numbers):
        return numbers

    def coded_numbers(self, integers):
        return tuple(map(float_of if self.exact else float, integers))

    def keep(self, w, integers):
        self.integers[w] = tuple(integers)
        coded = self.coded_numbers(integers)
        self.numbers[w] = coded if self.exact else tuple(binary32(o + i * self.attribute.range / self.L)
                                                         for o, i in zip(self.attribute.origin, integers))
        self.x[w] = self.last = self.x_of(w, coded)

    def exact_number(self, w, c, m, beside):
        predicted = ordered(bits_of(binary32(self.number_at(w, c, m))))
        number = predicted + self.exact_residual(predicted, *self.exact_models(w, c, beside))
        number = (number + 2 ** 31) % 2 ** 32 - 2 ** 31
        self.require(-1 - 0x7F7FFFFF <= number <= 0x7F7FFFFF, "a number that is not finite")
        return number

    def exact_models(self, w, c, beside):
        """5.7.6: what a residual is coded with, and the sizes that it joins."""
        before = self.size[w][c - 1] if c > 0 else 33
        mean = sum(self.size[u][c] for u in beside) // len(beside) if beside else 33
        base = mean if mean < 33 else before if before < 33 else 24
        return base, (self.by_mean[mean], self.by_before[before]), self.size[w]

    def exact_residual(self, _predicted, base, models, sizes):
        coder = self.coder
        s = coder.symbol(*models)
        length = clamp(coder.raw(6) if s in (0, 15) else base - 9 + s, 0, 32)
        sizes.append(length)
        if length == 0:
            return 0
        negative = coder.bit(self.sign[length])
        r = 2 ** (length - 1) + coder.bits(length - 1)
        return -r if negative else r

    def opinions(self, w):
        """wings and G of a wedge."""
        self.sum, self.weight, wings = [[0.0] * self.attribute.C for _ in range(4)], [0.0] * 4, 0
        surface, x = self.surface, self.x
        for c in self.corners_of[w]:
            for i in (next_of(c), prev_of(c)):
                if x[self.wedge[i]] is not None:
                    share = 1.0
                    if surface.places:
                        d = minus(surface.place(i), surface.place(c))
                        share = 1.0 / math.sqrt(dot(d, d) + 1.0)
                    self.say(1, x[self.wedge[i]], share)
            n, p = self.wedge[next_of(c)], self.wedge[prev_of(c)]
            if x[n] is None or x[p] is None:
                continue
            g, o = surface.partner[next_of(c)], None
            if g != surface.NONE and self.wedge[g] == p and self.wedge[next_of(g)] == n:
                o = x[self.wedge[prev_of(g)]]
            if o is not None:
                wings += 1
                self.say(0, [a + b - d for a, b, d in zip(x[n], x[p], o)], 1.0)
            if surface.places:
                self.by_shape(c, g, x[n], x[p], o)
        G = [[s / weight for s in total] if weight > 0 else None for total, weight in zip(self.sum, self.weight)]
        G[3] = self.fourth(w, G[3])
        G[1] = G[1] or self.last or [0.0] * self.attribute.C
        G[0] = G[0] or (G[3] if self.flat else None) or G[1]
        return wings, [opinion or G[0] for opinion in G[:self.K]]

    def fourth(self, _w, said):
        return said

    def say(self, k, v, share):
        self.sum[k] = [s + share * number for s, number in zip(self.sum[k], v)]
        self.weight[k] += share

    def by_shape(self, c, g, n, p, o):
        """shape(); o: what is across, or None."""
        place, following = self.surface.place, next_of(c)
        E = minus(place(prev_of(c)), place(following))
        q = dot(E, E)
        if q == 0:
            return

        def beside(r):
            along = dot(r, E) / q
            return along, math.sqrt(max(0.0, dot(r, r) / q - along * along))

        along, away = beside(minus(place(c), place(following)))
        mirrored, d = self.turn < 0, [b - a for a, b in zip(n, p)]
        if o is not None:
            along2, away2 = beside(minus(place(prev_of(g)), place(following)))
            if away2 * 8 > away:
                r = away / away2
                self.say(2, [(a + along * e) - r * ((b - a) - along2 * e) for a, b, e in zip(n, o, d)], 1.0 / (1.0 + r))
            if self.flat and area(n, p, o) != 0:
                mirrored = area(n, p, o) > 0
        if self.flat:
            a = -away if mirrored else away
            self.say(3, [(n[0] + along * d[0]) - a * d[1], (n[1] + along * d[1]) + a * d[0]], 1.0)

def area(n, p, x):
    return (p[0] - n[0]) * (x[1] - n[1]) - (p[1] - n[1]) * (x[0] - n[0])

def unfold(s, t, m):
    """5.7.1."""
    y, z = s - m, t - m
    x = m - abs(y) - abs(z)
    b = max(-x, 0)
    y, z = y + (b if y < 0 else -b), z + (b if z < 0 else -b)
    l = math.sqrt(float(x * x + y * y + z * z))
    return tuple(binary32(number / l) for number in (x, y, z))

class Normals(Values):
    """5.7.5."""
    def __init__(self, attribute, coder, surface, coding):
        super().__init__(attribute, coder, surface, coding)
        self.L = 2 ** attribute.bits - 2
        self.m, self.none, self.usual = self.L // 2, coding.Bit(), [0.1] * 5

    def surfaces(self, w):
        """surface()."""
        N1 = N2 = N3 = (0.0, 0.0, 0.0)
        for c in self.corners_of[w]:
            place = self.surface.place
            a, b = minus(place(next_of(c)), place(c)), minus(place(prev_of(c)), place(c))
            N = cross(a, b)
            l = math.sqrt(dot(N, N))
            if l != 0:
                N1, N2 = plus(N1, N), plus(N2, times(1.0 / l, N))
                N3 = plus(N3, times(1.0 / (dot(a, a) * dot(b, b)), N))
        return [unit(N1), unit(N2), unit(N3)]

    def opinions(self, w, beside):
        total = (0.0, 0.0, 0.0)
        for u in beside:
            total = plus(total, self.x[u])
        G = [unit(total) if beside else self.last or (1.0, 0.0, 0.0)]
        if self.surface.places:
            G += self.surfaces(w)
            total = (0.0, 0.0, 0.0)
            for u in beside:
                total = plus(total, minus(self.x[u], self.surfaces(u)[2]))
            G.append(unit(plus(G[3], times(1.0 / len(beside), total))) if beside else unit(G[3]))
        return G

    def decode(self, w, beside):
        G = self.opinions(w, beside)
        M, credit = self.mixed(G, beside, self.usual, 0.0002)
        self.size[w] = []
        if self.coder.bit(self.none_of(w)):
            self.size[w], self.x[w], self.integers[w] = [0, 0], (0.0, 0.0, 0.0), (self.L + 1, self.L + 1)
        else:
            self.integers[w] = self.folded(w, beside, G, M, credit)
            self.x[w] = unfold(*self.integers[w], self.m)
        self.numbers[w] = self.last = self.x[w]
        self.learn(w, [apart(self.x[w], opinion) for opinion in G], self.usual)

    def none_of(self, _w):
        return self.none

    def folded(self, w, beside, G, M, credit):
        """s and t."""
        a, m, q = abs(M[0]) + abs(M[1]) + abs(M[2]), self.m, []
        spread = summed(share * apart(opinion, M) for share, opinion in zip(credit, G)) * (0.5 * m)
        for i in range(2):
            y = M[i + 1] / a * m if a > 0 else 0.0
            predicted = math.floor(y + 0.5)
            lost = math.trunc((y - predicted) * 16)
            r = self.grid_residual(w, i, predicted, beside, lost, spread, min(len(beside), 3), False)
            self.require(abs(r) <= m, "a residual of a normal")
            q.append(predicted + r)
            q[i] += (self.L + 1) * ((q[i] < -m) - (q[i] > m))
        if M[0] < 0:
            q = [(-1 if q[0] < 0 else 1) * (m - abs(q[1])), (-1 if q[1] < 0 else 1) * (m - abs(q[0]))]
        return q[0] + m, q[1] + m
