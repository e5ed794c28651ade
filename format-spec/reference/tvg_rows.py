"""7.8.4 Rows: the values of a basis, frame by frame.

Floats are binary64; Python rounds each operation to nearest even and contracts none.
"""
import math

FRAMES = 64  # that are remembered
MOST = 2 ** 26  # of values and of their negatives
ZERO, LAST, CURVED, LEARNT, LEARNT_ALIKE, ALONG = range(6)  # the experts

def bounded(x):
    return float(max(-MOST, min(x, MOST)))

def scalar(a, b):
    total = 0.0
    for x, y in zip(a, b):
        total += x * y
    return total

class Sums:
    """A least squares of n factors that learns as it goes."""
    def __init__(self, n):
        self.n, self.P, self.T = n, [[0.0] * (i + 1) for i in range(n)], [0.0] * n

    def fade(self, factor):
        self.P, self.T = [[p * factor for p in line] for line in self.P], [t * factor for t in self.T]

    def plus(self, other):
        total = Sums(self.n)
        total.P = [[p + q for p, q in zip(*lines)] for lines in zip(self.P, other.P)]
        total.T = [t + u for t, u in zip(self.T, other.T)]
        return total

    def take(self, x, target, weight):
        for i in range(self.n):
            weighted = weight * x[i]
            self.T[i] += weighted * target
            for j in range(i + 1):
                self.P[i][j] += weighted * x[j]

    def factors(self, ridge, drawn, *counts):
        """For each of counts, the largest last: the factors of so many, the others being zero."""
        n = counts[-1]
        L, R, inverse = [line[:] for line in self.P], self.T[:], []
        for i in range(n):
            d = ridge + L[i][i] * 2.0 ** -13
            L[i][i] += d
            R[i] += d * drawn[i]
        for k in range(n):
            inverse.append(1.0 / L[k][k])
            for i in range(k + 1, n):
                f = L[i][k] * inverse[k]
                for j in range(k + 1, i + 1):
                    L[i][j] -= f * L[j][k]
                R[i] -= f * R[k]
        results = []
        for count in counts:
            x = [0.0] * self.n
            for i in reversed(range(count)):
                rest = R[i]
                for j in range(i + 1, count):
                    rest -= L[j][i] * x[j]
                x[i] = rest * inverse[i]
            results.append(x)
        return results

class Models:
    """How residuals are coded. coding: a module with the Symbol and the Bit of §6.2 and the residual() of §7.3.2."""
    SHARES = []  # [1024 + i]
    for _i in range(-1024, 1024):
        _u = (_i + 0.5) / 64.0
        _s = _u / math.sqrt(4.0 + _u * _u)
        SHARES.append(int(65535.0 * (0.5 + 0.25 * _s * (3.0 - _s * _s)) + 0.5))

    def __init__(self, coding):
        self.coding = coding
        self.learnt = [self.shaped(min(12 << level, 768), 0, 0) for level in range(8)]
        self.longer = [coding.Bit() for _ in range(27)]

    def shaped(self, size, lost, k):
        scale, start = 18641351 // size, 32 + lost >> k
        below = [self.SHARES[1024 + max(-1024, min(((i - 7) * 64 - start) * scale >> 16, 1023))] for i in range(16)]
        weights = [b - a for a, b in zip(below, below[1:])]
        return self.coding.Symbol(weights=weights + [0], seen=21919)

    def residual(self, coder, size, lost):
        k = max(size.bit_length() - 10, 0)
        level = 7 if k > 0 else max(size.bit_length() - 4, 0)
        value = self.value(coder, k, self.learnt[level], self.shaped(size >> k, abs(lost), k), lost < 0)
        return -value if lost < 0 else value

    def value(self, coder, k, first, second, _turned):
        """(Who writes rows needs the last to choose one.)"""
        return self.coding.residual(coder, k, first, second, self.longer)

class Row:
    """What is known of a row from the frames before."""
    def __init__(self, scale):
        self.step = float((4 + (scale & 3)) << (scale >> 2))
        self.missed, self.size, self.motion = [0.0] * 6, [0.0] * 3, Sums(6)

class Rows:
    """The rows of a GOP. scales: of each row."""
    def __init__(self, scales, coding):
        self.coding, self.models, self.is_alike = coding, Models(coding), coding.Bit()
        self.rows, self.past, self.f = [Row(scale) for scale in scales], [], 0

    def frame(self, coder):
        """Returns the values of the next frame, [row][axis], or None where it is malformed."""
        self.back = self.alike(coder)
        if self.back is None:
            return None
        self.course, self.found, self.count, self.level, self.levels = Sums(5), 1.0, 1.0, 0.0, 0
        after, total = [], Sums(6)
        for row in reversed(self.rows):
            total.fade(0.6)
            after.insert(0, total)
            total = total.plus(row.motion)
        before, values = Sums(6), []
        for a, row in enumerate(self.rows):
            before.fade(0.6)
            values.append(self.row(coder, a, before.plus(row.motion).plus(after[a])))
            if values[-1] is None:
                return None
            before = before.plus(row.motion)
        self.past = ([values] + self.past)[:FRAMES]
        self.f += 1
        return values

    def alike(self, coder):
        """How many frames back one was alike, 0 if none was, None where there is none so far back."""
        if self.f < 3 or not coder.bit(self.is_alike):
            return 0
        back = 2 + coder.raw(6)
        return back if back < min(self.f, FRAMES) else None

    def row(self, coder, a, motion):
        """The values of a row."""
        row, values, missed = self.rows[a], [], [0.0] * 6
        factors = self.factors(motion)
        credit = [1.0 / (0.02 + m * m) for m in row.missed]
        credit = [c * c for c in credit]
        if self.back == 0:
            credit[LEARNT_ALIKE] = 0.0
        usual = self.usual(a)
        row.motion.fade(0.92)
        self.course.fade(0.8)
        for k in range(3):
            x, steps, experts = self.experts(a, k, factors)
            total = sums = 0.0
            for c, expected in zip(credit, experts):
                total += c
                sums += c * expected
            predicted = bounded(sums / total)
            size = self.expected_size(a, k, usual)
            fine = math.floor(predicted * 64.0 + 0.5)
            rounded = fine + 32 >> 6
            self.at = a, k, rounded  # (for who writes rows)
            value = rounded + self.models.residual(coder, int(size * 256.0), fine - 64 * rounded)
            if not -MOST <= value <= MOST:
                return None
            values.append(value)
            self.learn(a, k, x, steps, float(value), experts[LEARNT_ALIKE], abs(value - predicted), size)
            missed = [m + abs(value - expected) for m, expected in zip(missed, experts)]
        if self.f == 0:
            row.missed[ZERO] = missed[ZERO] / 3.0
        else:
            rate = max(1.0 / self.f, 0.2)
            row.missed = [m + (n / 3.0 - m) * rate for m, n in zip(row.missed, missed)]
        return values

    def factors(self, motion):
        drawn = (1.0, 0.0) if self.f < 2 else (1.6, -0.7)
        learnt, learnt_alike = motion.factors(0.5, drawn + (0.0,) * 4, 4, 6 if self.back else 4)
        return learnt, learnt_alike, self.course.factors(0.3, (0.0,) * 5, 5 if self.back else 3)[0]

    def before(self, a, k, back):
        return float(self.past[min(back, self.f) - 1][a][k]) if self.f > 0 else 0.0

    def experts(self, a, k, factors):
        """What tells of a value, its steps, and what the experts expect."""
        learnt, learnt_alike, course = factors
        x = [self.before(a, k, back) for back in (1, 2, 3, 4)]
        x += [self.before(a, k, self.back), self.before(a, k, self.back + 1)] if self.back else [0.0, 0.0]
        steps = [x[0] - x[1], x[1] - x[2], x[2] - x[3], x[4] - x[0] if self.back else 0.0, x[4] - x[5]]
        curved = 2.0 * x[0] - x[1] if self.f < 3 else 3.0 * (x[0] - x[1]) + x[2]
        plain, alike = bounded(scalar(learnt, x)), bounded(scalar(learnt_alike, x))
        return x, steps, [0.0, x[0], curved, plain, alike, bounded(alike + scalar(course, steps))]

    def usual(self, a):
        around = self.rows[max(a - 3, 0):a + 4]
        near = 0.0
        for row in around:
            near += row.size[0] + row.size[1] + row.size[2]
        own = self.rows[a].size
        return 0.1 * (own[0] + own[1] + own[2]) + 0.1 * (near / len(around))

    def expected_size(self, a, k, usual):
        own = self.rows[a].size
        if self.f == 0:
            size = 16384.0 if a == 0 else 1024.0 if self.levels == 0 else 0.5 + self.level / self.rows[a].step
        elif self.f == 1:
            size = (0.1 * own[k] + 0.1 * (own[0] + own[1] + own[2]) + 2.0) * (self.found / self.count)
        else:
            size = (0.4 * own[k] + usual + 0.1) * (self.found / self.count)
        return max(0.02, min(size, 65535.0))

    def learn(self, a, k, x, steps, value, alike, off, size):
        row = self.rows[a]
        if self.f == 0:
            if a > 0:
                self.levels += 1
                self.level += (off * row.step - self.level) * max(1.0 / self.levels, 0.1)
            row.size[k] = off
            return
        self.found = self.found * 0.97 + min(4.0, off / size)
        self.count = self.count * 0.97 + 1.0
        if self.f > 1:
            self.course.take(steps, value - alike, 1.0 / (size * size))
        row.motion.take(x, value, 1.0 / (0.3 + size * size))
        row.size[k] = off if self.f == 1 else row.size[k] + (off - row.size[k]) * max(1.0 / self.f, 0.3)
