"""Negative streams of attributes, parts and polygons (§5.7 to §5.9)."""
import math
import struct

import tvg_attributes
import tvg_parts
import tvg_properties_writer as properties_writer
import tvg_reference as reference
import tvg_writer as writer
from negative_base import BOUNDS, connectivity, of_broken_meshes, put
from tvg_attributes import COLOUR, CORNERS, GENERIC, NORMAL, VERTICES
from tvg_corners import Surface
from tvg_writer import sized, varint

# Two triangles with an edge in common.
CONNECTIVITY = connectivity(4, 2, 0, 0, 0, 0)
FACES = reference.Connectivity(reference.RangeDecoder(CONNECTIVITY, "5.1"), 4, 2).decode()[0]
SURFACE = Surface(FACES, 4, None, reference)
PROPERTY_BOUNDS = BOUNDS | {"mesh_bytes": 300, "property_bytes": 2000}
PROPERTY_BOUNDS["decoder_memory"] = writer.memory(**PROPERTY_BOUNDS)

def head(property_bytes=2000):
    """A head with this bound and room for any."""
    bound = property_bytes if property_bytes > 0 else None
    return put(b"HEAD", writer.head(**(PROPERTY_BOUNDS | {"property_bytes": bound})))

def attribute(kind, domain, C, bits, name=b"", grid=None):
    """The head of an attribute; grid: its origin and range, which it has unless there is a reason not to."""
    fields = bytes([kind, domain, C, bits]) + sized(name)
    if kind == NORMAL or bits == 0:
        return fields
    *origin, extent = grid or (*[0.0] * C, 1.0)
    return fields + struct.pack(f"<{C}fd", *origin, extent)

HEIGHT = attribute(GENERIC, VERTICES, 1, 4, b"height")

def attributes(*heads, values=(), usual=7, count=None):
    """The section of these attributes, whose values begin with those said and go on as usual."""
    def use(coding):
        tvg_attributes.attributes_of(section + b"?", SURFACE, 0, math.inf, coding)

    section = varint(len(heads) if count is None else count) + b"".join(heads)
    return section + properties_writer.written(use, values, usual)

def mesh(*sections):
    return writer.mesh(4, 2, [(1, CONNECTIVITY), *sections])

def of_kind(kind, prefix, sections, section, error="malformed"):
    """Cases of a mesh with one more section."""
    return {f"{prefix}_{name}": (error, section, mesh((kind, content))) for name, content in sections.items()}

def attribute_cases():
    whole = attributes(HEIGHT)
    heads = {
        "kind_unknown": attribute(4, VERTICES, 1, 4), "domain_unknown": attribute(GENERIC, 3, 1, 4),
        "no_components": attribute(GENERIC, VERTICES, 0, 4), "five_components": attribute(GENERIC, VERTICES, 5, 4),
        "normals_of_two": attribute(NORMAL, VERTICES, 2, 4), "colours_of_two": attribute(COLOUR, VERTICES, 2, 4),
        "fine": attribute(GENERIC, VERTICES, 1, 25), "normals_fine": attribute(NORMAL, VERTICES, 3, 17),
        "normals_coarse": attribute(NORMAL, VERTICES, 3, 1), "name_no_text": attribute(GENERIC, VERTICES, 1, 4, b"\xff"),
        "name_zero": attribute(GENERIC, VERTICES, 1, 4, b"\0"),
        "origin_infinite": attribute(GENERIC, VERTICES, 1, 4, grid=(math.inf, 1.0)),
        "range_infinite": attribute(GENERIC, VERTICES, 1, 4, grid=(0.0, math.inf)),
        "range_none": attribute(GENERIC, VERTICES, 1, 4, grid=(0.0, math.nan)),
        "range_below_zero": attribute(GENERIC, VERTICES, 1, 4, grid=(0.0, -1.0)),
    }
    sections = {name: varint(1) + fields + b"\0" for name, fields in heads.items()}
    sections |= {
        "empty": b"", "none": varint(0) + b"\0", "many": varint(65) + bytes(65),
        "cut_in_head": whole[:5], "one_too_few": attributes(HEIGHT, count=2)[:-1],
        # The first residual is 64, the least number that is not finite, or 8.
        "value_above": attributes(HEIGHT, values=(15, 0, 0, 0, 0, 0)),
        "exact_infinite": attributes(attribute(GENERIC, VERTICES, 1, 0), values=(15, 31, 0, 0x3F800000)),
        "normal_beyond": attributes(attribute(NORMAL, VERTICES, 3, 2), values=(0, 15, 0, 0, 0, 0, 0)),
        "seam_unknown": attributes(attribute(GENERIC, CORNERS, 1, 4), values=(2,)),
    }
    cases = of_kind(4, "attributes", sections, "5.7")
    return cases | of_kind(4, "attributes", {"left_over": whole + b"\0", "cut": whole[:-1],
                                             "without_values": varint(1) + HEIGHT}, "6.1")

def part_cases():
    none, new = varint(0), varint(1) + varint(0) + sized(b"silk")
    sections = {
        "empty": b"", "none": varint(0) + none * 3, "many": varint(3) + none * 8, "name_gone": varint(1) + varint(2) + none * 2,
        "name_after": varint(1) + new + varint(3) + none, "shared": varint(1) + new + varint(1) + varint(5) + sized(b"s") + none,
        "shared_with_none": varint(1) + varint(1) + varint(1) + sized(b"s") + none * 2,
        "name_cut": varint(1) + none * 2 + varint(1) + varint(0) + varint(9) + b"cut",
        "name_no_text": varint(1) + varint(1) + varint(0) + sized(b"\xc3") + none * 2,
        "name_zero": varint(1) + varint(1) + varint(0) + sized(b"\0") + none * 2,
        "left_over": varint(1) + none * 3 + b"\0",
    }
    names = varint(2) + none * 6
    faces = names + properties_writer.written(lambda coding: tvg_parts.Parts(names + b"?", SURFACE, math.inf, coding), (), 0)
    coded = {"faces_left_over": faces + b"\0", "faces_gone": names}
    return of_kind(2, "parts", sections, "5.8") | of_kind(2, "parts", coded, "6.1")

def polygons(*values):
    return properties_writer.written(lambda coding: tvg_parts.Fans(b"?", SURFACE, math.inf, coding), values, 0)

def polygon_cases():
    free = next(i for i in range(3) if SURFACE.partner[i] == reference.NONE)
    sections = {"unknown": polygons(7), "before_the_rim": polygons(1 + 2 * free), "behind_the_rim": polygons(2 + 2 * free)}
    coded = {"empty": b"", "left_over": polygons() + b"\0"}
    return of_kind(6, "polygons", sections, "5.9") | of_kind(6, "polygons", coded, "6.1")

def cases():
    yield from of_broken_meshes(attribute_cases() | part_cases() | polygon_cases(), HEAD=head())
    shared = next(i for i in range(3) if SURFACE.partner[i] != reference.NONE)
    part, quad = varint(1) + varint(0) * 3, polygons(1 + 2 * shared)
    for name, section, kind, content, size in (("attributes", "5.7", 4, attributes(HEIGHT), 256 + 6 + 4 * 4),
                                               ("parts", "5.8", 2, part, 192 + 4 * 2), ("polygons", "5.9", 6, quad, 16)):
        for what, bound in (("exceed", size - 1), ("without_bound", 0)):
            case = {f"{name}_{what}": ("limit-exceeded", section, mesh((kind, content)))}
            yield from of_broken_meshes(case, HEAD=head(bound))
