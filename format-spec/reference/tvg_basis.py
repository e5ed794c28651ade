"""7.8 Mode basis: planes of coefficients that many frames share, and the frames that are sums of them.

The rows of the frames (7.8.4) are in tvg_rows.py. coding: a module with the Symbol and the Bit of §6.2, the
residual() of §7.3.2 and the models of §7.7.4; require: what refuses a stream.
"""
import math
import struct

from tvg_rows import Rows

MOST_COEFFICIENT = 2 ** 24  # |q|
MOST_SUM = 2 ** 52
MOST_SCALE = 163
PARTS = (0, 65536, 32768, 21845, 16384, 13107, 10922)
NEARNESS = [[32767 * (840 // (1 + i)) // sum(840 // (1 + k) for k in range(g)) for i in range(g)] for g in range(9)]

def clamp(x, a, b):
    return max(a, min(x, b))

def factor(scale):
    """W of a row of this scale (7.8.5)."""
    return 4 + (scale & 3) << (scale >> 2)

class PartModels:
    """The models of a part."""
    def __init__(self, coding):
        self.by_size = [[[coding.level_model(i) for _ in range(3)] for i in range(26)],
                        [[coding.pyramid_model(1024) for _ in range(3)] for _ in range(26)]]
        self.by_place = [[[coding.pyramid_model((p + q) // 2) for q in coding.MIDDLE] for p in coding.MIDDLE]
                         for _ in range(2)]
        self.longer = [coding.Bit() for _ in range(27)]
        self.stirs = [[coding.Bit() for _ in range(3)] for _ in range(26)]

class Coefficients:
    """7.8.2 Coefficients, of one group of planes after the other. shift: of each vertex; ends: for each part the turn
    behind its last, of all turns where there is one part."""
    def __init__(self, turns, shift, coding, require, ends=None):
        self.turns, self.shift, self.coding, self.require = turns, shift, coding, require
        self.ends = ends or [len(turns)]
        self.activity, self.usual, self.first = [256] * len(turns), None, True
        self.models = [PartModels(coding) for _ in self.ends]

    def group(self, coders, n):
        """Returns the coefficients of the next n planes, [plane][vertex], from the coders of the parts."""
        V = len(self.turns)
        self.n, self.q, self.share = n, [[0] * V for _ in range(n)], [[0] * V for _ in range(n)]
        self.running, self.next_usual, level, first = [0] * n, [], -1, 0
        for coder, end, models in zip(coders, self.ends, self.models):
            self.part = models
            for turn in self.turns[first:end]:
                if turn.level != level:
                    self.end_level(level)
                    level, self.coded = turn.level, 0
                    self.begin_level(level)
                if self.coded % 16 == 0:
                    self.inverse = [2 ** 24 // running for running in self.running]
                    self.most = [20 * (running >> 4) for running in self.running]
                self.vertex(coder, turn)
                self.coded += 1
            first = end
        self.end_level(level)
        self.usual, self.first = self.next_usual, False
        return self.q

    # 7.8.3 Sizes of residuals
    def begin_level(self, l):
        for j, running in enumerate(self.running):
            if l == 0:
                running = 16384 if self.first else self.usual[0]
            elif self.first:
                running //= 2
            else:
                ratio = clamp(256 * running // self.usual[l - 1], 64, 1024)
                running = min(self.usual[l] * ratio >> 8, 2 ** 23)
            self.running[j] = max(running, 128)

    def end_level(self, level):
        if level >= 0:
            self.next_usual.append(self.running[-1])

    def expect(self, turn):
        """size, beside and before of each plane."""
        around, own, result = turn.neighbours, self.activity[turn.vertex], []
        active = sum(self.activity[r] for r in around[:6]) * PARTS[len(around[:6])] >> 16 if around else own
        for share, running in zip(self.share, self.running):
            near = 256
            if around:
                near = sum(w * share[r] for w, r in zip(NEARNESS[len(around[:8])], around)) >> 15
            u = running >> 4
            result.append((u * (26 + (102 * near + 77 * own + 51 * active >> 8)) >> 8, (u >> 2) * near >> 6,
                           u * (154 * own + 102 * active >> 8) >> 8))
        return result

    def learn(self, v, steps, lost):
        """steps: indices less what was rounded."""
        rate = 3 + sum(self.coded >= count for count in (8, 24, 56, 120))
        for j in range(self.n):
            missed = min(abs(64 * clamp(steps[j], -2048, 2048) - lost[j]), 2 ** 17)
            self.share[j][v] = min(4 * missed, self.most[j]) * self.inverse[j] >> 12
            self.running[j] = max(self.running[j] + (64 * missed - self.running[j] >> rate), 128)
        a = sum(min(share[v], 1536) for share in self.share) >> 2
        self.activity[v] += (a - self.activity[v]) * 210 >> 8

    # 7.8.2 Coefficients
    def vertex(self, coder, turn):
        v, s = turn.vertex, self.shift[turn.vertex]
        sums = [sum(w * q[r] for r, w in zip(turn.neighbours, turn.weights)) for q in self.q]
        mean = [clamp(128 + total >> 8 + s, 1 - 2 ** 30, 2 ** 30 - 1) for total in sums]
        rounded = [m + 32 >> 6 for m in mean]
        lost = [m - 64 * r for m, r in zip(mean, rounded)]
        known = self.expect(turn)
        much = min(sum(abs(x) > 10 for x in lost), 2)
        level = min(self.coding.size_level(sum(size >> 2 for size, _, _ in known)), 25)
        steps = [0] * self.n
        if self.stirred(coder, self.part.stirs[level][much], v, rounded):
            for j, (size, beside, before) in enumerate(known):
                k, part = 0, (abs(lost[j]) > 9) + (abs(lost[j]) > 21)
                while size > 1536:
                    size, k = size >> 1, k + 1
                place = self.coding.place_of
                models = (self.part.by_size[k > 0][self.coding.size_level(size)][part],
                          self.part.by_place[self.first][place(beside)][place(before)], self.part.longer)
                steps[j] = self.residual(coder, v, j, rounded[j], lost[j] < 0, k, models)
        for j, step in enumerate(steps):
            index = rounded[j] + step
            self.require(abs(index) <= MOST_COEFFICIENT >> s, "7.8.2", "a coefficient is out of range")
            self.q[j][v] = index << s
        self.learn(v, steps, lost)

    def stirred(self, coder, model, _v, _rounded):
        """Whether a vertex has residuals. (Who writes planes needs the others to say it.)"""
        return coder.bit(model)

    def residual(self, coder, _v, _j, _rounded, mirrored, k, models):
        """signed_residual()."""
        value = self.coding.residual(coder, k, *models)
        return -value if mirrored else value

class Basis:
    """7.8.1 The plan: its fields, and the coefficients q, [component][vertex]. readers: of the parts that are wanted."""
    def __init__(self, readers, mesh, components, coding):
        require, reader = coding.require, readers[0]
        for part in readers:
            part.section = "7.8.1"
        K = reader.varint()
        require(K <= components, "4.1", "components of a plan", "limit-exceeded")
        self.fine_bits, self.coarse_bits, self.P = (reader.unsigned(1) for _ in range(3))
        require(1 <= self.fine_bits <= 24, "7.8.1", "fine_bits")
        require(1 <= self.coarse_bits <= self.fine_bits, "7.8.1", "coarse_bits")
        require(self.P <= 48, "7.8.1", "fraction_bits")
        self.origin, self.step = [reader.f64() for _ in range(3)], reader.f64()
        require(all(map(math.isfinite, self.origin)), "7.8.1", "origin")
        require(math.isfinite(self.step) and self.step > 0, "7.8.1", "step")
        self.scales = list(reader.take(K + 1))
        require(max(self.scales) <= MOST_SCALE, "7.8.1", "scale of a row")
        flags = reader.take(reader.varint())
        D = self.fine_bits - self.coarse_bits
        require(D > 0 or not flags, "7.8.1", "flags where B1 = B2")
        require(mesh.turns, "7.8.1", "the mesh has no reference shape")
        fine = coding.flags(flags, mesh.gates, D == 0)
        parts = mesh.parts()
        ends = [len(mesh.turns)] if len(parts) == 1 else [sum(map(len, parts[:i + 1])) for i in range(len(parts))]
        coded = Coefficients(mesh.turns, [0 if f else D for f in fine], coding, require, ends[:len(readers)])
        self.q, hashed = [], [bytearray() for _ in readers]
        for first in range(0, K, 4):
            coders = [coding.RangeDecoder(part.take(part.varint()), "7.8.2") for part in readers]
            planes = coded.group(coders, min(K - first, 4))
            for coder in coders:
                coder.finish()
            self.q += planes
            for covered, vertices in zip(hashed, parts):
                covered += hashed_planes(planes, vertices)
        digests = [part.unsigned(8) for part in readers]
        for part in readers:
            part.end()
        for digest, covered in zip(digests, hashed):
            require(digest == coding.xxh64(bytes(covered)), "7.8.1", "wrong digest of planes", "digest-mismatch")

def hashed_planes(planes, vertices):
    """What the digest of a part, which has these vertices, covers of a group."""
    return b"".join(struct.pack("<4i", *([plane[v] for plane in planes] + [0, 0, 0])[:4]) for v in vertices)

class BasisFrames:
    """7.8.5 A frame: those of a GOP. most: the largest float32."""
    def __init__(self, basis, coding):
        self.basis, self.rows, self.coding = basis, Rows(basis.scales, coding), coding
        self.largest = [max(map(abs, plane)) for plane in basis.q]

    def frame(self, coder, _):
        X = self.rows.frame(coder)
        self.coding.require(X is not None, "7.8.4", "a row is out of range, or none is so far back")
        coder.finish()
        self.X = X
        self.factors = [[value * factor(scale) for value in row] for row, scale in zip(X, self.basis.scales)]
        for axis in range(3):
            bound = sum(m * abs(row[axis]) for m, row in zip([1] + self.largest, self.factors))
            self.coding.require(bound < MOST_SUM, "7.8.5", "the rows of a frame are too large")

    def hashed_values(self):
        """7.6 What the digest covers of a frame, for each row."""
        return self.X

    def given_out(self, v):
        """The nearest multiples of the step, and the position of a vertex."""
        basis, most = self.basis, 2 ** 31 - 1
        mean, rows = self.factors[0], self.factors[1:]
        S = [mean[axis] + sum(q[v] * row[axis] for q, row in zip(basis.q, rows)) for axis in range(3)]
        nearest = [clamp(2 * s + (1 << basis.P) >> basis.P + 1, -most, most) for s in S]
        step, largest = math.ldexp(basis.step, -basis.P), self.coding.LARGEST
        return nearest, [clamp(o + s * step, -largest, largest) for o, s in zip(basis.origin, S)]
