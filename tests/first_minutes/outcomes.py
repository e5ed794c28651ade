"""What has to be there after each section: something of one's own animation to look at."""
from __future__ import annotations

import ast
import re
import struct
import zlib
from pathlib import Path
from typing import Tuple


def own_animation(folder: Path) -> Tuple[int, int]:
    """Vertices and frames of hand.obj and hand.pc2."""
    with open(folder / "hand.pc2", "rb") as cache:
        _, _, vertices, _, _, frames = struct.unpack("<12siiffi", cache.read(32))
    return vertices, frames


def is_a_picture(path: Path) -> None:
    """A PNG that shows something: a blank one has few different bytes in its rows."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), f"{path.name} is no PNG"
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        if data[at + 4 : at + 8] == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += 12 + length
    rows = zlib.decompress(packed)
    assert width * height > 10000, f"{path.name} has {width} x {height} pixels"
    assert len(set(rows)) > 32, f"{path.name} is blank"


def shell(folder: Path, output: str) -> None:
    vertices, frames = own_animation(folder)
    assert f"{frames} frames of {vertices} vertices" in output
    is_a_picture(folder / "hand.png")


def python(folder: Path, output: str) -> None:
    with open(folder / "back.npy", "rb") as array:
        header = array.read(128)
    shape = ast.literal_eval(re.search(rb"'shape': (\([^)]*\))", header)[1].decode())
    assert shape == (120, 2500, 3), shape
    assert "(120, 2500, 3) (4802, 3)" in output
    is_a_picture(folder / "wave.png")


def blender(folder: Path, _output: str) -> None:
    is_a_picture(folder / "blender.png")
    assert (folder / "hand.blend").stat().st_size > 10000


def _heights(folder: Path, output: str, programs: int) -> None:
    vertices, frames = own_animation(folder)
    heights = re.findall(r"^y up to (\S+)$", output, re.MULTILINE)
    assert len(re.findall(rf"^{vertices} vertices, \d+ faces$", output, re.MULTILINE)) == programs
    assert len(heights) == programs * frames and len(set(heights)) > 1, heights


def c(folder: Path, output: str) -> None:
    _heights(folder, output, 1)


def cpp(folder: Path, output: str) -> None:
    _heights(folder, output, 2)
    lines = re.findall(r"^y up to \S+$", output, re.MULTILINE)
    assert lines[: len(lines) // 2] == lines[len(lines) // 2 :], "both ways of building give other frames"


def three(folder: Path, _output: str) -> None:
    is_a_picture(folder / "played.png")
