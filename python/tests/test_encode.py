"""Promises of tvg.encode: what comes back, what is refused and how, and how much memory it takes."""
import io
import os
import pathlib
import subprocess
import tempfile
import tracemalloc
import unittest
from fractions import Fraction

import numpy as np
import tvg
from toolbox import as_set, grid, wave, write_obj, write_pc2


class RoundTrips(unittest.TestCase):
    def test_no_coordinate_is_off_by_more_than_half_a_step(self):
        positions = wave()
        extent = (positions.max(axis=(0, 1)) - positions.min(axis=(0, 1))).max()
        for bits in (7, 11, 16):
            back, faces = tvg.decode(tvg.encode(positions, grid(), bits=bits))
            # and what float32 rounds by
            self.assertLessEqual(abs(back - positions).max(), extent / 2**bits / 2 + 1e-7, bits)
            self.assertEqual(as_set(faces), as_set(grid()))

    def test_two_resolutions_keep_their_own_bound_and_say_who_has_which(self):
        positions = wave()
        with tvg.open(tvg.encode(positions, grid(), bits="12:8", importance=0.25)) as clip:
            for frame in clip:
                error = abs(frame.positions - positions[frame.number]).max(axis=1)
                self.assertLessEqual(error[frame.gop.important].max(), frame.gop.fine_step / 2 + 1e-7)
                self.assertLessEqual(error.max(), frame.gop.coarse_step / 2 + 1e-7)
                self.assertEqual(frame.gop.important.sum(), round(0.25 * positions.shape[1]))

    def test_weights_and_criteria_choose_the_important_vertices(self):
        positions = wave()
        weights = np.zeros(positions.shape[1])
        weights[17:53] = 1
        chosen = tvg.Importance(weights=weights, threshold=0.5)
        with tvg.open(tvg.encode(positions, grid(), bits="12:8", importance=chosen)) as clip:
            np.testing.assert_array_equal(clip[0].gop.important, weights > 0)
        found = tvg.measure(positions[:50], grid(), "curv+0.5*velocity")
        with tvg.open(tvg.encode(positions, grid(), bits="12:8", importance="curv+0.5*velocity")) as clip:
            np.testing.assert_array_equal(clip[0].gop.important, found.important)

    def test_lossless_keeps_every_bit(self):
        positions = np.random.default_rng(1).standard_normal((4, 30, 3)).astype(np.float32)
        positions[2, 3] = [-0.0, 1e-40, 3e38]
        back, _ = tvg.decode(tvg.encode(positions, [[0, 1, 2]], lossless=True))
        self.assertEqual(back.tobytes(), positions.tobytes())

    def test_max_error_holds_in_both_modes(self):
        positions = wave()
        for mode in ("elp", "basis"):
            back, _ = tvg.decode(tvg.encode(positions, grid(), max_error=0.003, mode=mode))
            self.assertLessEqual(abs(back - positions.astype(np.float32)).max(), 0.003, mode)

    def test_step_is_the_edge_of_a_cell(self):
        with tvg.open(tvg.encode(wave(), grid(), step="0.01:0.04")) as clip:
            self.assertEqual((clip[0].gop.fine_step, clip[0].gop.coarse_step), (0.01, 0.04))

    def test_frame_rates_and_metadata_come_back(self):
        stream = tvg.encode(
            wave(2),
            grid(),
            fps=Fraction(30000, 1001),
            metadata={"units": "m", "größe": "ü"},
            data={"a": b"\0b" * 999},
        )
        with tvg.open(stream) as clip:
            self.assertAlmostEqual(clip.fps, 29.97, places=3)
            self.assertEqual(dict(clip.metadata), {"fps": "30000/1001", "units": "m", "größe": "ü"})
            self.assertEqual(dict(clip.data), {"a": b"\0b" * 999})

    def test_polygons_come_back_as_they_were(self):
        quads = [[0, 1, 4, 3], [1, 2, 5, 4]]
        with tvg.open(tvg.encode(np.random.default_rng(3).random((2, 6, 3)), quads)) as clip:
            self.assertEqual(as_set(clip.mesh.polygon_faces()), quads)

    def test_what_was_decoded_can_be_encoded_again(self):
        uv = np.random.default_rng(2).random((144, 2))
        heat = np.random.default_rng(2).random((30, 144, 1))
        first = tvg.encode(wave(), grid(), step=0.01, fps=24, attributes={"uv": uv, "heat": heat})
        again = tvg.encode(tvg.open(first), step=0.01)
        self.assertEqual(again, first)

    def test_meshes_may_change_from_frame_to_frame(self):
        meshes = [tvg.Mesh(grid(side).astype(np.uint32), side * side) for side in (5, 9, 5)]
        frames = [tvg.Frame(wave(1, side)[0], mesh) for side, mesh in zip((5, 9, 5), meshes)]
        with tvg.open(tvg.encode(frames, step=1e-3)) as clip:
            self.assertEqual([len(frame.positions) for frame in clip], [25, 81, 25])
            for frame, given in zip(clip, frames):
                self.assertEqual(as_set(frame.faces), as_set(given.faces))
                np.testing.assert_allclose(frame.positions, given.positions, atol=6e-4)
            with self.assertRaisesRegex(ValueError, "where meshes change"):
                clip.positions()

    def test_meshes_that_grow_bring_their_attributes_parts_and_polygons(self):
        frames = []
        for side in (4, 9):
            squares = side * side
            heat = tvg.Attribute(np.linspace(0, 1, squares, dtype=np.float32), name="heat")
            uv = tvg.Attribute(np.zeros((1, 2), np.float32), "texcoord", "corner", np.zeros_like(grid(side)))
            parts = [tvg.Part(object=f"part {number}") for number in range(side)]
            faces = grid(side).astype(np.uint32)
            mesh = tvg.Mesh(faces, squares, tvg.Attributes([heat, uv]), parts, np.arange(len(faces), dtype=np.uint32) % side)
            frames.append(tvg.Frame(wave(1, side)[0].astype(np.float32), mesh))
        sizes = [frame.mesh.property_bytes() for frame in frames]
        self.assertLess(sizes[0], sizes[1])
        most = {"vertices": 81, "faces": len(frames[1].faces), "property_bytes": sizes[1]}
        for stream in (tvg.encode(frames), tvg.encode(iter(frames), limits=most)):
            with tvg.open(stream) as clip:
                self.assertEqual([len(frame.mesh.parts) for frame in clip], [4, 9])
        with self.assertRaisesRegex(tvg.Error, "the head declares"):
            tvg.encode(iter(frames), limits={**most, "property_bytes": sizes[1] - 1})

    def test_streams_join_at_their_borders(self):
        one, other = (tvg.encode(part, grid(), step=0.01) for part in np.split(wave(), 2))
        np.testing.assert_array_equal(
            tvg.decode(tvg.join([one, other]))[0], np.concatenate([tvg.decode(one)[0], tvg.decode(other)[0]])
        )


class Arrays(unittest.TestCase):
    def test_any_real_type_and_layout_is_the_same_stream(self):
        positions = wave().astype(np.float32)
        stream = tvg.encode(positions, grid())
        for other in (
            positions.astype(np.float64),
            np.asfortranarray(positions),
            np.repeat(positions, 2, axis=1)[:, ::2],
            positions.astype(">f4"),
            positions.tolist(),
            [frame for frame in positions],
            tuple(positions),
        ):
            self.assertEqual(tvg.encode(other, grid().tolist()), stream)

    def test_an_iterator_is_gone_through_once_and_gives_the_same_with_the_same_box(self):
        positions = wave().astype(np.float32)
        box = positions.min(axis=(0, 1)), positions.max(axis=(0, 1))
        stream = tvg.encode(iter(positions), grid(), box=box)
        self.assertEqual(stream, tvg.encode(positions, grid()))

    def test_threads_do_not_change_the_bytes(self):
        streams = {tvg.encode(wave(), grid(), gop=5, threads=threads) for threads in (1, 2, 5)}
        self.assertEqual(len(streams), 1)

    def test_memory_does_not_grow_with_the_frames_of_an_iterator(self):
        peaks = []
        for frames in (40, 400):
            frame = wave(1, 60)[0]
            tracemalloc.start()
            with open(os.devnull, "wb") as sink:
                tvg.encode((frame for _ in range(frames)), grid(60), sink, step=0.01, gop=10, threads=1)
            peaks.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
        self.assertLess(peaks[1], peaks[0] + frame.nbytes * 4)


class Attributes(unittest.TestCase):
    def test_shapes_say_what_has_a_value(self):
        random = np.random.default_rng(4)
        faces = grid()
        given = {
            "uv": random.random((144, 2)),
            "heat": random.random(144),
            "color": np.repeat(random.random(len(faces)), 9).reshape(-1, 3, 3),
            "speed": random.random((30, 144, 1)),
        }
        with tvg.open(tvg.encode(wave(), faces, attributes=given)) as clip:
            kinds = {key: (a.kind, a.domain, a.animated) for key, a in clip.attributes.items()}
            self.assertEqual(kinds["uv"], ("texcoord", "vertex", False))
            self.assertEqual(kinds["heat"], ("generic", "vertex", False))
            self.assertEqual(kinds["color"], ("colour", "corner", False))
            self.assertEqual(kinds["speed"], ("generic", "vertex", True))
            np.testing.assert_array_equal(
                clip.attributes["heat"].values[:, 0], given["heat"].astype(np.float32)
            )
            np.testing.assert_allclose(clip.attributes["uv"].values, given["uv"], atol=2**-12)
            red = {tuple(sorted(face)): value for face, value in zip(faces.tolist(), given["color"][:, 0, 0])}
            for face, value in zip(clip.faces.tolist(), clip.attributes["color"].at_corners()):
                np.testing.assert_allclose(value, red[tuple(sorted(face))], atol=2**-8)
            for frame in clip:
                values = given["speed"][frame.number].astype(np.float32)
                np.testing.assert_array_equal(frame.attributes["speed"].values, values)
            with self.assertRaisesRegex(ValueError, "animated"):
                clip.attributes["speed"].values

    def test_bits_and_kinds_can_be_said(self):
        values = np.random.default_rng(5).random((144, 3))
        given = tvg.Attribute(values, kind="generic", bits=tvg.EXACT)
        with tvg.open(tvg.encode(wave(2), grid(), attributes={"normal": given})) as clip:
            attribute = clip.attributes["normal"]
            self.assertEqual((attribute.kind, attribute.bits), ("generic", tvg.EXACT))
            np.testing.assert_array_equal(attribute.values, values.astype(np.float32))

    def test_parts_come_back(self):
        parts = [tvg.Part(object="a", material="steel"), tvg.Part("b", "g")]
        face_parts = np.arange(len(grid())) % 2
        with tvg.open(tvg.encode(wave(2), grid(), parts=parts, face_parts=face_parts)) as clip:
            self.assertEqual(clip.parts, parts)
            of_face = {tuple(sorted(face)): part for face, part in zip(grid().tolist(), face_parts)}
            for face, part in zip(clip.faces.tolist(), clip.mesh.face_parts):
                self.assertEqual(part, of_face[tuple(sorted(face))])


class Refusals(unittest.TestCase):
    def refused(self, pattern, *arguments, kind=ValueError, **options):
        with self.assertRaisesRegex(kind, pattern):
            tvg.encode(*arguments, **options)

    def test_say_what_is_wrong_with_positions_and_where(self):
        bad = wave(5)
        bad[3, 7, 1] = np.nan
        self.refused("frame 3, vertex 7: y is nan", bad, grid())
        self.refused("frame 3, vertex 7: y is nan", iter(bad), grid())
        self.refused(r"frame 0, vertex 0: x is 1e\+300", np.full((1, 4, 3), 1e300), [])
        self.refused(r"shape \(144, 3\).*newaxis", wave(1)[0], grid())
        self.refused(r"shape \(144, 2\).*\[vertex, 3\]", wave(2)[:, :, :2], grid())
        self.refused(r"shape \(3, 144\).*transpose", wave(2).transpose(0, 2, 1), grid())
        self.refused("frame 1 has 143 vertices, and the mesh 144", [wave(1)[0], wave(1)[0][1:]], grid())
        self.refused("frame 0 is complex128", wave(2).astype(complex), grid())
        self.refused("there is no frame", np.zeros((0, 4, 3)), [])
        self.refused("there is no frame", iter([]), [])

    def test_say_what_is_wrong_with_faces(self):
        self.refused(r"faces\[1, 2\] is 144, but there are 144 vertices", wave(2), [[0, 1, 2], [2, 3, 144]])
        self.refused(r"faces\[0, 0\] is -1", wave(2), [[-1, 1, 2]])
        self.refused("whole", wave(2), [[0.5, 1, 2]])
        self.refused("shape", wave(2), [0, 1, 2])
        self.refused("faces= are missing", wave(2))

    def test_say_what_is_wrong_with_options(self):
        for pattern, options in {
            "bits='13:15'": {"bits": "13:15"},
            "bits=25": {"bits": 25},
            "bits=1.5": {"bits": 1.5},
            "step=0": {"step": 0},
            "power of two": {"step": "0.01:0.03"},
            "max_error=-1": {"max_error": -1},
            "exclude each other": {"bits": 11, "step": 0.1},
            "lossless exclude": {"bits": 11, "lossless": True},
            "mode='fast'": {"mode": "fast"},
            "predictor='x'": {"predictor": "x"},
            "fps='often'": {"fps": "often"},
            "gop=0": {"gop": 0},
            "period needs": {"period": 10},
            "two resolutions": {"importance": 0.5},
            "there are curv": {"importance": "beauty", "bits": "12:9"},
            "share is 35": {"importance": 35, "bits": "12:9"},
            "skel": {"importance": "skel", "bits": "12:9"},
            "fits nothing": {"attributes": {"uv": np.zeros((7, 2))}},
            "limits: there is no": {"limits": {"holes": 3}},
        }.items():
            self.refused(pattern, wave(3), grid(), **options)

    def test_what_the_library_refuses_has_its_code(self):
        with self.assertRaises(tvg.InputError) as caught:
            tvg.encode(wave(3), grid(), box=((0, 0, 0), (0.5, 0.5, 0.5)))
        self.assertEqual(caught.exception.code, tvg.Code.INVALID_INPUT)
        self.assertEqual(caught.exception.frame, 0)

    def test_a_share_of_the_diagonal_needs_frames_that_can_be_gone_through_twice(self):
        self.refused("gone through twice", iter(wave(3)), grid(), max_error="0.1%")
        tvg.encode(wave(3), grid(), max_error="0.1%")


class Outputs(unittest.TestCase):
    def test_a_path_a_file_and_bytes_are_the_same(self):
        stream = tvg.encode(wave(), grid())
        with tempfile.TemporaryDirectory() as folder:
            for path in (os.path.join(folder, "a.tvg"), pathlib.Path(folder, "b.tvg")):
                report = tvg.encode(wave(), grid(), path)
                self.assertEqual(pathlib.Path(path).read_bytes(), stream)
                self.assertEqual((report.frames, report.bytes), (30, len(stream)))
            self.assertEqual(sorted(os.listdir(folder)), ["a.tvg", "b.tvg"])
        file = io.BytesIO()
        tvg.encode(wave(), grid(), file)
        self.assertEqual(file.getvalue(), stream)

    def test_a_file_appears_when_it_is_whole_and_not_before(self):
        def broken():
            yield from wave(60)
            raise RuntimeError("the simulation stopped")

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(RuntimeError, "stopped"):
                tvg.encode(broken(), grid(), os.path.join(folder, "a.tvg"), step=0.01)
            self.assertEqual(os.listdir(folder), [])

    def test_what_a_file_object_raises_passes_through(self):
        class Full(io.RawIOBase):
            def write(self, data):
                raise OSError(28, "No space left on device")

        with self.assertRaisesRegex(OSError, "No space"):
            tvg.encode(wave(), grid(), Full())

    def test_bytes_leave_as_soon_as_a_group_is_complete(self):
        sizes, file = [], io.BytesIO()

        def frames():
            for frame in wave(30):
                sizes.append(len(file.getvalue()))
                yield frame

        tvg.encode(frames(), grid(), file, step=0.01, gop=10, threads=1)
        self.assertGreater(sizes[21], sizes[11])
        self.assertGreater(sizes[11], 0)

    def test_progress_is_told(self):
        told = []
        tvg.encode(wave(3), grid(), progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told, [(1, 3), (2, 3), (3, 3)])


@unittest.skipUnless(os.path.exists(os.environ.get("TVG_TOOL", "")), "TVG_TOOL names no tvg to compare with")
class BesideTheTool(unittest.TestCase):
    def test_the_same_options_make_the_same_bytes(self):
        positions = wave(70).astype(np.float32)
        with tempfile.TemporaryDirectory() as folder:
            mesh, cache, made = (os.path.join(folder, name) for name in ("a.obj", "a.pc2", "a.tvg"))
            write_obj(mesh, positions[0], grid())
            write_pc2(cache, positions)
            for words, options in {
                "--bits 11": {"bits": 11},
                "--bits 13:11 --important 20% --fps 24": {"bits": "13:11", "importance": 0.2, "fps": 24},
                "--bits 12:9 --measure curv+0.5*velocity --smooth 2": {
                    "bits": "12:9",
                    "importance": tvg.Importance("curv+0.5*velocity", smooth=2),
                },
                "--step 0.01:0.02 --gop 7": {"step": (0.01, 0.02), "gop": 7},
                "--max-error 0.1%": {"max_error": "0.1%"},
                "--max-error 0.002 --mode basis": {"max_error": 0.002, "mode": "basis"},
                "--mode basis --period 20 --effort 2": {"mode": "basis", "period": 20, "effort": 2},
                "--mode basis --bits 9": {"mode": "basis", "bits": 9},
                "--lossless": {"lossless": True},
                "--predictor auto --reorder": {"predictor": "auto", "reorder": True},
            }.items():
                command = [
                    os.environ["TVG_TOOL"],
                    "encode",
                    mesh,
                    cache,
                    "-o",
                    made,
                    "--quiet",
                    *words.split(),
                ]
                subprocess.run(command, check=True)
                own = tvg.encode(positions, grid(), **options)
                self.assertEqual(own, pathlib.Path(made).read_bytes(), words)


if __name__ == "__main__":
    unittest.main()
