"""Promises of tvg.open: frames in any order are those of one pass, from any kind of source."""
import gc
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np
import tvg
from toolbox import Pipe, grid, wave

STREAM = tvg.encode(wave(), grid(), gop=7, bits="12:10", fps=24)
BASIS = tvg.encode(wave(), grid(), gop=7, period=14, mode="basis")


def one_pass(stream):
    with tvg.open(stream) as clip:
        return np.stack([frame.positions for frame in clip])


class Access(unittest.TestCase):
    def test_frames_and_slices_are_those_of_one_pass(self):
        for stream in (STREAM, BASIS):
            whole = one_pass(stream)
            with tvg.open(stream) as clip:
                self.assertEqual(len(clip), 30)
                np.testing.assert_array_equal(clip.positions(), whole)
                for index in (17, 16, 0, 29, -1, -30, 18, 18, 19, 25, np.int64(3)):
                    np.testing.assert_array_equal(clip[index].positions, whole[index])
                for part in (
                    slice(10, 20),
                    slice(3, None, 5),
                    slice(None, None, -3),
                    slice(-4, None),
                    slice(5, 5),
                ):
                    self.assertEqual([frame.number for frame in clip[part]], list(range(30)[part]))
                    for frame, expected in zip(clip[part], whole[part]):
                        np.testing.assert_array_equal(frame.positions, expected)
                    np.testing.assert_array_equal(clip[part].positions(), whole[part])
                np.testing.assert_array_equal(clip[5:25][::2][3].positions, whole[11])

    def test_out_is_filled_and_checked(self):
        with tvg.open(STREAM) as clip:
            out = np.empty((30, 144, 3), np.float32)
            self.assertIs(clip.positions(out=out), out)
            np.testing.assert_array_equal(out, one_pass(STREAM))
            for wrong in (out[:5], out.astype(float), np.empty((30, 144, 4), np.float32)[..., :3]):
                with self.assertRaisesRegex(ValueError, "C-contiguous float32"):
                    clip.positions(out=wrong)

    def test_an_index_that_is_not_there_is_named(self):
        with tvg.open(STREAM) as clip:
            with self.assertRaisesRegex(IndexError, "frame 30 of 30"):
                clip[30]
            with self.assertRaises(IndexError):
                clip[-31]
            with self.assertRaises(TypeError):
                clip["1"]
            with self.assertRaises(IndexError):
                clip[3:5][2]

    def test_runs_do_not_disturb_each_other(self):
        with tvg.open(STREAM) as clip:
            pairs = [(a.number, b.number) for a in clip[:3] for b in clip[10:12]]
            self.assertEqual(pairs, [(a, b) for a in range(3) for b in (10, 11)])
            first, other = iter(clip), iter(clip)
            self.assertEqual(
                [next(first).number, next(other).number, clip[9].number, next(first).number], [0, 0, 9, 1]
            )

    def test_frames_own_their_memory_unless_told_otherwise(self):
        with tvg.open(STREAM) as clip:
            kept = list(clip)
            np.testing.assert_array_equal(np.stack([frame.positions for frame in kept]), one_pass(STREAM))
            self.assertEqual(len({frame.positions.ctypes.data for frame in clip.frames(copy=False)}), 1)
        self.assertTrue(np.isfinite(kept[3].positions).all())

    def test_what_a_stream_says_of_itself(self):
        with tvg.open(STREAM, normals=True) as clip:
            self.assertEqual(clip.fps, 24)
            frame = clip[9]
            self.assertEqual((frame.gop.first_frame, frame.gop.frame_count, frame.gop.mode), (7, 7, "elp"))
            self.assertEqual(frame.predictor, "elp")
            self.assertGreater(frame.packet_bytes, 0)
            np.testing.assert_allclose(np.linalg.norm(frame.normals, axis=1), 1, atol=1e-5)
            self.assertIs(frame.mesh, clip.mesh)
            self.assertIs(clip[20].mesh, clip.mesh)


class Sources(unittest.TestCase):
    def test_any_source_gives_the_same_frames(self):
        whole = one_pass(STREAM)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.tvg")
            pathlib.Path(path).write_bytes(STREAM)
            with open(path, "rb") as file:
                for source in (
                    path,
                    pathlib.Path(path),
                    bytearray(STREAM),
                    memoryview(STREAM),
                    file,
                    io.BytesIO(STREAM),
                ):
                    with tvg.open(source) as clip:
                        np.testing.assert_array_equal(clip.positions(), whole)
                self.assertFalse(file.closed)

    def test_a_stream_within_a_file_is_read_from_where_the_file_stands(self):
        file = io.BytesIO(b"before" + STREAM)
        file.seek(6)
        with tvg.open(file) as clip:
            np.testing.assert_array_equal(clip[12].positions, one_pass(STREAM)[12])

    def test_a_pipe_is_read_once_and_frames_come_as_their_bytes_do(self):
        pipe = Pipe(STREAM)
        with tvg.open(pipe) as clip:
            frames = iter(clip)
            next(frames)
            self.assertLess(pipe._at, len(STREAM) / 2)
            for ask in (lambda: len(clip), lambda: clip[3], lambda: clip[3:5]):
                with self.assertRaisesRegex(TypeError, "only once"):
                    ask()
            self.assertEqual([frame.number for frame in frames], list(range(1, 30)))
            self.assertEqual(list(clip), [])
        np.testing.assert_array_equal(tvg.decode(Pipe(STREAM, 7))[0], one_pass(STREAM))

    def test_a_pipe_of_another_process(self):
        command = [sys.executable, "-c", "import sys; sys.stdout.buffer.write(sys.stdin.buffer.read())"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            process.stdin.write(STREAM)
            process.stdin.close()
            with tvg.open(process.stdout) as clip:
                self.assertEqual(sum(1 for _ in clip), 30)

    def test_without_an_index_frames_are_found_all_the_same(self):
        cut = STREAM[: len(STREAM) - 40]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with tvg.open(cut) as clip:
                self.assertEqual(len(clip), 30)
                np.testing.assert_array_equal(clip[20].positions, one_pass(STREAM)[20])
                np.testing.assert_array_equal(clip[2].positions, one_pass(STREAM)[2])

    def test_what_is_no_source_is_refused(self):
        with self.assertRaisesRegex(TypeError, "opened with 'rb'"):
            tvg.open(3)
        with self.assertRaisesRegex(TypeError, "opened as text"):
            tvg.open(io.StringIO("text"))
        with self.assertRaises(FileNotFoundError):
            tvg.open("there is no such file.tvg")

    def test_a_closed_clip_says_so(self):
        clip = tvg.open(STREAM)
        frame = clip[3]
        clip.close()
        clip.close()
        for ask in (lambda: clip[4], lambda: next(iter(clip)), clip.positions):
            with self.assertRaisesRegex(ValueError, "closed"):
                ask()
        np.testing.assert_array_equal(frame.positions, one_pass(STREAM)[3])

    def test_nothing_is_left_open(self):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", ResourceWarning)
            path = os.path.join(folder, "a.tvg")
            pathlib.Path(path).write_bytes(STREAM)
            next(iter(tvg.open(path)))
            pathlib.Path(path).write_bytes(b"no stream")
            with self.assertRaises(tvg.Error):
                tvg.open(path)
            gc.collect()
        self.assertEqual([str(warning.message) for warning in caught], [])


class Threads(unittest.TestCase):
    def test_clips_of_two_threads_are_independent(self):
        expected = [one_pass(STREAM), one_pass(BASIS)]
        wrong = []

        def work(stream, positions):
            for _ in range(10):
                if not np.array_equal(tvg.open(stream).positions(), positions):
                    wrong.append(stream)

        threads = [
            threading.Thread(target=work, args=pair) for pair in zip((STREAM, BASIS) * 2, expected * 2)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


class Figures(unittest.TestCase):
    def test_comparisons_agree_with_numpy(self):
        original, decoded = wave().astype(np.float32), one_pass(STREAM)
        figures = tvg.compare(original, tvg.open(STREAM), grid(), hausdorff=10)
        away = decoded.astype(float) - original
        self.assertAlmostEqual(figures.max_coordinate_error, abs(away).max())
        self.assertAlmostEqual(figures.rms_vertex_distance, np.sqrt((away**2).sum(axis=2).mean()))
        centred = original - original.astype(float).mean(axis=1, keepdims=True)
        self.assertAlmostEqual(
            figures.kg_percent, 100 * np.linalg.norm(away) / np.linalg.norm(centred), places=6
        )
        self.assertLessEqual(figures.hausdorff, figures.max_vertex_distance)
        self.assertIsNone(tvg.compare(original, decoded, []).hausdorff)

    def test_sequences_that_do_not_fit_are_refused(self):
        with self.assertRaisesRegex(ValueError, "decoded ends after 29 frames"):
            tvg.compare(wave(), wave()[:29], grid())
        with self.assertRaisesRegex(ValueError, "143 vertices"):
            tvg.compare(wave(), wave()[:, :143], grid())

    def test_costs_follow_what_moves(self):
        positions = wave()
        positions[:, :72] = positions[0, :72]
        costs, important = tvg.measure(positions, grid(), tvg.Importance("velocity", share=0.5))
        self.assertEqual(costs[:72].max(), 0)
        np.testing.assert_array_equal(important, np.arange(144) >= 72)


if __name__ == "__main__":
    unittest.main()
