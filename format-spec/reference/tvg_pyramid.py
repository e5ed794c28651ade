"""5.4 The pyramid: in what order the vertices of a mesh with a reference shape come, and what predicts each of them.

Nothing of it is transmitted. Floats are binary64; Python rounds each operation to nearest even and contracts none.
"""
import functools
import heapq
import math

LONGEST = 2 ** 32 - 1  # of edges and sums
APART = 2 ** 28  # length of a link between components, without the distance

class Turn:
    """A vertex in its turn: its level, and the vertices before it that predict it, with weights whose sum is 2^14."""
    def __init__(self, vertex, level, neighbours, weights):
        self.vertex, self.level, self.neighbours, self.weights = vertex, level, neighbours, weights

def pyramid(faces, shape, m, given=()):
    """The turns, in order. faces: in traversal indices; shape: the lattice indices of §5.3; m: neighbours at most; given:
    the levels of §5.5, if any."""
    graph, removals, neighbours = first_graph(faces, shape), [], {}
    by_rank = sorted(graph, key=lambda v: v * 0x9E3779B1 % 2 ** 32)
    highest = max(given, default=0)
    while highest > len(removals) or len(graph) > 32 and len(removals) < highest + 48:
        if highest > len(removals):
            removed = [v for v in by_rank if given[v] == highest - len(removals)]
            colour = dict.fromkeys(graph, 0) | {v: c + 1 for v, c in colouring(graph, removed).items()}
        else:
            colour = colouring(graph, by_rank)
        last = max(colour.values())
        time = {v: last + 1 - c if c > 0 else 0 for v, c in colour.items()}
        removals.append(sorted((v for v in graph if colour[v] > 0), key=lambda v: (time[v], v)))
        for v in removals[-1]:
            neighbours[v] = nearest(graph, time, v, m)
        graph = contracted(graph, colour)
        by_rank = [v for v in by_rank if v in graph]
    place = {v: i for i, v in enumerate(by_rank)}
    for v in by_rank:
        neighbours[v] = nearest(graph, place, v, m)
    return [Turn(v, level, neighbours[v], weights(shape[v], [shape[q] for q in neighbours[v]]))
            for level, vertices in enumerate([by_rank] + removals[::-1]) for v in vertices]

# Lengths
def d2(p, q):
    x, y, z = (float(a - b) for a, b in zip(p, q))
    return x * x + y * y + z * z

def length(p, q):
    return min(math.floor(16.0 * math.sqrt(d2(p, q))), LONGEST)

# 5.4.1 The graph: for each vertex its links, pairs of length and vertex, ascending
def sorted_links(links):
    return {v: sorted((between, u) for u, between in to.items()) for v, to in links.items()}

def along_the_curve(shape):
    """The vertices as the curve through all of them has them."""
    def compare(a, b):
        differences = [(shape[a][k] ^ shape[b][k]).bit_length() for k in range(3)]
        k = differences.index(max(differences))
        return shape[a][k] - shape[b][k] or a - b
    return sorted(range(len(shape)), key=functools.cmp_to_key(compare))

def first_graph(faces, shape):
    """The edges of the faces, and what makes them hang together."""
    links, component = {v: {} for v in range(len(shape))}, list(range(len(shape)))

    def root(v):
        while component[v] != v:
            component[v] = component[component[v]]
            v = component[v]
        return v

    def connect(a, b, between):
        links[a][b] = links[b][a] = between

    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            if a != b:
                connect(a, b, length(shape[a], shape[b]))
                component[root(a)] = root(b)
    order = along_the_curve(shape)
    for a, b in zip(order, order[1:]):
        if shape[a] == shape[b]:
            connect(a, b, 0)
        elif root(a) != root(b):
            connect(a, b, min(APART + length(shape[a], shape[b]), LONGEST))
    return sorted_links(links)

# 5.4.2 Levels
def colouring(graph, by_rank):
    """First fit: vertices of many links first."""
    colour = {}
    for v in sorted(by_rank, key=lambda v: len(graph[v]) <= 32):  # sorted() keeps the order of rank
        taken = {colour.get(u) for _, u in graph[v]}
        colour[v] = next(c for c in range(len(graph)) if c not in taken)
    return colour

def contracted(graph, colour):
    """The graph of the vertices of colour 0, to the nearest of which the others are drawn."""
    drawn = {v: (0, v) for v in graph if colour[v] == 0}
    drawn.update({v: link for v in graph if v not in drawn for link in graph[v][::-1] if colour[link[1]] == 0})
    draw_further(graph, drawn)
    links = {v: {} for v in graph if colour[v] == 0}
    for x in graph:
        for between, y in graph[x]:
            (way_x, a), (way_y, b) = drawn[x], drawn[y]
            if a != b:
                whole = min(way_x + between + way_y, LONGEST)
                links[a][b] = min(links[a].get(b, LONGEST), whole)
    return sorted_links(links)

def draw_further(graph, drawn):
    """What has no link to a kept vertex. drawn: way and where to, of each vertex."""
    near, queue = {}, []

    def reach(y):
        for between, x in graph[y]:
            there = min(drawn[y][0] + between, LONGEST)
            if x not in drawn and (x not in near or there < near[x][0]):
                near[x] = there, drawn[y][1]
                heapq.heappush(queue, (there, x))

    for y in sorted(drawn):
        reach(y)
    while queue:
        _, x = heapq.heappop(queue)
        if x not in drawn:
            drawn[x] = near[x]
            reach(x)

# 5.4.3 Neighbours
def nearest(graph, time, v, m):
    """The m nearest vertices that are decoded before v: those of an earlier time."""
    reached, queue, found, visited = {v: 0}, [(0, v)], [], 0
    while queue:
        distance, u = heapq.heappop(queue)
        if distance > reached[u]:
            continue
        if u != v:
            if distance >= APART and len(found) >= 6:
                break
            if time[u] < time[v]:
                found.append(u)
        visited += 1
        if len(found) == m or visited == 96:
            break
        for between, y in graph[u][:16]:
            there = min(distance + between, LONGEST)
            if there < reached.get(y, there + 1):
                reached[y] = there
                heapq.heappush(queue, (there, y))
    return found

# 5.4.4 Weights
def kernel(distance2, scale):
    r2 = distance2 * scale
    r = math.sqrt(r2)
    t = math.sqrt(r)
    return r * t * math.sqrt(t) + 500.0 * r2

def in_order(values):
    """Their sum, added one by one (sum() may be more exact)."""
    total = 0.0
    for value in values:
        total += value
    return total

def weights(point, around):
    """What each of the points around it counts for a point."""
    c = len(around)
    if c == 0:
        return []
    x, even = solution(point, around), 1.0 / c
    total = in_order(x)
    off = [value / total - even for value in x] if total > 0 else [0.0] * c
    shrink = 1.0
    for e in off:
        if e > 1.9 - even:
            shrink = min(shrink, (1.9 - even) / e)
        if e < -1.9 - even:
            shrink = min(shrink, (-1.9 - even) / e)
    result = [math.floor((even + shrink * e) * 16384 + 0.5) for e in off]
    result[0] += 2 ** 14 - sum(result)
    return result

def solution(point, around):
    """x of A x = (1, ..., 1); nothing where there is none."""
    c, distances2 = len(around), [d2(q, point) for q in around]
    total = in_order(distances2)
    scale = c / total if total > 0 else 1.0
    near = [kernel(distance2, scale) for distance2 in distances2]
    A = [[0.0] * c for _ in around]
    for a in range(c):
        A[a][a] = near[a] + near[a] + 1e-4
        for b in range(a + 1, c):
            A[a][b] = near[a] + near[b] - kernel(d2(around[a], around[b]), scale)
    x, inverse = [1.0] * c, []
    for k in range(c):
        if not A[k][k] > 0:
            return []
        inverse.append(1.0 / A[k][k])
        for i in range(k + 1, c):
            f = A[k][i] * inverse[k]
            for j in range(i, c):
                A[i][j] -= f * A[k][j]
            x[i] -= f * x[k]
    for i in reversed(range(c)):
        for j in range(i + 1, c):
            x[i] -= A[i][j] * x[j]
        x[i] *= inverse[i]
    return x
