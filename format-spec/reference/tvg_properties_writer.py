"""Writes what §5.7 to §5.9 code, by the reference decoder's own code."""
import struct
import types

import tvg_reference as reference
from tvg_animated import ChangingFields, ChangingNormals, Channel
from tvg_attribute_values import Fields, Normals
from tvg_attributes import NORMAL, Attribute
from tvg_corners import Surface
from tvg_parts import Fans, Parts
from tvg_writer import RangeEncoder, say_high, sized, varint

class Usual(RangeEncoder):
    """Answers with what it was told to say and then as usual: with a symbol, or zero bits."""
    def __init__(self, values, usual):
        super().__init__()
        self.usual = usual
        self.say(*values)

    def or_else(self, value):
        if not self.queue:
            self.say(value)

    def symbol(self, a, b=None):
        self.or_else(self.usual)
        return super().symbol(a, b)

    def bit(self, model):
        self.or_else(0)
        return super().bit(model)

    def raw(self, k):
        self.or_else(0)
        return super().raw(k)

    bits = raw

def written(use, values, usual):
    """The range-coder stream of what use(coding) reads while its coder says these values, valid or not, and then as usual."""
    coder = Usual(values, usual)
    try:
        use(coding_of(coder))
    except reference.Invalid:  # it has read what breaks a rule
        coder.clear()
    coder.finish()
    return coder.data

class RandomCoder(Usual):
    """Answers with what it was told to say and then at random: with symbols 0 and 1, and any bits."""
    def __init__(self, random):
        super().__init__((), 0)
        self.random, self.percent = random, random.pick((5, 30, 70))

    def symbol(self, a, b=None):
        self.or_else(int(self.random.chance(self.percent)))
        return super().symbol(a, b)

    def bit(self, model):
        self.or_else(int(self.random.chance(self.percent)))
        return super().bit(model)

    def raw(self, k):
        self.or_else(self.random.below(2 ** k))
        return super().raw(k)

    bits = raw

class Saying(reference.ReferenceShape):
    """Models of residuals on a grid, of which the next is `said`."""
    said = 0

    def value(self, g, models):
        say_high(self.coder, self.said >> g)
        if g > 0:
            self.coder.say(self.said >> g - 1 & 1, self.said % 2 ** (g - 1))
        return super().value(g, models)

class Chosen:
    """Chooses residuals at random: small ones, but for wild ones."""
    def __init__(self, attribute, coder, surface, coding):
        super().__init__(attribute, coder, surface, coding)
        self.models, self.random = Saying(coder, [], 0, 1), coder.random
        self.small, self.wild = self.random.pick((0, 1, 3, 40)), self.random.pick((0, 5, 60))

    def choose(self, low, high):
        if self.random.chance(self.wild):
            return self.random.pick((low, high, self.random.between(low, high)))
        return reference.clamp(self.random.between(-self.small, self.small), low, high)

    def grid_residual(self, w, c, predicted, beside, lost, *others):
        d = self.choose(*self.bounds(predicted))
        self.models.said = -d if lost < 0 else d
        return super().grid_residual(w, c, predicted, beside, lost, *others)

class FieldsWriter(Chosen, Fields):
    def bounds(self, predicted):
        return -predicted, self.L - predicted

    def exact_residual(self, predicted, base, models, sizes):
        most = 0x7F7FFFFF
        r = (self.choose(-1 - most - predicted, most - predicted) + 2 ** 31) % 2 ** 32 - 2 ** 31
        length = abs(r).bit_length()
        s = reference.clamp(length - base + 9, 0, 15)
        self.coder.say(s, *[length] * (s in (0, 15)))
        if length > 0:
            self.coder.say(int(r < 0), abs(r) - 2 ** (length - 1))
        return super().exact_residual(predicted, base, models, sizes)

class NormalsWriter(Chosen, Normals):
    def bounds(self, predicted):
        return -self.m, self.m

class RandomAttribute(Attribute):
    FIELDS, NORMALS = FieldsWriter, NormalsWriter

class ChangingFieldsWriter(ChangingFields, FieldsWriter):
    pass

class ChangingNormalsWriter(ChangingNormals, NormalsWriter):
    pass

class ChannelWriter(Channel):
    """Writes values at random, frame after frame."""
    CHANGING_FIELDS, CHANGING_NORMALS = ChangingFieldsWriter, ChangingNormalsWriter

    def write(self, random):
        """The next frame's piece."""
        first, attribute = self.integers is None, self.attribute
        if not first and random.chance(20):
            self.keep(self.integers)
            return b""
        head = b""
        if first and attribute.bits > 0 and attribute.kind != NORMAL:
            head = random_steps(random, attribute.C)
            self.begin(reference.Reader(head, "5.7"))
        predictor, coder = 0 if first else int(random.chance(70)), RandomCoder(random)
        self.code(coder, predictor)
        coder.finish()
        return bytes([predictor]) + head + coder.data

def random_steps(random, C):
    origin = [random.pick((0.0, -0.0, -1.0, 1e-3, -1e30)) for _ in range(C)]
    return struct.pack(f"<{C}fd", *origin, random.pick((0.0, 1.0, 1 / 3, 1e-45, 3e38, 1e308)))

def attribute_head(random, has_parts, may_move):
    kind, domain = random.below(4), random.below(3 if has_parts else 2)
    C = {1: 3, 2: random.between(3, 4)}.get(kind, random.pick((1, 2, 2, 3, 4)))
    bits = random.pick((0, 2, 5, 10, 16) if kind == NORMAL else (0, 1, 4, 12, 24))
    moves = 128 * (may_move and random.chance(60))
    head = bytes([kind, domain + moves, C, bits]) + sized(random.pick((b"", b"uv", "gr\u00f6\u00dfe".encode())))
    if bits == 0 or kind == NORMAL or moves:
        return head
    return head + random_steps(random, C)

def random_attributes(random, surface, P, may_move):
    """A section, what it counts for, and its animated attributes by their channels."""
    heads = [attribute_head(random, P > 0, may_move) for _ in range(random.between(1, 4))]
    coder, earlier, cost, animated = RandomCoder(random), [], 0, {}
    for number, head in enumerate(heads):
        attribute = RandomAttribute(reference.Reader(head, "5.7"), reference)
        attribute.read_wedges(coder, surface, P, earlier, reference)
        if attribute.animated:
            animated[2 + 2 * number] = attribute
        else:
            attribute.read_values(coder, surface, reference)
        cost += attribute.cost(surface, P)
    coder.finish()
    return varint(len(heads)) + b"".join(heads) + coder.data, cost, animated

def coding_of(coder):
    """The reference, but with this coder."""
    return types.SimpleNamespace(**(vars(reference) | {"RangeDecoder": lambda data, user: coder}))

def random_name(random, new):
    """A name of a part; new: those before it."""
    choice = random.below(4)
    if choice == 0 or (choice > 1 and not new):
        return varint(0)
    if choice > 1:
        return varint(2 + random.below(len(new)))
    shared = random.below(len(new[-1]) + 1) if new else 0
    rest = random.pick((b"", b"a", b"hand", b"handle"))
    new.append(new[-1][:shared] + rest if new else rest)
    return varint(1) + varint(shared) + sized(rest)

def random_parts(random, surface):
    """A section, how many parts it has, and what it counts for."""
    P, new = random.pick((1, 2, 3, 9)), []
    names = varint(P) + b"".join(random_name(random, new) for _ in range(3 * P))
    coder = RandomCoder(random)
    data = names + b"?" * (P > 1)
    cost = Parts(data, surface, 2 ** 32, coding_of(coder)).cost
    return names + coder.data, P, cost

class FansWriter(Fans):
    """Chooses fans at random."""
    def fan(self, f):
        ways = [0]
        for i in range(3):
            c = 3 * f + i
            following = c + 1 if i < 2 else c - 2
            for start, q in ((1 + 2 * i, self.before(c)), (2 + 2 * i, self.after(following))):
                if q != self.surface.NONE and self.role[q] == 1 and q // 3 != f:
                    ways.append(start)
        self.coder.say(self.coder.random.pick(ways))
        return super().fan(f)

def random_polygons(random, surface):
    """A section, and what it counts for."""
    coder = RandomCoder(random)
    fans = FansWriter(b"?", surface, 2 ** 32, coding_of(coder)).fans
    return coder.data, 16 * sum(len(fan) > 1 for fan in fans)

def random_properties(random, faces, V, shape, may_move=False):
    """Sections of a mesh, what they count for, and what begins the channels of a GOP's animated attributes."""
    surface, sections, P, cost, animated = Surface(faces, V, shape, reference), [], 0, 0, {}
    if random.chance(60):
        content, P, cost = random_parts(random, surface)
        sections.append((2, content))
    if random.chance(80):
        content, more, animated = random_attributes(random, surface, P, may_move)
        sections.append((4, content))
        cost += more
    if random.chance(60):
        content, more = random_polygons(random, surface)
        sections.append((6, content))
        cost += more
    def channels():
        return {channel: ChannelWriter(attribute, surface, reference) for channel, attribute in animated.items()}

    return sections, cost, channels
