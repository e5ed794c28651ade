#!/usr/bin/env python3
"""Random valid streams, by another writer than the encoder: what format-spec/tvg.md allows and the encoder never does.

    python3 random_streams.py FOLDER SEED...

writes the streams of the seeds to FOLDER/random_SEED.tvg. The same seed gives the same bytes everywhere. Seeds from
1000 on have GOPs in mode lossless, too; those from 2000 on have plans and GOPs in mode basis, and those from 3000 on
meshes with levels and coarse meshes, and those from 4000 on attributes, parts and polygons.
"""
import os
import sys

import tvg_basis
import tvg_basis_writer as basis_writer
import tvg_properties_writer as properties_writer
import tvg_reference as reference
import tvg_writer as writer
from tvg_reference import ELP, PYRAMID, ROWS, SPACE, TIME, clamp
from tvg_writer import Random, RandomConnectivity, Stream

KINDS_UNKNOWN = (b"xtra", b"    ", b"~~~~", b"Gop ", b"HEA2")
STEPS = (0.5, 1.0, 1 / 3, 2.0 ** -20, 1e-45, 3e38, 1e300)

def chooser(random):
    """A function that chooses indices: near what was predicted, but for wild ones."""
    spread, wild = random.pick((0, 1, 3, 40)), random.pick((0, 0, 2, 50))

    def choose(_, axis, prediction, cells):
        if random.chance(wild):
            return random.pick((0, cells - 1, random.below(cells)))
        return clamp(prediction + random.between(-spread, spread) - axis, 0, cells - 1)

    return choose

def number_chooser(random):
    """The same for numbers on a line: near what was predicted, but for wild ones, and zeros of both signs."""
    spread, wild = random.pick((0, 2, 300, 2 ** 25)), random.pick((0, 5, 100))

    def choose(_, axis, rounded, line):
        if random.chance(wild):
            return random.pick((0, -1, line.most, -1 - line.most, random.between(-1 - line.most, line.most)))
        return clamp(rounded + random.between(-spread, spread) - axis, -1 - line.most, line.most)

    return choose

def coefficient_chooser(random):
    """The same for coefficients, of which most are as predicted where the spread is 0."""
    spread, wild = random.pick((0, 1, 3, 40, 70000)), random.pick((0, 2, 50))

    def choose(_, j, rounded, most):
        if random.chance(wild):
            return random.pick((0, most, -most, random.between(-most, most)))
        return clamp(rounded + random.between(-spread, spread) - (j if spread > 1 else 0), -most, most)

    return choose

def row_chooser(random, plan):
    """The same for rows, so that sums are below 2^52."""
    spread, wild = random.pick((0, 1, 20, 5000)), random.pick((0, 2, 30))
    largest = [1] + [max(map(abs, q)) for q in plan.q]
    share = (tvg_basis.MOST_SUM - 1) // len(largest)
    most = [min(share // (max(m, 1) * tvg_basis.factor(z)), 2 ** 26) for m, z in zip(largest, plan.scales)]

    def choose(a, axis, rounded):
        if random.chance(wild):
            return random.pick((0, most[a], -most[a], random.between(-most[a], most[a])))
        return clamp(rounded + random.between(-spread, spread) - axis, -most[a], most[a])

    return choose

class Mesh:
    """A random mesh: payload, id, and what frames need to know of it."""
    def __init__(self, random, with_levels=False, with_properties=False, may_move=False):
        extreme = random.below(8)
        if extreme == 0:
            V, F = 1, random.below(2)
        elif extreme == 1:
            V, F = random.between(129, 140), 0  # more than a byte of connectivity may stand for: padding
        else:
            V, F = random.between(3, 30), random.between(1, 40)
        if F == 0 and V > 128:
            connectivity, (faces, self.gates) = writer.padded(V)
        else:
            coded = RandomConnectivity(V, F, random)
            faces, self.gates = coded.decode()
            connectivity = coded.coder.data
        sections = [(1, connectivity)]
        order = random.below(4)
        if order == 1:
            sections.append((3, writer.identity_order()))
        elif order == 2:
            sections.append((3, writer.near_order(random.shuffled(range(V)), self.gates, random)))
        elif order == 3:
            sections.append((3, writer.uniform_order(random.shuffled(range(V)))))
        self.shape = self.turns = None
        self.levels, self.lods = (), []
        if with_levels and random.chance(80):
            sections += self.level_sections(random, V, F)
        if random.chance(60):
            section = self.shape_section(random, faces, V)
            sections.append((5, section))
            self.shape, self.turns = reference.shape_and_turns(section, faces, V, self.levels)
        self.property_bytes, self.channels = 0, dict
        if with_properties and random.chance(80):
            more, self.property_bytes, self.channels = properties_writer.random_properties(
                random, faces, V, self.shape, may_move)
            sections += more
        sections += [(kind, random.some_bytes(random.below(6))) for kind in (0, 8, 10, 2 ** 40) if random.chance(15)]
        self.V, self.F = V, F
        self.payload = writer.mesh(V, F, sorted(sections))
        self.id = writer.checksum(self.payload)

    def level_sections(self, random, V, F):
        """The sections of levels and, as a rule, of coarse meshes."""
        n = random.between(1, min(V, random.pick((2, 5, 64))))
        self.levels = random.shuffled([*range(n), *(random.below(n) for _ in range(V - n))])
        sections = [(7, writer.levels(self.levels, self.gates))]
        chosen = [below for below in range(n - 1, 0, -1) if random.chance(60)][:16]
        for below in chosen:
            count = sum(level < below for level in self.levels)
            coded = RandomConnectivity(count, random.below(min(F, 20) + 1), random)
            faces, gates = coded.decode()
            order = random.pick((lambda: writer.identity_order(), lambda: writer.uniform_order(random.shuffled(range(count))),
                                 lambda: writer.near_order(random.shuffled(range(count)), gates, random)))()
            self.lods.append((below, count, len(faces), coded.coder.data, order))
        return sections + [(9, writer.lods(self.lods))] * bool(self.lods)

    def parts(self):
        """The vertices of each part of a basis; None where there is one."""
        bounds = [0] + [lod[0] for lod in self.lods[::-1]] + [64]
        return [[v for v, level in enumerate(self.levels) if low <= level < high]
                for low, high in zip(bounds, bounds[1:])] if self.lods else None

    @staticmethod
    def shape_section(random, faces, V):
        """The section of a reference shape."""
        coded = writer.ShapeWriter(faces, V, random.pick((1, 3, 8, 16, 24)), chooser(random))
        coded.decode()
        origin = [random.pick((0.0, -1.0, 1e300)) for _ in range(3)]
        return writer.reference_shape(coded.bits, random.between(4, 16), origin, random.pick(STEPS), coded.coder.data)

class Basis:
    """A random plan in mode basis of a mesh: payload, id, and what frames need to know of it."""
    def __init__(self, random, mesh):
        K, fine_bits = random.pick((0, 1, 3, 4, 5, 9)), random.pick((1, 8, 12, 24))
        coarse_bits = fine_bits if random.chance(40) else random.between(1, fine_bits)
        fine = [random.below(2) for _ in mesh.gates] if coarse_bits < fine_bits else [1] * mesh.V
        shift = [0 if is_fine else fine_bits - coarse_bits for is_fine in fine]
        coded = basis_writer.PlanWriter(mesh.turns, shift, K, coefficient_chooser(random), random.chance(20),
                                         mesh.parts())
        largest = random.pick((0, 8, 40, 163))
        self.mesh, self.K, self.q = mesh, K, coded.q
        self.scales = [random.between(0, largest) for _ in range(K + 1)]
        origin = [random.pick((0.0, -1.0, 1e-3, 123.456, -1e30)) for _ in range(3)]
        flags = writer.flags(fine, mesh.gates) if coarse_bits < fine_bits else b""
        fields = basis_writer.basis_fields(K, fine_bits, coarse_bits, random.pick((0, 5, 20, 48)), origin,
                                           random.pick(STEPS), self.scales, flags,
                                           coded.groups[0] if mesh.lods else coded.groups, coded.digest)
        self.parts = [Part(mesh, 0, fields)]
        for groups, digest in zip(coded.groups[1:], coded.digests[1:]):
            self.parts.append(Part(mesh, self.parts[-1].id + 1, basis_writer.part_fields(groups, digest)))
        self.ids = tuple(part.id for part in self.parts)

class Part:
    """One of the chunks of a basis."""
    def __init__(self, mesh, adds_to, fields):
        self.mesh, self.payload = mesh, writer.plan(mesh.id, adds_to, reference.MODE_BASIS, fields)
        self.id = writer.checksum(self.payload)

class UnknownPlan:
    """Planes of a mode that nobody knows."""
    def __init__(self, random, mesh):
        self.mesh = mesh
        self.payload = writer.plan(mesh.id, 0 * random.below(3), random.between(3, 200), random.some_bytes(4))

def in_order(chunks, chunk):
    """Where a chunk stands among others; behind them where it does not."""
    return chunks.index(chunk) if chunk in chunks else len(chunks)

class RandomStream:
    """One stream. Chunks are planned first, since HEAD bounds them."""
    def __init__(self, seed):
        self.random, self.lossless = Random(seed), seed >= 1000
        self.meshes = [Mesh(self.random, seed >= 3000, seed >= 4000, seed >= 5000) for _ in range(self.random.between(1, 3))]
        self.window = self.random.between(1, 3)
        self.label = self.random.pick((0, 0, 17, 2 ** 62))
        self.bases = [Basis(self.random, mesh) for mesh in self.meshes if mesh.turns and seed >= 2000
                      for _ in range(self.random.between(1, 3))]
        self.plan_window = self.random.between(1, 3 if seed < 3000 else 9) if self.bases else 1

    def write(self):
        random, body = self.random, self.body()
        gops = [payload for kind, payload, _ in body if kind == b"GOP "]
        bounds = {
            "vertices": max(mesh.V for mesh in self.meshes) + random.below(3),
            "faces": max(mesh.F for mesh in self.meshes) + random.below(3),
            "frames_per_gop": 4 + random.below(3),
            "packet_bytes": max([200] + [len(payload) for payload in gops]),
            "meshes": self.window,
            "mesh_bytes": max(len(mesh.payload) for mesh in self.meshes) + random.below(3),
        }
        property_bytes = max(mesh.property_bytes for mesh in self.meshes)
        if property_bytes > 0:
            bounds["property_bytes"] = property_bytes + random.below(3)
        plans = [payload for kind, payload, _ in body if kind == b"PLAN"]
        if plans:
            bounds |= {"plan_bytes": max(map(len, plans)) + random.below(3), "components": random.below(100),
                       "plans": random.between(1, 256)}
        if self.bases:
            bounds |= {"components": max(basis.K for basis in self.bases) + random.below(3), "plans": self.plan_window,
                       "frames_per_gop": 70 + random.below(3)}
        shapes = any(mesh.turns for mesh in self.meshes)
        bounds["decoder_memory"] = writer.memory(**bounds, shapes=shapes, lods=any(mesh.lods for mesh in self.meshes)) + random.pick((0, 0, 1, 10 ** 6))
        others = {key: random.below(2 ** 63) for key in (0, 2, 8, 14, 1000) if random.chance(20)}
        stream = Stream()
        stream.add(b"HEAD", writer.head(others=others, **bounds))
        for kind, payload, named in body:
            if kind == b"GOP ":
                stream.add_gop(payload, *named)
            elif kind in (b"MESH", b"PLAN"):
                stream.add_named(kind, payload)
            else:
                stream.add(kind, payload, None if kind in writer.ANCILLARY else 1)
        for kind in (0, 5, 6, 2 ** 50):  # entries a reader does not know, for chunks it does or not
            if random.chance(20):
                place = random.below(len(stream.entries) + 1)
                low = stream.entries[place - 1][1] if place > 0 else 0
                high = stream.entries[place][1] if place < len(stream.entries) else len(stream.data)
                if high > low + 1:
                    stream.entries.insert(place, (kind, random.between(low + 1, high - 1), random.some_bytes(3)))
        stream.add_indx()
        self.unknown(stream)
        stream.add_tail()
        return bytes(stream.data)

    def unknown(self, stream):
        while self.random.chance(30):
            stream.add(self.random.pick(KINDS_UNKNOWN), self.random.some_bytes(self.random.below(9)), 1)

    def body(self):
        """The chunks between HEAD and INDX: kind, payload, what a GOP's entry names."""
        random, chunks, in_force, plans, gone = self.random, [], [], [], set()  # gone: plans before their mesh

        def asides():
            while random.chance(30):
                chunks.append(random.pick((self.meta, self.data, self.aside))() + (None,))

        def show(mesh):
            if mesh in in_force:
                in_force.remove(mesh)
            in_force.append(mesh)
            del in_force[:-self.window]
            chunks.append((b"MESH", mesh.payload, None))
            gone.update(plan for plan in plans if plan.mesh is mesh)

        def add_plan(plan):
            if plan in plans:
                plans.remove(plan)
            plans.append(plan)
            gone.discard(plan)
            del plans[:-self.plan_window]
            chunks.append((b"PLAN", plan.payload, None))

        for number in range(random.between(3, 6) + 4 * bool(self.bases)):
            asides()
            if number == 0 or random.chance(60):
                show(random.pick(self.meshes))
            asides()
            if random.chance(15):
                add_plan(UnknownPlan(random, random.pick(in_force)))
            possible = [basis for basis in self.bases if basis.mesh in in_force]
            if possible and random.chance(60):
                for part in random.pick(possible).parts:
                    add_plan(part)
            usable = [basis for basis in sorted(self.bases, key=lambda basis: in_order(plans, basis.parts[0]))
                      if basis.mesh in in_force and all(part in plans and part not in gone for part in basis.parts)]
            if usable and random.chance(70):
                basis = random.pick(usable)
                payload, frame_count = self.basis_gop(basis)
                chunks.append((b"GOP ", payload, (basis.mesh.id, frame_count, basis.ids)))
            if random.chance(85):
                mesh = random.pick(in_force)
                payload, frame_count = self.gop(mesh)
                chunks.append((b"GOP ", payload, (mesh.id, frame_count)))
        asides()
        return chunks

    def meta(self):
        keys = sorted({self.random.pick((b"name", b"fps", b"up", b"units", "größe".encode())) for _ in range(3)})
        keys = keys[self.random.below(3):]
        return b"META", writer.meta([(key, self.random.pick((b"", b"30", b"y"))) for key in keys])

    def data(self):
        random = self.random
        name = random.pick((b"extras", b"materials.json", "\U0001F600".encode()))
        content = random.some_bytes(random.below(9))
        encoding = random.pick((0, 1, 1, 7))
        if encoding == 0:
            return b"DATA", writer.data(name, 0, len(content), content)
        if encoding == 1:  # one block of one byte repeated, in a frame that says how often
            size = random.between(20, 255)
            block = (1 + 2 * 1 + 8 * size).to_bytes(3, "little") + random.some_bytes(1)
            return b"DATA", writer.data(name, 1, size, bytes.fromhex("28B52FFD20") + bytes([size]) + block)
        return b"DATA", writer.data(name, encoding, len(content) + random.below(99), content)

    def aside(self):
        return self.random.pick(KINDS_UNKNOWN), self.random.some_bytes(self.random.below(9))

    def gop(self, mesh):
        """A GOP of a mesh: payload and frame_count."""
        is_lossless = self.lossless and mesh.turns and self.random.chance(30)
        return self.lossless_gop(mesh) if is_lossless else self.elp_gop(mesh)

    def channels(self, mesh):
        return [1] + sorted({channel for channel in (2, 6, 10 ** 6) if self.random.chance(15)} | mesh.channels().keys())

    def framed(self, mesh, frames, frame_count, choose_predictor, channels):
        """The packets of frames, and of the digest."""
        random, packets, known = self.random, [], mesh.channels()
        for number in range(frame_count):
            self.ancillary(packets)
            predictor = choose_predictor(number)
            pieces = [frames.write(predictor)] + [
                known[channel].write(random) if channel in known else random.some_bytes(random.below(4))
                for channel in channels[1:]]
            packets.append((32 + predictor, b"".join(map(writer.sized, pieces[:-1])) + pieces[-1]))
        self.ancillary(packets)
        digests = [(channel, frames.digest() if channel == 1 else
                    reference.xxh64(bytes(known[channel].hashed)) if channel in known else random.below(2 ** 64))
                   for channel in channels]
        packets.append((1, writer.digest(digests)))
        self.ancillary(packets)
        return packets

    def finished(self, mesh, frame_count, packets, **header):
        """The payload of a GOP of these packets, and frame_count."""
        packet = writer.gop_header(mesh.id, self.label, frame_count, len(packets), **header)
        if self.label < 2 ** 62:
            self.label += frame_count + self.random.pick((0, 0, 0, 5))
        return writer.gop([(0, packet)] + packets), frame_count

    def lossless_gop(self, mesh):
        random, channels, frame_count = self.random, self.channels(mesh), self.random.between(1, 4)
        kind = random.below(2)
        amount = random.pick(((0, 0, 13, 23), (0, 100, 149, 252))[kind])
        frames = writer.LosslessWriter(mesh.turns, mesh.shape, kind, amount, number_chooser(random))
        packets = self.framed(mesh, frames, frame_count, lambda number: PYRAMID, channels)
        return self.finished(mesh, frame_count, packets, mode=2,
                             fields=writer.lossless_fields(kind, amount, channels))

    def basis_gop(self, basis):
        random, channels = self.random, self.channels(basis.mesh)
        alike = random.pick((0, 50, 100))

        def choose_back(before):
            return random.between(2, before - 1) if before > 2 and random.chance(alike) else 0

        frames = basis_writer.BasisWriter(basis, row_chooser(random, basis), choose_back)
        frame_count = 70 if random.chance(10) else random.between(1, 4)  # 70 are more than are remembered
        packets = self.framed(basis.mesh, frames, frame_count, lambda number: ROWS, channels)
        return self.finished(basis.mesh, frame_count, packets, planes=basis.ids, mode=reference.MODE_BASIS,
                             fields=writer.channel_fields(channels))

    def elp_gop(self, mesh):
        random = self.random
        fine_bits = random.pick((1, 4, 8, 12, 24))
        coarse_bits = fine_bits if random.chance(40) else random.between(1, fine_bits)
        fine = [random.below(2) for _ in mesh.gates] if coarse_bits < fine_bits else [1] * mesh.V
        channels = self.channels(mesh)
        turns = mesh.turns if random.chance(80) else None
        first = (SPACE, PYRAMID, PYRAMID) if turns else (SPACE,)
        frames = writer.FrameWriter(mesh.gates, fine, fine_bits, coarse_bits, chooser(random), turns)
        frame_count = random.between(1, 4)
        others = (*first, TIME, ELP, ELP)
        packets = self.framed(mesh, frames, frame_count, lambda number: random.pick(first if number == 0 else others), channels)
        origin = [random.pick((0.0, -1.0, 1e-3, 123.456, -1e30)) for _ in range(3)]
        flags = writer.flags(fine, mesh.gates) if coarse_bits < fine_bits else b""
        named = writer.predictors_of(packets) | (random.below(16) if turns else random.below(8))
        fields = writer.elp_fields(named, fine_bits, coarse_bits, origin, random.pick(STEPS), flags, channels)
        return self.finished(mesh, frame_count, packets, fields=fields)

    def ancillary(self, packets):
        while self.random.chance(20):
            packets.append((self.random.between(128, 255), self.random.some_bytes(self.random.below(5))))

def main(arguments):
    if len(arguments) < 2 or not all(argument.isdecimal() for argument in arguments[1:]):
        print("usage: random_streams.py FOLDER SEED...", file=sys.stderr)
        return 2
    for seed in arguments[1:]:
        with open(os.path.join(arguments[0], f"random_{seed}.tvg"), "wb") as file:
            file.write(RandomStream(int(seed)).write())
    return 0

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
