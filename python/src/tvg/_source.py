"""Where the bytes of a stream come from."""
from __future__ import annotations

import io
import os
import threading
from typing import Any, BinaryIO, Optional, Union

import numpy as np

#: What tvg.open() takes: a path, the stream itself, or a binary file object.
Source = Union[str, "os.PathLike[str]", bytes, bytearray, memoryview, BinaryIO]

PIECE = 1 << 17


class ByteSource:
    """Bytes from any place (`size` known), or from front to back only (`size` None)."""

    size: Optional[int] = None

    def read(self, offset: int, count: int) -> Any:
        """At most so many bytes from `offset` on, which goes on from the read before where size is None."""
        raise NotImplementedError

    def close(self) -> None:
        """Gives back what was opened here."""


class MemorySource(ByteSource):
    """A stream in memory."""

    def __init__(self, data: Union[bytes, bytearray, memoryview]) -> None:
        self._data = memoryview(data).cast("B")
        self.size = self._data.nbytes

    def read(self, offset: int, count: int) -> Any:
        return self._data[offset : offset + count]


class SeekableSource(ByteSource):
    """A file object that goes anywhere. Several readers may share it: each read says where."""

    def __init__(self, file: Any, owned: bool) -> None:
        self._file, self._owned, self._lock = file, owned, threading.Lock()
        self._start = 0 if owned else file.tell()
        self.size = file.seek(0, io.SEEK_END) - self._start

    def read(self, offset: int, count: int) -> Any:
        with self._lock:
            self._file.seek(self._start + offset)
            return self._file.read(count)

    def close(self) -> None:
        if self._owned:
            self._file.close()


class PipeSource(ByteSource):
    """A file object that is read once: a pipe, a socket, the answer of a server."""

    def __init__(self, file: Any, owned: bool) -> None:
        self._file, self._owned = file, owned
        # read() of a buffered pipe waits until all is there; frames would come late.
        self._read = getattr(file, "read1", file.read)

    def read(self, offset: int, count: int) -> Any:
        return self._read(count)

    def close(self) -> None:
        if self._owned:
            self._file.close()


def open_source(source: Source) -> ByteSource:
    """What stands behind a path, bytes or a file object. TypeError for anything else."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return MemorySource(source)
    if isinstance(source, (str, os.PathLike)):
        return _of_file(open(source, "rb", buffering=0), True)
    if hasattr(source, "read"):
        return _of_file(source, False)
    raise TypeError(f"{type(source).__name__}: a stream is a path, bytes, or a file object opened with 'rb'")


def _of_file(file: Any, owned: bool) -> ByteSource:
    if isinstance(file, io.TextIOBase):
        raise TypeError("the file is opened as text: open it with 'rb'")
    seekable = getattr(file, "seekable", None)
    if seekable is not None and seekable():
        return SeekableSource(file, owned)
    return PipeSource(file, owned)


def address_of(piece: Any) -> "tuple[int, int, Any]":
    """Where bytes lie in memory, how many they are, and what keeps them there."""
    array = np.frombuffer(piece, dtype=np.uint8)
    return array.ctypes.data, array.nbytes, array
