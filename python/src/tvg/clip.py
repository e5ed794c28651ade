"""Streams as sequences of frames."""
from __future__ import annotations

import operator
from fractions import Fraction
from types import TracebackType
from typing import Any, Callable, Iterator, List, Mapping, Optional, Sequence, Tuple, Type, Union, overload

import numpy as np

from ._reader import Reader, Settings
from ._source import ByteSource, Source, open_source
from .errors import Code, Damage, Error
from .model import Attributes, Floats, Frame, Indices, Mesh, Part


class Frames(Sequence[Frame]):
    """Frames of a clip that are decoded when they are asked for: `clip[10:20]`."""

    def __init__(self, clip: "Clip", numbers: range) -> None:
        self._clip, self._numbers = clip, numbers

    def __len__(self) -> int:
        return len(self._numbers)

    def __iter__(self) -> Iterator[Frame]:
        return self.frames()

    @overload
    def __getitem__(self, index: int) -> Frame:
        ...

    @overload
    def __getitem__(self, index: slice) -> "Frames":
        ...

    def __getitem__(self, index: Union[int, slice]) -> "Union[Frame, Frames]":
        if isinstance(index, slice):
            return Frames(self._clip, self._numbers[index])
        try:
            return self._clip._frame(self._numbers[operator.index(index)])
        except IndexError:
            raise IndexError(f"frame {index} of {len(self)}") from None

    def frames(self, copy: bool = True) -> Iterator[Frame]:
        """The frames, one after the other. With copy=False `positions` are overwritten by the next frame."""
        numbers = self._numbers
        if numbers.step > 0:
            return self._clip._run(numbers, copy)
        return (self._clip._frame(number) for number in numbers)

    def positions(self, out: Optional[Floats] = None) -> Floats:
        """All positions at once.

        Args:
            out: where to write them: float32 [frame, vertex, 3], C-contiguous; made unless given.

        Returns:
            float32 [frame, vertex, 3], in the mesh's units; `out` where that was given.

        Raises:
            Error: a frame is lost (its number is in `frame`).
            ValueError: the number of vertices changes, or `out` has another shape.
        """
        vertices = self._clip.mesh.vertex_count
        shape = (len(self), vertices, 3)
        if out is None:
            try:
                out = np.empty(shape, np.float32)
            except MemoryError:
                size = 12 * len(self) * vertices
                raise Error(
                    Code.OUT_OF_MEMORY, f"all positions take {size} bytes: take frame after frame"
                ) from None
        elif out.shape != shape or out.dtype != np.float32 or not out.flags.c_contiguous:
            raise ValueError(
                f"out is {out.dtype} {out.shape}: it has to be C-contiguous float32 {shape}, [frame, vertex, 3]"
            )
        self._clip._fill(self._numbers, out)
        return out

    def __repr__(self) -> str:
        return (
            f"<tvg.Frames {self._numbers.start}:{self._numbers.stop}:{self._numbers.step} of {self._clip!r}>"
        )


class Clip(Sequence[Frame]):
    """A stream that is open; see `tvg.open`.

    Attributes:
        mesh: that of the first frames; `frame.mesh` is that of a frame, where it changes.
        metadata: texts by key ("fps", "name", "units", "up", ...), as far as they have been read.
        data: free-form bytes by name ("materials", "image/...", ...), as far as they have been read.
        seekable: whether frames can be asked for in any order, and more than once.

    A clip is for one thread at a time; different clips are independent, and the decoder runs without
    Python's lock.
    """

    def __init__(self, source: ByteSource, settings: Settings, name: str) -> None:
        self._source, self._settings, self._name = source, settings, name
        self._frame_count: Optional[int] = None
        self._closed = True
        # The reader that has read the head, what it is lent for, and that of single frames.
        self._reader = Reader(source, settings)
        self._idle: Optional[Reader] = self._reader
        self._single: Optional[Reader] = None
        self._closed = False
        try:
            self._reader.read_head()
        except BaseException:
            self.close()
            raise
        self.mesh: Mesh = self._reader.mesh or Mesh(np.zeros((0, 3), np.uint32), 0)
        self._frame_count = self._reader.frame_count

    def close(self) -> None:
        """Closes what was opened by a path, and gives memory back. Frames stay the caller's."""
        if not self._closed:
            self._closed = True
            for reader in (self._reader, self._idle, self._single):
                if reader is not None:
                    reader.close()
            self._source.close()

    def __enter__(self) -> "Clip":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        self.close()

    def __del__(self) -> None:
        if not getattr(self, "_closed", True):
            self.close()

    @property
    def seekable(self) -> bool:
        """Whether frames can be asked for in any order: not of a pipe or a socket."""
        return self._source.size is not None

    @property
    def metadata(self) -> Mapping[str, str]:
        """Texts by key; those of the last that came."""
        return self._reader.metadata

    @property
    def data(self) -> Mapping[str, bytes]:
        """Free-form bytes by name."""
        return self._reader.data

    @property
    def faces(self) -> Indices:
        """uint32 [face, 3], counter-clockwise; of the first mesh."""
        return self.mesh.faces

    @property
    def attributes(self) -> Attributes:
        """Of the first mesh, by name; the values of animated ones are in `frame.attributes`."""
        return self.mesh.attributes

    @property
    def parts(self) -> List[Part]:
        """Of the first mesh; [] where all faces are one part without a name."""
        return self.mesh.parts

    @property
    def fps(self) -> Optional[float]:
        """Frames per second, or None where the stream does not say."""
        try:
            rate = float(Fraction(self.metadata.get("fps", "")))
        except (ValueError, ZeroDivisionError, OverflowError):
            return None
        return rate if rate > 0 else None

    def __len__(self) -> int:
        if self._frame_count is None:
            self._check_seekable("how many frames there are is known at the end only")
            quiet = Settings(self._settings.limits, on_damage=lambda damage: None)
            reader = Reader(self._source, quiet)
            try:
                count = 0
                while reader.advance():
                    count = (reader.number or 0) + 1
            except Error:
                pass  # a stream that is cut has the frames before; who reads to its end is told
            finally:
                reader.close()
            self._frame_count = count
        if self._source.size is not None and self._frame_count > self._source.size:
            # list(clip) would make room for them all; after a TypeError it goes by what comes.
            raise TypeError(
                f"{self._name} says it has {self._frame_count} frames, more than bytes: go through them"
            )
        return self._frame_count

    def __iter__(self) -> Iterator[Frame]:
        return self.frames()

    @overload
    def __getitem__(self, index: int) -> Frame:
        ...

    @overload
    def __getitem__(self, index: slice) -> Frames:
        ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Frame, Frames]:
        self._check_seekable("frames come one after the other")
        if isinstance(index, slice):
            return Frames(self, range(len(self))[index])
        number = operator.index(index)
        if not -len(self) <= number < len(self):
            raise IndexError(f"frame {number} of {len(self)}: {self._name}")
        return self._frame(number % len(self))

    def frames(self, copy: bool = True) -> Iterator[Frame]:
        """The frames, one after the other; lost ones are left out, with a warning (or `on_damage`).

        Args:
            copy: whether each frame has positions of its own. With False they are overwritten by the next frame,
                which saves the memory and some of the time.

        Of a source that can be read anywhere, every call begins at the first frame; of others it goes on.
        """
        return self._run(None, copy)

    def positions(self, out: Optional[Floats] = None) -> Floats:
        """All positions at once, float32 [frame, vertex, 3]; see `Frames.positions`."""
        if self.seekable:
            return self[:].positions(out)
        frames = [frame.positions for frame in self]
        if len({len(frame) for frame in frames}) > 1:
            raise ValueError("the number of vertices changes: take frame after frame")
        stacked: Floats = np.stack(frames) if frames else np.zeros((0, self.mesh.vertex_count, 3), np.float32)
        if out is None:
            return stacked
        if out.shape != stacked.shape:
            raise ValueError(f"out has the shape {out.shape}: the frames have {stacked.shape}")
        out[...] = stacked
        return out

    def __repr__(self) -> str:
        count = "" if self._frame_count is None else f"{self._frame_count} frames of "
        return f"<tvg.Clip {self._name}: {count}{self.mesh.vertex_count} vertices>"

    def _borrow(self) -> Reader:
        """A reader that has read the head, for one run over frames; reading heads twice would take time."""
        if self._closed:
            raise ValueError("the clip is closed")
        reader, self._idle = self._idle, None
        if reader is None:
            reader = Reader(self._source, self._settings)
            reader.mesh = self.mesh
            reader.read_head()
        return reader

    def _give_back(self, reader: Reader) -> None:
        if self._idle is None and not self._closed:
            self._idle = reader
        else:
            reader.close()

    def _check_seekable(self, why: str) -> None:
        if self._closed:
            raise ValueError("the clip is closed")
        if not self.seekable:
            raise TypeError(f"{self._name} can be read only once: {why}")

    def _frame(self, number: int) -> Frame:
        """The frame of that number, decoded by the reader that all such calls share."""
        if self._closed:
            raise ValueError("the clip is closed")
        if self._single is None:
            self._single = self._borrow()
        self._single.go_to(number)
        return self._single.frame()

    def _run(self, numbers: Optional[range], copy: bool) -> Iterator[Frame]:
        """Frames in order, those of `numbers` or all; each run over a seekable source has its own reader."""
        reader = self._borrow()
        try:
            if self.seekable:
                reader.begin_at(0 if numbers is None else numbers.start)
            buffer: Optional[Floats] = None
            while reader.advance():
                number = reader.number
                assert number is not None
                if numbers is not None and number >= numbers.stop:
                    return
                if numbers is not None and number not in numbers:
                    continue
                frame = reader.frame(buffer)
                if not copy:
                    buffer = frame.positions
                yield frame
                if self._closed:
                    raise ValueError("the clip is closed")
        finally:
            self._give_back(reader)

    def _fill(self, numbers: range, out: Floats) -> None:
        """Writes the positions of frames into the rows of `out`."""
        backwards = numbers.step < 0
        rows = out[::-1] if backwards else out
        numbers = numbers[::-1] if backwards else numbers
        reader = self._borrow()
        try:
            if len(numbers):
                reader.begin_at(numbers.start)
            for row, number in zip(rows, numbers):
                reader.go_to(number)
                if reader.vertex_count() != out.shape[1]:
                    raise ValueError(
                        f"frame {number} has {reader.vertex_count()} vertices and the first mesh {out.shape[1]}: "
                        "where meshes change, take frame after frame"
                    )
                if out.shape[1]:
                    reader.copy_positions(row)
        finally:
            self._give_back(reader)


def open(
    source: Source,
    *,
    limits: Optional[Mapping[str, int]] = None,
    on_damage: Optional[Callable[[Damage], None]] = None,
    lod: int = 0,
    components: Optional[int] = None,
    normals: bool = False,
) -> Clip:
    """Opens a stream.

    Args:
        source: a path; the bytes of a stream; or a binary file object, which is read from where it stands. One
            that is not seekable (a pipe, a socket, `urllib.request.urlopen(url)`) is read once, front to back,
            and frames come as their bytes do.
        limits: what a stream may ask for, by the names of tvg_limits in tvg.h: "vertices", "faces",
            "memory_bytes", ...; one that declares more is refused (Code.LIMIT_EXCEEDED).
        on_damage: called with a `Damage` where the stream is broken; unless given, a `DamageWarning` is issued.
        lod: draw meshes as the coarser one of this number that they have; 0: the whole mesh.
        components: of mode basis, decode only so many planes, for coarser frames sooner.
        normals: give frames normals.

    Returns:
        a `Clip`: `for frame in clip`, `clip[10]`, `clip[10:20]`, `len(clip)`. It is a context manager.

    Raises:
        Error: it is no stream, is cut before its first mesh, or asks for more than the limits allow.
        OSError: the file cannot be opened or read.

    >>> stream = tvg.encode(np.zeros((3, 4, 3)), [[0, 1, 2], [0, 2, 3]], fps=25)
    >>> with tvg.open(stream) as clip:
    ...     print(len(clip), clip.fps, clip.faces.shape, clip[-1].positions.shape)
    3 25.0 (2, 3) (4, 3)
    """
    settings = Settings(dict(limits or {}), on_damage, lod, components, normals)
    bytes_of = open_source(source)
    name = repr(source) if isinstance(source, str) else getattr(source, "name", type(source).__name__)
    try:
        return Clip(bytes_of, settings, str(name))
    except BaseException:
        bytes_of.close()
        raise


def decode(source: Source, **options: Any) -> Tuple[Floats, Indices]:
    """All of a stream whose mesh does not change.

    Args:
        source: as `open` takes it, and its options.

    Returns:
        positions, float32 [frame, vertex, 3], in the mesh's units; and faces, uint32 [face, 3].

    >>> positions, faces = tvg.decode(tvg.encode(np.zeros((3, 4, 3)), [[0, 1, 2], [0, 2, 3]]))
    >>> positions.shape, faces.tolist()
    ((3, 4, 3), [[0, 1, 2], [0, 2, 3]])
    """
    with open(source, **options) as clip:
        return clip.positions(), clip.faces
