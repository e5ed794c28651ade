"""Negative streams of mode basis (§4.5.1, §7.8)."""
import tvg_basis_writer as basis_writer
import tvg_reference as reference
import tvg_writer as writer
from negative_base import BOUNDS, ELP_FIELDS, FINE, FRAMES, put, put_named, stream
from negative_base import MESH as PLAIN_MESH
from negative_base import MESH_ID as PLAIN_ID
from negative_pyramid import MESH_ID, TURNS, of_shape_parts
from tvg_reference import MODE_BASIS, PYRAMID, ROWS, SPACE
from tvg_writer import sized, varint

K, PLACES = 5, ELP_FIELDS["fine_bits"] - ELP_FIELDS["coarse_bits"]
SHIFT = [0 if fine else PLACES for fine in FINE]
SCALES = [5, 4, 0, 0, 3, 2]
BASIS_BOUNDS = BOUNDS | {"frames_per_gop": 5, "plan_bytes": 200, "components": K, "plans": 2}
BASIS_BOUNDS["decoder_memory"] = writer.memory(**BASIS_BOUNDS)
HEAD = put(b"HEAD", writer.head(**BASIS_BOUNDS))

def choose(v, j, rounded, most):
    return (7 * v - 5 * j + rounded // 2) % 40 - 20

def choose_value(a, axis, rounded):
    return (11 * a + 3 * axis + rounded // 3) % 50 - 25

def coded(choose_coefficient=choose, shift=tuple(SHIFT)):
    return basis_writer.PlanWriter(TURNS, shift, K, choose_coefficient)

PLANES = coded()
FIELDS = {"components": K, "fine_bits": ELP_FIELDS["fine_bits"], "coarse_bits": ELP_FIELDS["coarse_bits"],
          "fraction_bits": 4, "origin": (0.0, -1.0, 0.5), "step": 0.25, "scales": SCALES, "flags": ELP_FIELDS["flags"],
          "groups": PLANES.groups, "digest": PLANES.digest}

def plan(mesh_id=MESH_ID, edit=None, **fields):
    payload = basis_writer.basis_fields(**(FIELDS | fields))
    return writer.plan(mesh_id, 0, MODE_BASIS, edit(payload) if edit else payload)

PLAN = plan()
PLAN_ID = writer.checksum(PLAN)

def gop(header=None, edit=None, q=tuple(PLANES.q), scales=tuple(SCALES), choose=choose_value,
        choose_back=lambda before: 0, count=2, channels=(1,), predictor=ROWS, fields=b""):
    """The payload of a GOP, as negative_base.gop() makes those of mode elp."""
    frames, packets = basis_writer.BasisWriter(basis_writer.Plan(list(scales), list(q)), choose, choose_back), []
    for _ in range(count):
        try:
            content = frames.write(ROWS)
        except reference.Invalid:
            frames.coder.clear()
            frames.coder.finish()
            content = frames.coder.data
        packets.append((32 + predictor, content))
    packets.append((1, writer.digest([(channel, frames.digest()) for channel in channels])))
    packets = edit(packets) if edit else packets
    values = {"mesh_id": MESH_ID, "first_frame": 2, "frame_count": count, "packet_count": len(packets),
              "planes": (PLAN_ID,), "mode": MODE_BASIS, "fields": writer.channel_fields(channels) + fields}
    return writer.gop([(0, writer.gop_header(**(values | (header or {}))))] + packets)

def of_plans(payload, *plans, planes=None, mesh_id=MESH_ID, count=2, **parts):
    """The stream with this GOP1, and plans in front of it."""
    def before(stream):
        for plan_payload in plans:
            put_named(b"PLAN", plan_payload)(stream)

    planes = tuple(map(writer.checksum, plans)) if planes is None else planes
    return stream(before=("GOP1", before), GOP1=lambda stream: stream.add_gop(payload, mesh_id, count, planes),
                  **(of_shape_parts() | {"HEAD": HEAD} | parts))

def plans():
    nan, infinity = float("nan"), float("inf")

    def case(name, payload, section="7.8.1", error="malformed", **parts):
        return (f"plan_{name}", error, section, FRAMES - 2,
                of_plans(gop({"planes": (writer.checksum(payload),)}), payload, **parts))

    yield case("components_exceeded", plan(components=K + 1), "4.1", "limit-exceeded")
    yield case("components_many", plan(components=2 ** 40), "4.1", "limit-exceeded")
    cases = {
        "fine_bits_zero": {"fine_bits": 0, "coarse_bits": 0}, "fine_bits_large": {"fine_bits": 25},
        "coarse_bits_zero": {"coarse_bits": 0}, "coarse_bits_large": {"coarse_bits": 7},
        "fraction_bits_large": {"fraction_bits": 49}, "origin_nan": {"origin": (0.0, nan, 0.0)},
        "origin_infinite": {"origin": (0.0, 0.0, -infinity)}, "step_zero": {"step": 0.0},
        "step_negative": {"step": -0.25}, "step_nan": {"step": nan}, "step_infinite": {"step": infinity},
        "scale_of_mean_large": {"scales": [164] + SCALES[1:]}, "scale_large": {"scales": SCALES[:-1] + [255]},
        "flags_of_one_lattice": {"coarse_bits": 6},
        "group_too_few": {"groups": PLANES.groups[:1]}, "group_too_many": {"groups": PLANES.groups + PLANES.groups[:1]},
    }
    for name, fields in cases.items():
        yield case(name, plan(**fields))
    edits = {
        "without_fields": lambda fields: b"", "header_cut": lambda fields: fields[:30],
        "scales_cut": lambda fields: fields[:36 + 3], "digest_cut": lambda fields: fields[:-1],
        "bytes_behind": lambda fields: fields + b"\0",
        "flags_beyond": lambda fields: fields[:36 + K + 1] + varint(2 ** 20) + fields[36 + K + 2:],
    }
    for name, edit in edits.items():
        yield case(name, plan(edit=edit))
    yield case("group_beyond", plan(edit=lambda fields: fields[:-8 - len(sized(PLANES.groups[1]))] + varint(99)
                                    + PLANES.groups[1] + fields[-8:]))
    yield case("digest_differs", plan(digest=PLANES.digest ^ 1), error="digest-mismatch")
    for name, flags in {"flags_none": b"", "flags_left_over": FIELDS["flags"] + b"\0", "flags_cut": b"\xff"}.items():
        yield case(name, plan(flags=flags), "6.1")
    first, second = PLANES.groups
    for name, groups in {"group_empty": [b"", second], "group_left_over": [first + b"\0", second],
                         "group_cut": [first, second[:-1]], "last_group_left_over": [first, second + b"\0"]}.items():
        yield case(name, plan(groups=groups), "6.1")
    for name, at, sign in (("fine", 0, 1), ("fine_below", 0, -1), ("coarse", 1, 1), ("coarse_below", 1, -1)):
        broken = coded(lambda v, j, rounded, most, at=at, sign=sign: sign * (most + 1) if v == at else rounded)
        yield case(f"coefficient_{name}", plan(groups=broken.groups, digest=broken.digest), "7.8.2")
    far = coded(lambda v, j, rounded, most: 2 ** 26 if j == 2 else rounded)
    yield case("coefficient_far", plan(groups=far.groups, digest=far.digest), "7.8.2")

def chunks():
    def case(name, error, section, data):
        return f"basis_{name}", error, section, FRAMES - 2, data

    broken = of_plans(gop(), PLAN)
    at = broken.index(PLAN) + len(PLAN)
    broken = broken[:at] + bytes([broken[at] ^ 1]) + broken[at + 1:]
    yield case("plan_damaged", "checksum-mismatch", "3.3", broken)
    yield case("without_plan", "malformed", "4.5.1", of_plans(gop({"planes": ()}), PLAN, planes=()))
    other = plan(step=0.5)
    two = (PLAN_ID, writer.checksum(other))
    yield case("two_plans", "malformed", "4.5.1", of_plans(gop({"planes": two}), PLAN, other))
    yield case("plan_twice", "malformed", "4.5.1", of_plans(gop({"planes": (PLAN_ID,) * 2}), PLAN,
                                                            planes=(PLAN_ID,) * 2))
    yield case("plan_in_lossless", "malformed", "4.5.1", of_plans(gop({"mode": 2}), PLAN))
    for name, plans_ahead in (("gone", (PLAN, other, plan(step=1.0))), ("not_there", (other,))):
        yield case(f"plan_{name}", "malformed", "4.5.1", of_plans(gop(), *plans_ahead, planes=(PLAN_ID,)))
    yield case("plan_gone_behind_one_out_of_force", "malformed", "4.5.1", stream(
        before=("GOP1", one_out_of_force), GOP1=lambda stream: stream.add_gop(gop(), MESH_ID, 2, (PLAN_ID,)),
        **(of_shape_parts() | {"HEAD": HEAD})))
    yield case("plan_of_another_mesh", "malformed", "4.5.1", with_plain_mesh(PLAN, PLAIN_ID))
    yield case("plan_without_shape", "malformed", "7.8.1", with_plain_mesh(plan(PLAIN_ID), PLAIN_ID))

def one_out_of_force(stream):
    """Three plans where two are in force; the second is not any more, but still counts."""
    for kind, payload in ((b"MESH", PLAIN_MESH), (b"PLAN", PLAN), (b"PLAN", writer.plan(PLAIN_ID, 0, 9)),
                          (b"MESH", PLAIN_MESH), (b"PLAN", plan(step=0.5))):
        put_named(kind, payload)(stream)

def with_plain_mesh(payload, mesh_id):
    """A plan in a stream that has a mesh without a reference shape, too, and a GOP of mesh_id that names it."""
    identity = writer.checksum(payload)

    def before(stream):
        put_named(b"MESH", PLAIN_MESH)(stream)
        put_named(b"PLAN", payload)(stream)

    header = {"mesh_id": mesh_id, "planes": (identity,)}
    return stream(before=("GOP1", before), GOP1=lambda stream: stream.add_gop(gop(header), mesh_id, 2, (identity,)),
                  **(of_shape_parts() | {"HEAD": HEAD}))

def headers():
    def case(name, error, section="4.5.1", **changed):
        return f"basis_{name}", error, section, FRAMES - 2, of_plans(gop(**changed), PLAN)

    yield case("fields_left_over", "malformed", fields=b"\0")
    yield case("fields_none", "malformed", header={"fields": b""})
    yield case("channels_none", "malformed", header={"fields": writer.channel_fields(())})
    yield case("without_positions", "malformed", channels=(2,))
    yield case("channels_descend", "malformed", "3.5", channels=(1, 4, 2))
    yield case("channel_unknown", "unsupported", channels=(1, 3))
    yield case("predicted_by_pyramid", "malformed", "4.5.2", predictor=PYRAMID)
    yield case("predicted_by_space", "malformed", "4.5.2", predictor=SPACE)

def frames():
    def case(name, section, error="malformed", payload=PLAN, count=2, **changed):
        header = {"planes": (writer.checksum(payload),)}
        return (f"basis_{name}", error, section, FRAMES - 2,
                of_plans(gop(header, count=count, **changed), payload, count=count))

    def recoded(change):
        return lambda packets: packets[:1] + [(packets[1][0], change(packets[1][1]))] + packets[2:]

    def at(row, in_row, otherwise=0):
        return lambda a, axis, rounded: in_row if (a, axis) == (row, 1) else otherwise

    for name, value in (("above", 2 ** 26 + 1), ("below", -2 ** 26 - 1), ("far_above", 2 ** 27 - 1)):
        yield case(f"row_{name}", "7.8.4", choose=at(3, value))
    yield case("alike_before_the_first", "7.8.4", choose_back=lambda before: before, count=4)
    yield case("alike_far_before", "7.8.4", choose_back=lambda before: 65, count=4)
    yield case("empty", "6.1", edit=recoded(lambda content: b""))
    yield case("left_over", "6.1", edit=recoded(lambda content: content + b"\0"))
    yield case("cut", "6.1", edit=recoded(lambda content: content[:-1]))
    # 2^26 * 4 * 2^24, and 2^51 twice.
    scales = [96] + SCALES[1:]
    for sign in (1, -1):
        yield case(f"sum_of_the_mean_{'plus' if sign > 0 else 'minus'}", "7.8.5", payload=plan(scales=scales),
                   scales=scales, choose=at(0, sign * 2 ** 26))
    large = coded(lambda v, j, rounded, most: 2 ** 24 * (v == 0 and j == 0) - (v == 2))
    scales = [96, 0] + SCALES[2:]
    yield case("sum", "7.8.5", payload=plan(groups=large.groups, digest=large.digest, scales=scales), scales=scales,
               q=large.q, choose=lambda a, axis, rounded: (2 ** 25, -2 ** 25)[a] if a < 2 and axis == 2 else 0)
    yield case("digest", "7.6", "digest-mismatch",
               edit=lambda packets: packets[:2] + [(1, writer.digest([(1, 0x0123456789ABCDEF)]))])

def cases():
    for group in (plans, chunks, headers, frames):
        yield from group()
