"""What the tests share: small animations, files that tools read, and the project's own streams."""
import os
import pathlib
import struct
import sys

import numpy as np

PROJECT = pathlib.Path(os.environ.get("TVG_PROJECT") or pathlib.Path(__file__).resolve().parents[2])
STREAMS = PROJECT / "corpus" / "conformance"

sys.path.append(str(PROJECT / "format-spec" / "reference"))


def grid(side=12):
    """The faces of a square of side * side vertices, [face, 3]."""
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    one = np.stack([corner, corner + 1, corner + side], axis=1)
    other = np.stack([corner + 1, corner + side + 1, corner + side], axis=1)
    return np.concatenate([one, other])


def as_set(faces):
    """Faces whatever their order and whichever corner is first: streams keep neither, but vertices' numbers."""
    turned = (np.roll(face, -int(np.argmin(face))).tolist() for face in faces)
    return sorted(turned)


def wave(frames=30, side=12):
    """A square with a wave running over it, float64 [frame, vertex, 3]."""
    y, x = np.mgrid[0:side, 0:side].reshape(2, -1) / (side - 1)
    time = np.arange(frames)[:, None] / 10
    return np.stack([x + 0 * time, y + 0 * time, 0.2 * np.sin(6 * x + time)], axis=2)


def write_obj(path, positions, faces):
    """An OBJ file of one frame."""
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v %.9g %.9g %.9g\n" % tuple(vertex) for vertex in positions.tolist())
        file.writelines("f %d %d %d\n" % tuple(face) for face in (np.asarray(faces) + 1).tolist())


def write_pc2(path, positions):
    """A PC2 cache of all frames."""
    frames, vertices = positions.shape[:2]
    with open(path, "wb") as file:
        file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, vertices, 0, 1, frames))
        file.write(np.ascontiguousarray(positions, "<f4").tobytes())


def listed(*names):
    """The lines of a list of streams that are no comment, by their first word."""
    text = STREAMS.joinpath(*names).read_text("utf-8").splitlines()
    return dict(line.split(" ", 1) for line in text if line and not line.startswith("#"))


class Pipe:
    """A file object that cannot seek, and gives little at a time."""

    def __init__(self, data, most=1000):
        self._data, self._at, self._most = data, 0, most

    def read(self, count):
        piece = self._data[self._at : self._at + min(count, self._most)]
        self._at += len(piece)
        return piece
