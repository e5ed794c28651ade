"""Negative streams of reference shapes (§5.3), of predictors (§4.5) and of frames along the pyramid (§7.7)."""
import tvg_reference as reference
import tvg_writer as writer
from negative_base import (BOUNDS, CONNECTIVITY, FRAMES, at_meeting, choose, gop, of_broken_meshes, put, put_gop,
                           put_named, recoded, stream)
from tvg_reference import ELP, PYRAMID, SPACE

HEAD = put(b"HEAD", writer.head(**(BOUNDS | {"decoder_memory": writer.memory(**BOUNDS, shapes=True)})))
FACES = reference.Connectivity(reference.RangeDecoder(CONNECTIVITY, "5.1"), 4, 1).decode()[0]

def points(choose_index=choose):
    """The range-coder stream of a shape."""
    shape = writer.ShapeWriter(FACES, 4, 8, choose_index)
    try:
        shape.decode()
    except reference.Invalid:
        shape.coder.clear()
        shape.coder.finish()
    return shape.coder.data

SHAPE_FIELDS = {"bits": 8, "neighbours": 6, "origin": (-1.0, 0.0, 2.5), "step": 0.125, "stream": points()}

def shape(**fields):
    return writer.reference_shape(**(SHAPE_FIELDS | fields))

def mesh(section):
    return writer.mesh(4, 1, [(1, CONNECTIVITY), (5, section)])

MESH = mesh(shape())
MESH_ID = writer.checksum(MESH)
SHAPE, TURNS = reference.shape_and_turns(shape(), FACES, 4)

def shapes():
    nan, infinity = float("nan"), float("inf")
    of_lattice = {"above_the_lattice": lambda v, axis, guess, cells: cells,
                  "below_the_lattice": lambda v, axis, guess, cells: -1,
                  "far_outside": lambda v, axis, guess, cells: 2 ** 26}
    sections = {
        "empty": b"", "short": shape()[:33], "bits_zero": shape(bits=0), "bits_large": shape(bits=25),
        "neighbours_few": shape(neighbours=3), "neighbours_many": shape(neighbours=17),
        "origin_nan": shape(origin=(nan, 0.0, 0.0)), "origin_infinite": shape(origin=(0.0, 0.0, -infinity)),
        "step_zero": shape(step=0.0), "step_negative": shape(step=-0.125), "step_nan": shape(step=nan),
        "step_infinite": shape(step=infinity),
    }
    sections |= {name: shape(stream=points(choose_index)) for name, choose_index in of_lattice.items()}
    streams = {"without_stream": b"", "left_over": points() + b"\0", "cut": points()[:-2]}
    cases = {f"shape_{name}": ("malformed", "5.3", mesh(section)) for name, section in sections.items()}
    cases |= {f"shape_{name}": ("malformed", "6.1", mesh(shape(stream=data))) for name, data in streams.items()}
    yield from of_broken_meshes(cases, HEAD=HEAD)
    yield from of_broken_meshes({"shape_without_memory": ("limit-exceeded", "8.2", MESH)})

def along(number=1, header=None, **changed):
    """A GOP of the mesh with a shape; its frames are predicted along the pyramid."""
    return gop(number, {"mesh_id": MESH_ID} | (header or {}),
               **({"predictors": (PYRAMID, PYRAMID), "turns": TURNS} | changed))

def of_shape(payload):
    """The stream whose mesh has a shape, with another GOP1."""
    return stream(**(of_shape_parts() | {"GOP1": put_gop(payload, MESH_ID)}))

def of_shape_parts():
    """The parts of a stream whose mesh has a shape, without GOP1."""
    payloads = {"GOP0": along(0), "GOP2": along(2, predictors=(SPACE, PYRAMID))}
    return {"HEAD": HEAD, "MESH": put_named(b"MESH", MESH)} | {
        name: put_gop(payload, MESH_ID) for name, payload in payloads.items()}

def predictors():
    def case(name, error, section, payload, make=of_shape):
        return f"predictors_{name}", error, section, FRAMES - 2, make(payload)

    def plain(payload):
        return stream(GOP1=put_gop(payload))

    def kinds(*kinds):
        return lambda packets: [(32 + kind, packets[k][1]) for k, kind in enumerate(kinds)] + packets[2:]

    for bit in (4, 6, 7):
        yield case(f"bit_{bit}", "unsupported", "4.5.1", gop(fields={"predictors": 5 + 2 ** bit}), plain)
    for named in (0, 2, 6):
        yield case(f"none_for_the_first_{named}", "malformed", "4.5.1", gop(fields={"predictors": named}), plain)
    yield case("pyramid_without_shape", "malformed", "4.5.1", gop(fields={"predictors": 13}), plain)
    yield case("by_shape_without_shape", "malformed", "4.5.1", gop(fields={"predictors": 33}), plain)
    yield case("by_shape_of_other_bits", "malformed", "4.5.1", along(fields={"predictors": 40}))
    yield case("elp_not_named", "malformed", "4.5.2", gop(fields={"predictors": 1}), plain)
    yield case("space_not_named", "malformed", "4.5.2", along(predictors=(SPACE, PYRAMID), fields={"predictors": 8}))
    yield case("pyramid_not_named", "malformed", "4.5.2", gop(edit=kinds(SPACE, PYRAMID)), plain)
    yield case("pyramid_not_named_first", "malformed", "4.5.2", along(fields={"predictors": 1}))
    yield case("first_by_elp", "malformed", "4.5.2", along(fields={"predictors": 12}, edit=kinds(ELP, PYRAMID)))

def frames():
    def case(name, section, **changed):
        return f"pyramid_{name}", "malformed", section, FRAMES - 2, of_shape(along(**changed))

    yield case("above_the_lattice", "7.5", choose_index=lambda v, axis, prediction, cells: cells)
    yield case("below_the_lattice", "7.5", choose_index=lambda v, axis, prediction, cells: -1)
    yield case("far_outside", "7.5", choose_index=lambda v, axis, prediction, cells: 2 ** 26)
    yield case("empty", "6.1", edit=recoded(lambda content: b""))
    yield case("between_the_ends", "6.1", edit=recoded(at_meeting(0, b"\0")))
    yield case("cut", "6.1", edit=recoded(at_meeting(1, b"")))

def cases():
    for group in (shapes, predictors, frames):
        yield from group()
