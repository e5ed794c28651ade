"""5.5 Levels and 5.6 Coarse meshes. coding: a module with the rest of the mesh (5.1, 5.2) and of the coder (6)."""

class Lod:
    """5.6 A coarse mesh as its fields have it; `vertices` are those of its levels by ascending traversal index."""
    def __init__(self, reader, finer, levels, F, coding):
        self.levels, self.vertex_count, self.face_count = (reader.varint() for _ in range(3))
        self.connectivity, self.order = reader.take(reader.varint()), reader.take(reader.varint())
        coding.require(1 <= self.levels < finer, "5.6", "levels of a coarse mesh")
        coding.require(self.face_count <= F, "5.6", "face_count of a coarse mesh")
        self.vertices = [v for v, level in enumerate(levels) if level < self.levels]
        coding.require(self.vertex_count == len(self.vertices), "5.6", "vertex_count of a coarse mesh")

    def faces(self, coding):
        """Its faces, in traversal indices of the whole mesh."""
        V, F, data = self.vertex_count, self.face_count, self.connectivity
        coding.require(V + F <= 128 * len(data) and F <= 2 ** 30, "5.1", "too many vertices or faces", "limit-exceeded")
        faces, gates = coding.Connectivity(coding.RangeDecoder(data, "5.1"), V, F).decode()
        order = coding.vertex_order(self.order, gates)
        return [tuple(self.vertices[order[corner]] for corner in face) for face in faces]

def levels_of(data, gates, coding):
    """5.5: the level of each vertex."""
    coding.require(data, "5.5", "no levels")
    n = data[0]
    coding.require(1 <= n <= 64, "5.5", "number of levels")
    coder = coding.RangeDecoder(data[1:], "5.5")
    level = level_bits(coder, gates, n, level_models(coding), coding.NONE)
    coder.finish()
    coding.require(set(level) == set(range(n)), "5.5", "a level without a vertex")
    return level

def level_models(coding):
    return [[[coding.Bit() for _ in range(3)] for _ in range(4)] for _ in range(12)]

def level_bits(coder, gates, n, model, NONE):
    level = []
    for p0, p1, o in gates:
        l = n - 1
        while l > 0:
            at = [u != NONE and level[u] == l for u in (p0, p1, o)]
            over = [u != NONE and level[u] > l for u in (p0, p1, o)]
            beside = 3 if at[0] or at[1] else over[0] + over[1]
            across = 2 if at[2] else int(over[2])
            if coder.bit(model[min(n - 1 - l, 11)][beside][across]):
                break
            l -= 1
        level.append(l)
    return level

def lods_of(data, levels, F, coding):
    """5.6: the coarse meshes, the finest first."""
    coding.require(data and levels, "5.6", "no coarse meshes, or no levels")
    reader, lods, finer = coding.Reader(data, "5.6"), [], max(levels) + 1
    count = reader.varint()
    coding.require(1 <= count <= 16, "5.6", "number of coarse meshes")
    for _ in range(count):
        lods.append(Lod(reader, finer, levels, F, coding))
        finer = lods[-1].levels
    reader.end()
    return lods
