"""Options of encode() together: what they mean for the encoder, and what only frames can tell."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _options as o
from . import _structures as s
from ._library import encoder_library
from ._mesh_input import GivenFrames, PlainFrames

Box = Tuple[npt.ArrayLike, npt.ArrayLike]


@dataclass
class Request:
    """What encode() was asked for, once it has been checked."""

    c: s.EncoderOptions
    max_error: Union[None, float, str]
    importance: Optional[o.Importance]
    period: Union[None, int, str]
    box: Optional[Box]

    def needs_box(self) -> bool:
        lossless = self.c.mode == 2
        return self.box is None and not lossless and (self.max_error is not None or self.c.step == 0)

    def complete(self, frames: Union[PlainFrames, GivenFrames], box: Optional[Box]) -> None:
        """Sets what only frames can tell, as `tvg encode` does with a source that it can read twice."""
        c = self.c
        lossless = c.mode == 2
        box = None if lossless else self.box if self.box is not None else box
        if box is not None:
            low, high = (np.asarray(corner, dtype=np.float64).tolist() for corner in box)
            if len(low) != 3 or len(high) != 3 or not all(a <= b for a, b in zip(low, high)):
                raise ValueError(
                    f"box={box!r}: write its lowest and its highest corner, ((x, y, z), (x, y, z))"
                )
            if self.box is not None or self.max_error is not None or c.step == 0:
                c.has_box, c.box_low[:], c.box_high[:] = 1, low, high
        if self.max_error is not None:
            diagonal = None if box is None else float(np.linalg.norm(np.subtract(high, low)))
            bound = o.error_bound(self.max_error, diagonal)
            if box is not None:
                bound = o.resolve_error(bound, low, high)
                c.step = 2 * bound
            c.max_error = bound
        if c.mode == 1:
            most = o.PERIODS.get(c.effort, 128) if self.period is None else self._period_frames()
            count = frames.frame_count
            c.period_frames = most if count is None else max(1, min(count, most))
        elif self.period is not None:
            raise ValueError("period needs mode='basis', whose planes the frames of a period share")
        # What lies on the surface of a single frame is predicted from its shape.
        if frames.frame_count == 1 and frames.mesh.attributes and c.mode == 0 and c.predictor == 2:
            c.predictor = 3

    def _period_frames(self) -> int:
        return 65536 if self.period == "all" else o.whole("period", self.period, 1, 65536)


def checked_options(
    bits: Optional[o.Pair],
    step: Optional[o.Steps],
    max_error: Union[None, float, str],
    lossless: bool,
    mode: str,
) -> "Tuple[s.EncoderOptions, Union[None, float, str]]":
    """Options with what there is to say of precision."""
    given = [
        name
        for name, value in (("bits", bits), ("step", step), ("max_error", max_error))
        if value is not None
    ]
    if len(given) > 1 or (lossless and given):
        names = " and ".join(given + (["lossless"] if lossless else []))
        raise ValueError(f"{names} exclude each other: each says how exact positions are")
    if mode not in ("elp", "basis"):
        raise ValueError(f"mode={mode!r}: write 'elp' or 'basis' (or lossless=True)")
    c = s.sized(s.EncoderOptions)
    encoder_library().tvg_encoder_options_init(ctypes.byref(c))
    c.mode = 2 if lossless else 1 if mode == "basis" else 0
    if bits is not None:
        c.fine_bits, c.coarse_bits = o.bits_pair(bits)
    if step is not None:
        c.step, shift = o.step_pair(step)
        c.fine_bits, c.coarse_bits = o.MOST_BITS, o.MOST_BITS - shift
    return c, max_error
