"""What goes wrong, as exceptions and warnings with their code and place."""
from __future__ import annotations

import enum
import re
from dataclasses import dataclass
from typing import Optional, Type, Union


class Code(enum.IntEnum):
    """What kind of error it is: tvg_code of tvg.h. Numbers are never reused."""

    INVALID_ARGUMENT = 10
    INVALID_INPUT = 11
    WRONG_STATE = 12
    NOT_TVG = 20
    UNSUPPORTED_VERSION = 21
    TRUNCATED = 22
    CHECKSUM_MISMATCH = 23
    MALFORMED = 24
    DIGEST_MISMATCH = 25
    UNSUPPORTED = 26
    LIMIT_EXCEEDED = 30
    OUT_OF_MEMORY = 31
    IO = 40


def code_of(number: int) -> Union[Code, int]:
    """The code of that number; the number where this package does not know it."""
    try:
        return Code(number)
    except ValueError:
        return number


class Error(Exception):
    """A stream cannot be read, or cannot be made.

    Attributes:
        code: a `Code`, or a number that this package does not know.
        message: one line that says what is wrong.
        byte_offset: where in the stream, in bytes from its beginning, or None.
        frame: which frame, or None.
    """

    def __init__(
        self, code: int, message: str, byte_offset: Optional[int] = None, frame: Optional[int] = None
    ) -> None:
        super().__init__(message)
        self.code = code_of(code)
        self.message = message
        self.byte_offset = byte_offset
        self.frame = frame


class InputError(Error, ValueError):
    """What was given to be encoded, measured or compared cannot be; a ValueError too."""


class DamageWarning(UserWarning):
    """Frames are lost or not to be trusted; decoding goes on. `damage` has the particulars."""

    def __init__(self, damage: "Damage") -> None:
        super().__init__(damage.text)
        self.damage = damage


@dataclass(frozen=True)
class Damage:
    """A place where a stream is broken.

    Attributes:
        code: a `Code`. With DIGEST_MISMATCH and MALFORMED, frames that were given out are not to be trusted.
        text: one line.
        first_frame: the first of the frames concerned.
        frame_count: how many; 0 where none is lost, or nobody can know how many.
        byte_offset: where in the stream, in bytes, or None.
    """

    code: Union[Code, int]
    text: str
    first_frame: int
    frame_count: int
    byte_offset: Optional[int]


_PLACE = re.compile(r" \[[a-z-]+(?:, byte (\d+))?(?:, frame (\d+))?(?:, spec [^\]]*)?\]$")


def error_of(code: int, text: str, kind: Type[Error] = Error) -> Error:
    """An exception from a code and what the library says, which ends with the place: "[malformed, byte 7]".

    >>> error = error_of(24, "a count is wrong [malformed, byte 7, frame 2, spec §5.1]")
    >>> error.code.name, error.byte_offset, error.frame
    ('MALFORMED', 7, 2)
    """
    place = _PLACE.search(text)
    byte, frame = place.groups() if place else (None, None)
    return kind(
        code,
        text or "there is no memory for it",
        None if byte is None else int(byte),
        None if frame is None else int(frame),
    )


def input_error(code: int, text: str) -> Error:
    """The same of what was asked for: an InputError where the arguments are at fault."""
    at_fault = code in (Code.INVALID_ARGUMENT, Code.INVALID_INPUT)
    return error_of(code, text, InputError if at_fault else Error)
