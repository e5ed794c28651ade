"""Promises about the package itself: examples in docstrings run, types check, and a wheel works where it is put."""
import doctest
import importlib.util
import os
import pathlib
import pkgutil
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import tvg
from toolbox import PROJECT, grid, wave, write_obj, write_pc2

PACKAGE = PROJECT / "python"


class Documentation(unittest.TestCase):
    def test_examples_in_docstrings_run(self):
        tried = 0
        for module in pkgutil.iter_modules(tvg.__path__, "tvg."):
            if module.name == "tvg.__main__":
                continue
            result = doctest.testmod(importlib.import_module(module.name), extraglobs={"np": np, "tvg": tvg})
            self.assertEqual(result.failed, 0, module.name)
            tried += result.attempted
        self.assertGreater(tried, 15)

    def test_everything_public_has_a_docstring(self):
        for name in tvg.__all__:
            if name != "EXACT":
                self.assertTrue(getattr(tvg, name).__doc__, name)

    @unittest.skipUnless((PROJECT / "docs" / "python.md").exists(), "the manual is in the project only")
    def test_the_manual_runs_as_it_is_written(self):
        text = (PROJECT / "docs" / "python.md").read_text("utf-8")
        blocks = [part.split("```")[0] for part in text.split("```python\n")[1:]]
        self.assertGreater(len(blocks), 4)
        with tempfile.TemporaryDirectory() as folder:
            program = "\n".join(blocks)
            subprocess.run([sys.executable, "-W", "error", "-c", program], cwd=folder, check=True)


class Types(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed (Debian: python3-mypy)")
    def test_hints_are_complete_and_right(self):
        with tempfile.TemporaryDirectory() as cache:
            command = [sys.executable, "-m", "mypy", "--cache-dir", cache, "--config-file", "pyproject.toml"]
            result = subprocess.run(command + ["src/tvg"], cwd=PACKAGE, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


class Library(unittest.TestCase):
    def imported(self, library, folder=None):
        environment = {key: value for key, value in os.environ.items() if key != "TVG_LIBRARY"}
        if library is not None:
            environment["TVG_LIBRARY"] = library
        if folder is not None:
            environment["PYTHONPATH"] = str(folder)
        program = "import tvg; print(tvg.version(), tvg.__file__)"
        return subprocess.run(
            [sys.executable, "-c", program], env=environment, capture_output=True, text=True, cwd="/"
        )

    def test_one_that_is_not_there_is_named(self):
        result = self.imported("/nowhere/libtvg.so")
        self.assertIn("TVG_LIBRARY", result.stderr)
        self.assertIn("/nowhere/libtvg.so", result.stderr)

    def test_another_library_is_named(self):
        result = self.imported("libm.so.6")
        self.assertIn("libm.so.6 is no libtvg", result.stderr)

    @unittest.skipUnless(
        all(map(importlib.util.find_spec, ("pip", "setuptools", "wheel"))) and os.environ.get("TVG_LIBRARY"),
        "needs TVG_LIBRARY, python3-pip, python3-setuptools and python3-wheel",
    )
    def test_a_wheel_brings_the_library_and_works_where_it_is_put(self):
        with tempfile.TemporaryDirectory() as folder:
            source, wheels, site = (pathlib.Path(folder, name) for name in ("source", "wheels", "site"))
            shutil.copytree(
                PACKAGE, source, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
            )
            shutil.copy(PROJECT / "LICENSE", folder)
            pip = [sys.executable, "-m", "pip", "-q", "--disable-pip-version-check"]
            offline = ["--no-index", "--no-deps"]
            command = pip + ["wheel", str(source), "--no-build-isolation", "-w", str(wheels)] + offline
            environment = {**os.environ, "PYTHONWARNINGS": "ignore"}
            subprocess.run(command, check=True, env=environment)
            (wheel,) = wheels.glob("tvg-*.whl")
            self.assertNotIn("none-any", wheel.name)
            subprocess.run(
                pip + ["install", "--target", str(site), str(wheel)] + offline, check=True, env=environment
            )
            result = self.imported(None, site)
            self.assertEqual(
                result.stdout.split(), [tvg.version(), str(site / "tvg" / "__init__.py")], result.stderr
            )


class Scripts(unittest.TestCase):
    def rate_distortion(self, *arguments, **environment):
        """What the example prints, line by line."""
        script = [sys.executable, str(PACKAGE / "examples" / "rate_distortion.py"), *arguments]
        environment = {**os.environ, "TVG_DATA_DIR": "", **environment}
        result = subprocess.run(script, check=True, capture_output=True, text=True, env=environment)
        return result.stdout.splitlines()

    def test_the_rate_distortion_example_makes_its_table_and_plot(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh, positions = os.path.join(folder, "a.obj"), os.path.join(folder, "a.npy")
            write_obj(mesh, wave(1)[0], grid())
            np.save(positions, wave(8))
            table = self.rate_distortion(mesh, positions, "--table1")
            self.assertEqual(len([line for line in table if line.startswith("|")]), 12, table)
            self.assertIn("Table 1: a, first 8 frames", table[0])
            drawing = os.path.join(folder, "a.svg")
            curves = self.rate_distortion(mesh, positions, "--bits", "9..10", "--plot", drawing)
            rows = [line.replace(" ", "").split("|")[1:-1] for line in curves if line.startswith("|")]
            settings = [["elp", "9"], ["elp", "10"], ["basis", "9"], ["basis", "10"]]
            self.assertEqual([fields[:2] for fields in rows[2:]], settings)
            self.assertEqual(os.path.exists(drawing), importlib.util.find_spec("matplotlib") is not None)
            self.assertLess(float(rows[3][5]), float(rows[2][5]))  # KG error falls with bits
            stream = tvg.encode(wave(8), grid(), bits=9)
            self.assertEqual(int(rows[2][2]), len(stream))

    def test_the_rate_distortion_example_takes_a_folder_and_knows_the_papers_sequence(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, frames in (("chicken", 6), ("other", 4)):
                write_obj(os.path.join(folder, name + ".obj"), wave(1)[0], grid())
                write_pc2(os.path.join(folder, name + ".pc2"), wave(frames))
            for arguments, environment in (([folder], {}), ([], {"TVG_DATA_DIR": folder})):
                lines = self.rate_distortion(*arguments, "--bits", "8", **environment)
                self.assertIn("Table 1: chicken, first 6 frames", lines[0])
                self.assertIn("paper, KB", lines[2])
                self.assertIn("| 13:11 | 15 % | 154.8 |", "\n".join(lines))
                self.assertIn("chicken: 144 vertices, 6 frames", lines)
                self.assertIn("other: 144 vertices, 4 frames", lines)

    @unittest.skipUnless(os.environ.get("TVG_CORPUS"), "TVG_CORPUS is not set")
    def test_the_rate_distortion_example_does_without_data(self):
        lines = self.rate_distortion("--bits", "8", "--frames", "3")
        self.assertIn("the project's own", lines[0])
        self.assertTrue(any(line.startswith("hand: ") for line in lines), lines)

    def test_info_prints_what_a_file_is(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.tvg")
            tvg.encode(wave(), grid(), path, fps=25)
            command = [sys.executable, "-m", "tvg", "info", path]
            output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            self.assertIn("30 frames of 144 vertices, 242 faces, 25 frames per second", output)
            result = subprocess.run(command[:-1] + [__file__], capture_output=True, text=True)
            self.assertEqual(result.returncode, 1)
            self.assertIn("not-tvg", result.stderr)


if __name__ == "__main__":
    unittest.main()
