"""7.9 Mode lossless: float32 positions of which every bit comes back.

Floats are binary64; Python rounds each operation to nearest even and contracts none.
"""
import math
import struct

LARGEST = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]  # float32
NEARNESS = (16, 8, 5, 4, 3, 3, 2, 2)
SHARES = (0, 4096, 2730, 2259, 1985, 1820, 1680, 1598, 1524)

# 7.9.1 Numbers
def ordered(bits):
    """The bits of a float32 number as an integer in the order of the numbers."""
    return -1 - (bits - 2 ** 31) if bits >= 2 ** 31 else bits

def bits_of(value):
    """The bits of a value that is a float32 number."""
    return struct.unpack("<I", struct.pack("<f", value))[0]

def log16(size):
    return struct.unpack("<Q", struct.pack("<d", size))[0] >> 48

class Floats:
    """All float32 numbers whose so many lowest bits are zero."""
    def __init__(self, low_bits):
        self.low_bits, self.most = low_bits, 0x7F7FFFFF >> low_bits

    def magnitude(self, value):
        return (bits_of(value) & 0x7FFFFFFF) >> self.low_bits

    def value(self, magnitude):
        return struct.unpack("<f", struct.pack("<I", magnitude << self.low_bits))[0]

    def fine(self, size):
        if size < 2.0 ** -126:
            return math.floor(size * 2.0 ** 155) >> self.low_bits
        bits = struct.unpack("<Q", struct.pack("<d", size))[0]
        return bits - (896 << 52) >> 23 >> self.low_bits

    def log_step(self, value):
        exponent = struct.unpack("<Q", struct.pack("<d", abs(value)))[0] >> 52
        return (max(exponent, 897) - 23 + self.low_bits) * 16

class Multiples:
    """Multiples of a power of two."""
    def __init__(self, exponent):
        self.step, self.exponent, self.most = 2.0 ** exponent, exponent, 2 ** 24

    def magnitude(self, value):
        return int(abs(value) / self.step)

    def value(self, magnitude):
        return magnitude * self.step

    def fine(self, size):
        return math.floor(min(size * 2.0 ** (6 - self.exponent), 64.0 * self.most))

    def log_step(self, value):
        return log16(self.step)

def line_of(kind, amount):
    return Floats(amount) if kind == 0 else Multiples(amount - 149)

def place_of(line, value):
    magnitude = line.magnitude(value)
    return -1 - magnitude if math.copysign(1.0, value) < 0 else magnitude

def value_at(line, place):
    return -line.value(-1 - place) if place < 0 else line.value(place)

def place_between(line, value):
    fine = min(line.fine(abs(value)), 64 * line.most)
    return -64 - fine if value < 0 else fine

def clamp(x, a, b):
    return max(a, min(x, b))

def bin_of(x, count):
    return clamp(x, -(count // 2), count // 2 - 1) + count // 2

class Expectation:
    """What is known of a residual."""
    def __init__(self, first, lost, size, beside, before, signs):
        self.first, self.lost, self.signs = first, lost, signs
        self.base = base = clamp(beside + before + 16 >> 5, -3, 32)
        self.small, excess = base <= 0, size - 16 * base
        part = min(abs(lost) >> 3, 3)
        self.size_bin = 8 * part + bin_of(excess >> 3, 8) if self.small else bin_of(excess >> 2, 32)
        self.place_bin = bin_of(beside - before >> 4, 16)

class LosslessFrames:
    """Decodes the frames of one GOP. Its values are those of the frame decoded last. symbol and bit make models."""
    def __init__(self, turns, shape, line, require, symbol, bit):
        self.turns, self.line, self.require, V = turns, line, require, len(turns)
        self.values, self.f = [[0.0] * 3 for _ in turns], 0
        self.shape = [[clamp(o + (i + 0.5) * shape.step, -LARGEST, LARGEST) for o, i in zip(shape.origin, index)]
                      for index in shape.indices]
        self.opinions = [[[0.0] * 4 for _ in range(3)] for _ in range(V)]
        self.errors = [[[0.0] * 4 for _ in range(3)] for _ in range(V)]
        self.size, self.before = [[0] * 3 for _ in range(V)], [[0] * 3 for _ in range(V)]
        self.sign = [[0] * 3 for _ in range(V)]
        self.running = [[16 * log16(shape.step)] * 3 for _ in range(50)]
        self.by_size = [[[symbol() for _ in range(32)] for _ in range(36)] for _ in range(2)]
        self.by_place = [[[symbol() for _ in range(16)] for _ in range(36)] for _ in range(2)]
        self.by_signs, self.by_loss = [bit() for _ in range(27)], [bit() for _ in range(8)]
        self.second = [bit() for _ in range(16)]

    def hashed_values(self):
        """7.6 What the digest covers of a frame, for each vertex."""
        return [[ordered(bits_of(value)) for value in values] for values in self.values]

    def given_out(self, v):
        """Ordered integers and position of a vertex."""
        return [ordered(bits_of(value)) for value in self.values[v]], self.values[v]

    def frame(self, coder, _):
        for turn in self.turns:
            self.vertex(coder, turn)
        self.f += 1
        coder.finish()

    def vertex(self, coder, turn):
        """7.9.2 A vertex."""
        v = turn.vertex
        self.before[v] = self.size[v]
        self.size[v], misses = [0] * 3, []
        for axis in range(3):
            mean = self.mean(turn, self.values, axis)
            opinions = self.first_opinions(turn, mean, axis) if self.f == 0 else list(self.opinions[v][axis])
            prediction = mean + self.detail(turn, opinions, axis)
            place = place_between(self.line, prediction)
            rounded = place + 32 >> 6
            known = self.expectation(turn, axis, prediction, place - 64 * rounded)
            residual = self.residual(coder.lane(axis), v, axis, rounded, known)
            number = (rounded + residual + 2 ** 31) % 2 ** 32 - 2 ** 31
            self.require(-1 - self.line.most <= number <= self.line.most, "7.9.2", "a number that the GOP has not")
            value = value_at(self.line, number)
            misses.append((mean, opinions, value))
            self.learn_size(turn, axis, value - prediction)
        for axis, (mean, opinions, value) in enumerate(misses):
            self.values[v][axis] = value
            self.take(v, axis, opinions, value - mean)

    # 7.9.3 Predictions
    def mean(self, turn, values, axis):
        total = 0.0
        for q, w in zip(turn.neighbours, turn.weights):
            total += w * values[q][axis]
        return total * 2.0 ** -14

    def first_opinions(self, turn, mean, axis):
        here = self.shape[turn.vertex][axis] - mean
        if not turn.neighbours:
            return [here] * 4
        return [here, self.shape[turn.vertex][axis] - self.mean(turn, self.shape, axis), 0.0, here]

    def detail(self, turn, opinions, axis):
        total = weighted = 0.0
        for i in range(4):
            error = 1.25 * self.errors[turn.vertex][axis][i]
            for q in turn.neighbours[:4]:
                error += self.errors[q][axis][i]
            inverse = 1.0 / (error + 2.0 ** -160)
            square = inverse * inverse
            credit = square * square
            total += credit
            weighted += credit * opinions[i]
        return weighted / total

    def take(self, v, axis, opinions, detail):
        errors, kept = self.errors[v][axis], self.opinions[v][axis]
        for i in range(4):
            missed = abs(detail - opinions[i])
            errors[i] = missed if self.f < 2 else errors[i] + (missed - errors[i]) * 0.375
        if self.f == 0:
            kept[:] = [detail] * 4
            return
        kept[3] = detail + detail - kept[0]
        kept[0] = detail
        kept[1] = kept[1] + (detail - kept[1]) * 0.25
        kept[2] = kept[2] + (detail - kept[2]) * (1.0 / (min(self.f, 9) + 1))

    # 7.9.4 Residuals
    def expectation(self, turn, axis, prediction, lost):
        v, step = turn.vertex, self.line.log_step(prediction)

        def steps(size):
            return max(size - step, -64)

        near, first = turn.neighbours[:8], self.f == 0
        usual = steps(self.running[turn.level][axis] >> 4)
        beside = usual
        if near:
            beside = sum(n * steps(self.size[q][axis]) for n, q in zip(NEARNESS, near)) * SHARES[len(near)] >> 16
        x, y = steps(self.size[v][0]), steps(self.size[v][1])
        other = (beside, x, x + y >> 1)[axis]
        before = other if first else steps(self.before[v][axis])
        size = usual + beside >> 1 if first else 38 * usual + 90 * beside + 77 * before + 51 * other >> 8
        signs = [self.sign[q][axis] for q in turn.neighbours[:2]] + [0] * (2 - len(turn.neighbours[:2]))
        signs = 9 * (signs[0] + 1) + 3 * (signs[1] + 1) + self.sign[v][axis] + 1
        return Expectation(first, lost, size, beside, before, signs)

    def learn_size(self, turn, axis, missed):
        size, level = log16(abs(missed)), self.running[turn.level]
        self.size[turn.vertex][axis] = size
        self.sign[turn.vertex][axis] = (missed > 0) - (missed < 0)
        level[axis] += 16 * size - level[axis] >> 6

    def residual(self, coder, v, axis, rounded, known):
        base = known.base
        symbol = coder.symbol(self.by_size[known.first][base + 3][known.size_bin],
                              self.by_place[known.first][base + 3][known.place_bin])
        length = coder.raw(6) if symbol in (0, 15) else base - 9 + symbol
        length = clamp(length, 0, 32)
        if length == 0:
            return 0
        negative = coder.bit(self.by_loss[known.lost + 32 >> 3] if known.small else self.by_signs[known.signs])
        size = 1
        if length > 1:
            size = 2 + coder.bit(self.second[symbol])
            size = (size << length - 2) + coder.bits(length - 2)
        return -size if negative else size
