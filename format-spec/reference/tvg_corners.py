"""5.7.2 Corners and seams: what attributes, parts and polygons have in common. A corner and the half-edge that begins
there have one number. coding: a module with the coder (6) and NONE."""

import math

def next_of(c):
    return c - 2 if c % 3 == 2 else c + 1

def prev_of(c):
    return c + 2 if c % 3 == 0 else c - 1

def partners(faces, NONE):
    """partner[h] of each half-edge, the faces being those of 5.1 in their order."""
    corners, partner, runs = [v for face in faces for v in face], [NONE] * (3 * len(faces)), {}
    for h, a in enumerate(corners):
        runs.setdefault((a, corners[next_of(h)]), []).append(h)
    for (a, b), there in runs.items():
        if a < b:
            for h, g in zip(there, runs.get((b, a), ())):
                partner[h], partner[g] = g, h
    return partner

class Surface:
    """A mesh's corners; place: of each vertex in the reference shape, as floats, or None where there is none."""
    def __init__(self, faces, V, shape, coding):
        self.V, self.F, self.NONE = V, len(faces), coding.NONE
        self.corners = [v for face in faces for v in face]
        self.partner = partners(faces, coding.NONE)
        self.places = [tuple(map(float, index)) for index in shape.indices] if shape else None
        self.edges = [h for h, g in enumerate(self.partner) if g < h]

    def place(self, c):
        return self.places[self.corners[c]]

    def normal(self, f):
        a, b, c = (self.place(3 * f + i) for i in range(3))
        return cross(minus(b, a), minus(c, a))

    def bend(self, h):
        if not self.places:
            return 4
        A, B = self.normal(h // 3), self.normal(self.partner[h] // 3)
        d, l = dot(A, B), math.sqrt(dot(A, A)) * math.sqrt(dot(B, B))
        return 0 if d > 0.97 * l else 1 if d > 0.8 * l else 2 if d > 0.4 * l else 3

def seams(coder, surface, earlier, coding):
    """The half-edges whose edges are seams. earlier: those of each earlier attribute with seams."""
    ends = [[[coding.Symbol(2) for _ in range(6)] for _ in range(6)] for _ in range(3)]
    bends = [[[coding.Symbol(2) for _ in range(3)] for _ in range(5)] for _ in range(3)]
    left, met, seam = [0] * surface.V, [0] * surface.V, set()
    ways = [(h, surface.corners[h], surface.corners[next_of(h)]) for h in surface.edges]
    for _, a, b in ways:
        left[a] += 1
        left[b] += 1
    for h, a, b in ways:
        before = 0 if not earlier else 2 if any(h in other for other in earlier) else 1
        low, high = sorted(2 * met[v] + (left[v] == 1) for v in (a, b))
        s = coder.symbol(ends[before][low][high], bends[before][surface.bend(h)][min(met[a] + met[b], 2)])
        coding.require(s <= 1, "5.7", "symbol of a seam")
        if s:
            seam.add(h)
        for v in (a, b):
            left[v] -= 1
            met[v] = min(met[v] + s, 2)
    return seam

def wedges(surface, seam):
    """The wedge of each corner, and how many there are."""
    root = list(range(3 * surface.F))  # of sets of corners; the lowest corner of each is its root

    def find(c):
        while root[c] != c:
            c = root[c]
        return c

    for h in surface.edges:
        if h not in seam:
            g = surface.partner[h]
            for c, d in ((h, next_of(g)), (next_of(h), g)):
                c, d = sorted((find(c), find(d)))
                root[d] = c
    number = {}
    wedge = [number.setdefault(find(c), len(number)) for c in range(len(root))]
    return wedge, len(number)

# 5.7.3 Vectors
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]

def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))

def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))

def times(s, a):
    return tuple(s * x for x in a)

def unit(a):
    l = math.sqrt(dot(a, a))
    return tuple(x / l if l != 0 else 0.0 for x in a)

def apart(a, b):
    return abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2])
