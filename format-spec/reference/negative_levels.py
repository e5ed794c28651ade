"""Negative streams of levels and coarse meshes (§5.5, §5.6), and of the parts of a basis (§4.9, §7.8.1)."""
import tvg_basis_writer as basis_writer
import tvg_reference as reference
import tvg_writer as writer
from negative_base import (BOUNDS, CONNECTIVITY, FRAMES, GATES, connectivity, of_broken_meshes, put, put_named,
                           stream)
from negative_basis import FIELDS, K, SCALES, SHIFT, choose, gop
from negative_pyramid import FACES, MESH_ID as SHAPE_ID, of_shape_parts, shape
from tvg_reference import MODE_BASIS
from tvg_writer import varint

LEVELS = [0, 1, 2, 0]
LOD_BOUNDS = BOUNDS | {"mesh_bytes": 200, "plan_bytes": 200, "components": K, "plans": 4}
LOD_BOUNDS["decoder_memory"] = writer.memory(**LOD_BOUNDS, lods=True)
HEAD = put(b"HEAD", writer.head(**LOD_BOUNDS))
# Vertices 0, 1 and 3, then 0 and 3, both without a face.
FINER = (2, 3, 0, connectivity(3, 0, 0), writer.identity_order())
COARSER = (1, 2, 0, connectivity(2, 0, 0), writer.identity_order())
LODS = writer.lods([FINER, COARSER])

def mesh(levels=writer.levels(LEVELS, GATES), lods=LODS, sections=()):
    return writer.mesh(4, 1, [(1, CONNECTIVITY), *sections, (7, levels), (9, lods)])

def levels():
    levels_of = {"none": b"\0" + writer.levels(LEVELS, GATES)[1:], "many": b"\x41" + writer.levels(LEVELS, GATES)[1:],
                 "without_a_vertex": writer.levels([0, 2, 2, 0], GATES), "empty": b""}
    cases = {f"levels_{name}": ("malformed", "5.5", writer.mesh(4, 1, [(1, CONNECTIVITY), (7, section)]))
             for name, section in levels_of.items()}
    whole = writer.levels(LEVELS, GATES)
    cases |= {f"levels_{name}": ("malformed", "6.1", writer.mesh(4, 1, [(1, CONNECTIVITY), (7, section)]))
              for name, section in (("left_over", whole + b"\0"), ("cut", whole[:1]))}
    yield from of_broken_meshes(cases, HEAD=HEAD)

def coarse_meshes():
    def changed(which, value):
        return FINER[:which] + (value,) + FINER[which + 1:]

    sections = {
        "empty": b"", "none": varint(0), "many": varint(17) + LODS[1:], "cut": LODS[:-1], "left_over": LODS + b"\0",
        "of_no_level": writer.lods([changed(0, 0)]), "of_all_levels": writer.lods([(3, 4) + FINER[2:]]),
        "of_more_levels": writer.lods([changed(0, 2 ** 40)]), "that_do_not_descend": writer.lods([FINER, FINER]),
        "that_ascend": writer.lods([COARSER, FINER]), "of_too_few_vertices": writer.lods([changed(1, 2)]),
        "of_too_many_vertices": writer.lods([changed(1, 4)]), "of_too_many_faces": writer.lods([changed(2, 2)]),
        "beyond": writer.lods([FINER])[:-2] + varint(99) + b"\0",
    }
    cases = {f"lods_{name}": ("malformed", "5.6", mesh(lods=section)) for name, section in sections.items()}
    cases["lods_without_levels"] = "malformed", "5.6", writer.mesh(4, 1, [(1, CONNECTIVITY), (9, LODS)])
    yield from of_broken_meshes(cases, HEAD=HEAD)
    little = put(b"HEAD", writer.head(**(LOD_BOUNDS | {"decoder_memory": LOD_BOUNDS["decoder_memory"] - 1})))
    yield from of_broken_meshes({"lods_without_memory": ("limit-exceeded", "8.2", mesh())}, HEAD=little)

MESH = mesh(sections=[(5, shape())])
MESH_ID = writer.checksum(MESH)
TURNS = reference.shape_and_turns(shape(), FACES, 4, LEVELS)[1]
PLANES = basis_writer.PlanWriter(TURNS, SHIFT, K, choose, parts=[[0, 3], [1], [2]])

def chain(first=None, changes=None, start=0, mesh_id=MESH_ID):
    """The payloads of the parts; changes: other fields of a part, by its number."""
    fields = FIELDS | {"groups": PLANES.groups[0], "digest": PLANES.digests[0]} | (first or {})
    parts = {0: basis_writer.basis_fields(**fields)}
    parts |= {i: basis_writer.part_fields(PLANES.groups[i], PLANES.digests[i]) for i in (1, 2)} | (changes or {})
    payloads, adds_to = [], start
    for i in sorted(parts):
        payloads.append(writer.plan(mesh_id, adds_to, MODE_BASIS, parts[i]))
        adds_to = writer.checksum(payloads[-1]) + 1
    return payloads

PARTS = chain()

def ids(payloads):
    return tuple(map(writer.checksum, payloads))

def of_parts(put_plans, planes=ids(PARTS), mesh_id=MESH_ID, head=HEAD, **changed):
    """The stream whose GOP1 is of the mesh with coarse meshes and names these planes; put_plans: payloads before it."""
    def before(stream):
        put_named(b"MESH", MESH)(stream)
        for payload in put_plans:
            put_named(b"PLAN", payload)(stream)

    payload = gop({"mesh_id": mesh_id, "planes": planes}, q=tuple(PLANES.q), scales=tuple(SCALES), **changed)
    return stream(before=("GOP1", before), GOP1=lambda stream: stream.add_gop(payload, mesh_id, 2, planes),
                  **(of_shape_parts() | {"HEAD": head}))

def parts():
    def case(name, section, data, error="malformed", frames=FRAMES - 2):
        return f"part_{name}", error, section, frames, data

    def changed(name, part, fields, section="7.8.1", error="malformed"):
        payloads = chain(changes={part: fields})
        return case(name, section, of_parts(payloads, ids(payloads)), error)

    groups, digests = PLANES.groups, PLANES.digests
    yield changed("digest_differs", 1, basis_writer.part_fields(groups[1], digests[1] ^ 1), error="digest-mismatch")
    yield changed("left_over", 2, basis_writer.part_fields(groups[2], digests[2]) + b"\0")
    yield changed("cut", 2, basis_writer.part_fields(groups[2], digests[2])[:-1])
    yield changed("of_too_few_groups", 1, basis_writer.part_fields(groups[1][:1], digests[1]))
    yield changed("of_too_many_groups", 1, basis_writer.part_fields(groups[1] + groups[1][:1], digests[1]))
    yield changed("empty", 2, b"")
    yield changed("group_left_over", 1, basis_writer.part_fields([groups[1][0] + b"\0", groups[1][1]], digests[1]), "6.1")
    yield changed("group_empty", 2, basis_writer.part_fields([b"", groups[2][1]], digests[2]), "6.1")
    beyond = writer.plan(MESH_ID, writer.checksum(PARTS[2]) + 1, MODE_BASIS, PARTS[2])
    yield case("beyond_the_last", "7.8.1", of_parts(PARTS + [beyond], ids(PARTS + [beyond])))
    for name, adds_to in (("nothing", 12345), ("no_name", 2 ** 32 + 1)):
        added = writer.plan(MESH_ID, adds_to, MODE_BASIS, PARTS[1])
        yield case(f"that_adds_to_{name}", "4.9", of_parts(PARTS + [added]), frames=FRAMES)
    yield case("before_what_it_adds_to", "4.9", of_parts([PARTS[1], PARTS[0], PARTS[2]]))
    yield case("of_another_mode", "4.9", of_parts(PARTS + [writer.plan(MESH_ID, ids(PARTS)[0] + 1, 9)]), frames=FRAMES)
    plain = writer.plan(SHAPE_ID, 0, MODE_BASIS, basis_writer.basis_fields(**FIELDS))
    for name, owner, section in (("of_another_mesh", MESH_ID, "4.9"), ("of_a_mesh_without_lods", SHAPE_ID, "7.8.1")):
        added = writer.plan(owner, writer.checksum(plain) + 1, MODE_BASIS, basis_writer.part_fields(groups[1], digests[1]))
        yield case(name, section, of_parts([plain, added], ids([plain, added]), owner))
    first, second, third = ids(PARTS)
    for name, planes in {"missing": (first, second), "alone": (first,), "twice": (first, first, second),
                         "in_wrong_order": (first, third, second), "and_too_many": (first, second, third, third)}.items():
        yield case(name, "4.5.1", of_parts(PARTS, planes))
    others = chain({"step": 0.5})
    yield case("of_two_bases", "4.5.1", of_parts(PARTS + others, ids(PARTS[:2] + others[2:]), head=with_plans(8)))
    yield case("gone", "4.5.1", of_parts(PARTS, head=with_plans(2)))

def with_plans(count):
    bounds = LOD_BOUNDS | {"plans": count}
    return put(b"HEAD", writer.head(**(bounds | {"decoder_memory": writer.memory(**bounds, lods=True)})))

def cases():
    for group in (levels, coarse_meshes, parts):
        yield from group()
