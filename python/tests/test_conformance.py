"""Promises about the project's own streams: digests are the tool's, broken streams are errors and never more."""
import struct
import unittest
import warnings

import numpy as np
import tvg
from toolbox import STREAMS, Pipe, grid, listed, wave

try:
    from tvg_reference import xxh64
except ImportError:
    xxh64 = None


def facts(source, size, **options):
    """What digests.txt says of a stream, but for the lattice and the properties."""
    frames = vertices = faces = 0
    positions, corners, shown = b"", b"", None
    with tvg.open(source, **options) as clip:
        for frame in clip:
            frames += 1
            positions += frame.positions.astype("<f4").tobytes()
            if frame.mesh is not shown and (
                shown is None
                or shown.vertex_count != frame.mesh.vertex_count
                or not np.array_equal(shown.faces, frame.faces)
            ):
                vertices += frame.mesh.vertex_count
                faces += len(frame.faces)
                corners += frame.faces.astype("<u4").tobytes()
            shown = frame.mesh
    return [
        str(size),
        str(frames),
        str(vertices),
        str(faces),
        f"{xxh64(positions):016x}",
        f"{xxh64(corners):016x}",
    ]


@unittest.skipUnless(STREAMS.is_dir() and xxh64, "the conformance streams are in the project only")
class Conformance(unittest.TestCase):
    maxDiff = None

    def check(self, folder, name, line, **options):
        data = STREAMS.joinpath(*folder, name + ".tvg").read_bytes()
        said = line.split(" ")
        for source in (data, Pipe(data, 500)):
            with self.subTest(stream=name, source=type(source).__name__):
                self.assertEqual(facts(source, len(data), **options), said[:4] + said[5:7])

    def test_digests_are_those_of_the_list(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for name, line in listed("digests.txt").items():
                self.check([], name, line)
            for name, line in listed("random", "digests.txt").items():
                self.check(["random"], name, line)

    def test_coarser_meshes_have_theirs(self):
        for name, line in listed("lods.txt").items():
            stream, lod = name.split("@")
            self.check([], stream, line, lod=int(lod))

    def test_frames_asked_for_backwards_are_those_of_one_pass(self):
        for path in sorted(STREAMS.glob("*.tvg")):
            with self.subTest(stream=path.name), tvg.open(path) as clip:
                frames = list(clip)
                self.assertEqual(len(clip), len(frames))
                for frame in reversed(frames):
                    again = clip[frame.number]
                    np.testing.assert_array_equal(again.positions, frame.positions)
                    np.testing.assert_array_equal(again.faces, frame.faces)
                    for key, attribute in frame.attributes.items():
                        np.testing.assert_array_equal(again.attributes[key].values, attribute.values)

    def test_every_broken_stream_is_an_error_or_damage_with_its_code(self):
        for name, line in listed("negative", "negative.txt").items():
            code = line.split(" ")[0]
            # Of a file that has an index, the decoder need not read it a second time.
            source = Pipe(STREAMS.joinpath("negative", name + ".tvg").read_bytes())
            with self.subTest(stream=name):
                found = []
                try:
                    with tvg.open(source, on_damage=lambda damage: found.append(damage.code)) as clip:
                        for frame in clip:
                            frame.mesh.attributes
                except tvg.Error as error:
                    found.append(error.code)
                names = [tvg.Code(number).name.lower().replace("_", "-") for number in found]
                self.assertIn(code.lower(), names)

    def test_broken_streams_do_no_harm_in_any_order(self):
        for path in sorted((STREAMS / "negative").glob("*.tvg")):
            try:
                with tvg.open(path, on_damage=lambda damage: None) as clip:
                    for number in range(len(clip) - 1, -1, -1):
                        try:
                            clip[number]
                        except tvg.Error:
                            pass
            except tvg.Error:
                pass


class Damage(unittest.TestCase):
    stream = tvg.encode(wave(), grid(), gop=7)

    def broken(self):
        """The stream with a byte changed in its third group of frames."""
        at, gops = 8, []
        while at < len(self.stream):
            kind, _, length, _ = struct.unpack_from("<4s3I", self.stream, at)
            gops += [at] if kind == b"GOP " else []
            at += 16 + length + 4
        data = bytearray(self.stream)
        data[(gops[2] + gops[3]) // 2] ^= 255
        return bytes(data)

    def test_is_a_warning_and_decoding_goes_on(self):
        whole = tvg.decode(self.stream)[0]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            frames = list(tvg.open(self.broken()))
        damage = caught[0].message.damage
        self.assertEqual(damage.code, tvg.Code.CHECKSUM_MISMATCH)
        self.assertGreater(damage.byte_offset, 0)
        lost = set(range(30)) - {frame.number for frame in frames}
        self.assertEqual(lost, set(range(damage.first_frame, damage.first_frame + damage.frame_count)))
        self.assertTrue(lost and lost <= set(range(14, 21)))
        for frame in frames:
            np.testing.assert_array_equal(frame.positions, whole[frame.number])

    def test_is_told_to_who_asks(self):
        told = []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            list(tvg.open(self.broken(), on_damage=told.append))
        self.assertEqual([damage.code for damage in told], [tvg.Code.CHECKSUM_MISMATCH])

    def test_makes_a_frame_that_is_asked_for_an_error_with_its_number(self):
        with tvg.open(self.broken(), on_damage=lambda damage: None) as clip:
            for ask in (lambda: clip[20], clip.positions):
                with self.assertRaisesRegex(tvg.Error, r"frame \d+ is lost: .*checksum") as caught:
                    ask()
                self.assertEqual(caught.exception.code, tvg.Code.CHECKSUM_MISMATCH)
                self.assertIn(caught.exception.frame, range(14, 21))
            self.assertEqual(clip[21].number, 21)

    def test_errors_name_code_and_place(self):
        with self.assertRaises(tvg.Error) as caught:
            tvg.open(b"# a mesh, but no stream\nv 0 0 0\n")
        self.assertEqual(caught.exception.code, tvg.Code.NOT_TVG)
        self.assertEqual(caught.exception.byte_offset, 0)
        with self.assertRaises(tvg.Error) as caught:
            tvg.open(self.stream[:30])
        self.assertEqual(caught.exception.code, tvg.Code.TRUNCATED)

    def test_a_stream_that_asks_for_more_than_allowed_is_refused(self):
        with self.assertRaises(tvg.Error) as caught:
            tvg.open(self.stream, limits={"vertices": 100})
        self.assertEqual(caught.exception.code, tvg.Code.LIMIT_EXCEEDED)
        with self.assertRaisesRegex(ValueError, "there is no 'pixels'"):
            tvg.open(self.stream, limits={"pixels": 100})

    def test_a_stream_that_lies_about_its_length_makes_no_list_as_long(self):
        data = bytearray(self.stream)
        at = data.index(b"GOP ") + 16
        told = []
        for byte in range(at, at + 60):
            changed = bytearray(data)
            changed[byte] = 127
            try:
                told.append(len(list(tvg.open(bytes(changed), on_damage=lambda damage: None))))
            except tvg.Error:
                pass
        self.assertLessEqual(max(told), 30)

    def test_every_truncation_is_an_error_or_damage(self):
        for size in range(0, len(self.stream), 97):
            found = []
            try:
                list(tvg.open(self.stream[:size], on_damage=found.append))
            except tvg.Error as error:
                found.append(error)
            self.assertEqual([damage.code for damage in found][-1:], [tvg.Code.TRUNCATED], size)


if __name__ == "__main__":
    unittest.main()
