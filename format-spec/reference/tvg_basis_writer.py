"""Writes what §7.8 specifies, plans and frames in mode basis, as tvg_writer.py does the rest."""
import struct

import tvg_reference as reference
from tvg_basis import MOST_COEFFICIENT, BasisFrames, Coefficients, hashed_planes
from tvg_reference import xxh64
from tvg_rows import FRAMES, Models, Rows
from tvg_writer import RangeEncoder, say_residual, sized, varint

# 7.8.2 Coefficients
class CoefficientWriter(Coefficients):
    """Writes planes whose coefficients are chosen by a function of vertex, plane of the group, rounded prediction and
    what they may be at most. A vertex stirs where one has a residual, or always."""
    def __init__(self, turns, shift, choose, always=False, ends=None):
        super().__init__(turns, shift, reference, reference.require, ends)
        self.choose, self.always = choose, always

    def stirred(self, coder, model, v, rounded):
        self.chosen = [self.choose(v, j, r, MOST_COEFFICIENT >> self.shift[v]) for j, r in enumerate(rounded)]
        coder.say(int(self.always or self.chosen != rounded))
        return super().stirred(coder, model, v, rounded)

    def residual(self, coder, v, j, rounded, mirrored, k, models):
        d = self.chosen[j] - rounded
        say_residual(coder, -d if mirrored else d, k)
        return super().residual(coder, v, j, rounded, mirrored, k, models)

class PlanWriter:
    """The groups of a plan of K planes, its coefficients q and their digest; of the parts, groups[part], where their
    vertices are given, and their digests."""
    def __init__(self, turns, shift, K, choose, always=False, parts=None):
        vertices = parts or [range(len(turns))]
        ends = [sum(map(len, vertices[:i + 1])) for i in range(len(vertices))]
        coefficients = CoefficientWriter(turns, shift, choose, always, ends)
        groups, hashed, self.q = [[] for _ in vertices], [b"" for _ in vertices], []
        for first in range(0, K, 4):
            coders = [RangeEncoder() for _ in vertices]
            try:
                planes = coefficients.group(coders, min(K - first, 4))
            except reference.Invalid:  # it has read what breaks a rule
                coders[0].clear()
                planes = coefficients.q
            for i, coder in enumerate(coders):
                coder.finish()
                groups[i].append(coder.data)
                hashed[i] += hashed_planes(planes, vertices[i])
            self.q += planes
        self.groups, self.digests = groups if parts else groups[0], [xxh64(covered) for covered in hashed]
        self.digest = self.digests[0]

# 7.8.1 The plan
def basis_fields(components, fine_bits, coarse_bits, fraction_bits, origin, step, scales, flags, groups, digest):
    """Bytes of flags and of groups."""
    return (varint(components) + bytes([fine_bits, coarse_bits, fraction_bits]) + struct.pack("<4d", *origin, step)
            + bytes(scales) + sized(flags) + b"".join(map(sized, groups)) + struct.pack("<Q", digest))

def part_fields(groups, digest):
    """Those of a part that adds to another one."""
    return b"".join(map(sized, groups)) + struct.pack("<Q", digest)

# 7.8.4 Rows
class ModelWriter(Models):
    """Writes the residuals that a RowWriter chooses."""
    def __init__(self, rows):
        super().__init__(reference)
        self.rows = rows

    def value(self, coder, k, first, second, turned):
        a, axis, rounded = self.rows.at
        d = self.rows.choose(a, axis, rounded) - rounded
        say_residual(coder, -d if turned else d, k)
        return super().value(coder, k, first, second, turned)

class RowWriter(Rows):
    """Writes rows whose values are chosen by a function of row, axis and rounded prediction; choose_back tells how many
    frames back one was alike, of the number of frames before."""
    def __init__(self, scales, choose, choose_back):
        super().__init__(scales, reference)
        self.models, self.choose, self.choose_back = ModelWriter(self), choose, choose_back

    def alike(self, coder):
        if self.f >= 3:
            back = self.choose_back(min(self.f, FRAMES))
            coder.say(*((1, back - 2) if back else (0,)))
        return super().alike(coder)

class Plan:
    """What frames need to know of a plan."""
    def __init__(self, scales, q):
        self.scales, self.q = scales, q

class BasisWriter(BasisFrames):
    """Writes the frames of a GOP."""
    def __init__(self, plan, choose, choose_back=lambda before: 0):
        super().__init__(plan, reference)
        self.rows, self.hashed = RowWriter(plan.scales, choose, choose_back), b""

    def write(self, predictor):
        """Returns the stream of the next frame."""
        self.coder = RangeEncoder()
        self.frame(self.coder, predictor)
        self.hashed += b"".join(struct.pack("<3i", *values) for values in self.hashed_values())
        return self.coder.data

    def digest(self):
        """7.6 The digest."""
        return xxh64(self.hashed)
