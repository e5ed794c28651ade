"""Options of the encoder as callers write them."""
from __future__ import annotations

import ctypes
import math
import os
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._library import encoder_library

MOST_BITS = 24
PREDICTOR_NUMBERS = {"space": 0, "time": 1, "elp": 2, "pyramid": 3, "auto": 255}
# Frames that share a basis, by the effort; 128 of those that are not named.
PERIODS = {1: 64, 2: 64, 8: 256, 9: 512}

Pair = Union[int, str, Tuple[int, int]]
Steps = Union[float, str, Tuple[float, float]]


@dataclass
class Importance:
    """What makes vertices important: those that get the finer lattice where there are two.

    Attributes:
        criteria: how the cost of a vertex is summed up, "curv" or "curv+0.5*velocity"; `criteria()` lists them.
        share: of the vertices, those of the highest cost: 0 to 1.
        threshold: instead, all whose cost is above it.
        smooth: how often the cost is averaged over neighbours; marks in one piece cost fewer bytes.
        alpha: of curv and curvature-norm: weight of the change against the mean, 0 to 1.
        viewpoint: of distance: x, y, z in the mesh's units.
        weights: values of the criterion "weights", one for each vertex, float64 [vertex]; alone they are the cost.
        low_delay: mark a GOP by the frames of the GOP before it, so that nothing waits for frames to come.
    """

    criteria: str = ""
    share: float = 0.35
    threshold: Optional[float] = None
    smooth: int = 0
    alpha: float = 0.5
    viewpoint: Sequence[float] = (0.0, 0.0, 0.0)
    weights: "Optional[npt.ArrayLike]" = None
    low_delay: bool = False


ImportanceLike = Union[None, str, float, Importance, Sequence[float], "npt.NDArray[Any]"]


def as_importance(given: ImportanceLike) -> Optional[Importance]:
    """An Importance from its short forms: a share, criteria, or a weight for each vertex."""
    if given is None or isinstance(given, Importance):
        return given
    if isinstance(given, str):
        return Importance(criteria=given)
    if isinstance(given, (float, int)):
        return Importance(share=float(given))
    return Importance(weights=given)


def criteria_of(text: str) -> List[Tuple[str, float]]:
    """The terms of a cost.

    >>> criteria_of("curv+0.5*velocity-distance")
    [('curv', 1.0), ('velocity', 0.5), ('distance', -1.0)]
    """
    names = sorted(criteria(), key=len, reverse=True)
    terms: List[Tuple[str, float]] = []
    rest = "".join(text.split())
    while rest or not terms:
        sign = -1.0 if rest.startswith("-") else 1.0
        signed = rest[:1] in ("+", "-") and rest != ""
        if terms and not signed:
            raise _no_criteria(text, names)
        rest = rest[1:] if signed else rest
        factor, star, after = rest.partition("*")
        weight = 1.0
        if star and not any(name in factor for name in names):
            try:
                weight, rest = float(factor), after
            except ValueError:
                raise _no_criteria(text, names) from None
        name = next((name for name in names if rest.startswith(name)), None)
        if name is None or not weight >= 0:
            raise _no_criteria(text, names)
        terms.append((name, sign * weight))
        rest = rest[len(name) :]
    return terms


def _no_criteria(text: str, names: Sequence[str]) -> ValueError:
    there = ", ".join(sorted(names))
    return ValueError(
        f"importance {text!r}: write criteria with weights as 'curv+0.5*velocity'; there are {there}"
    )


def criteria() -> "dict[str, str]":
    """The criteria of the measure by name, with a line on each.

    >>> "curv" in tvg.criteria()
    True
    """
    lib = encoder_library()
    found: "dict[str, str]" = {}
    while True:
        name = lib.tvg_criterion_name(len(found))
        if name is None:
            return found
        found[name.decode()] = lib.tvg_criterion_description(len(found)).decode()


def importance_struct(importance: Importance) -> "tuple[s.Importance, Any]":
    """The structure of the C interface, and what has to stay while it is used."""
    lib = encoder_library()
    given = s.sized(s.Importance)
    lib.tvg_importance_init(ctypes.byref(given))
    weights = None
    if importance.weights is not None:
        weights = np.ascontiguousarray(importance.weights, dtype=np.float64)
        if weights.ndim != 1:
            raise ValueError(
                f"importance: weights have the shape {weights.shape}: one for each vertex, [vertex]"
            )
        given.weights, given.weight_count = weights.ctypes.data, len(weights)
    text = importance.criteria or ("curv" if weights is None else "weights")
    terms = criteria_of(text)
    array = (s.Criterion * len(terms))(*[s.Criterion(name.encode(), weight) for name, weight in terms])
    given.criteria, given.criterion_count = array, len(terms)
    if not 0 <= importance.share <= 1:
        raise ValueError(
            f"importance: share is {importance.share}: write a number from 0 to 1 (0.35 is 35 %)"
        )
    given.share = importance.share
    if importance.threshold is not None:
        given.has_threshold, given.threshold = 1, importance.threshold
    given.smoothing = _whole("importance: smooth", importance.smooth, 0, 1000)
    given.curvature_alpha = importance.alpha
    given.viewpoint = (ctypes.c_double * 3)(*importance.viewpoint)
    given.low_delay = bool(importance.low_delay)
    return given, (weights, array)


def bits_pair(bits: Pair) -> Tuple[int, int]:
    """Bits of important vertices and of the others.

    >>> bits_pair("13:11"), bits_pair(11), bits_pair((13, 11))
    ((13, 11), (11, 11), (13, 11))
    """
    try:
        parts: Sequence[Any] = bits.split(":") if isinstance(bits, str) else _pair(bits)
        numbers = [int(part) for part in parts]
        if any(str(number) != str(part).strip() for number, part in zip(numbers, parts)):
            numbers = []
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) == 1:
        numbers *= 2
    if len(numbers) != 2 or not 1 <= numbers[1] <= numbers[0] <= MOST_BITS:
        raise ValueError(
            f"bits={bits!r}: write the bits of all coordinates (11), or of important vertices and of the others "
            f"('13:11', the first at least the second), 1 to {MOST_BITS}"
        )
    return numbers[0], numbers[1]


def step_pair(step: Steps) -> Tuple[float, int]:
    """The step of important vertices, and by how many powers of two that of the others is larger.

    >>> step_pair("0.01:0.04"), step_pair(0.5)
    ((0.01, 2), (0.5, 0))
    """
    try:
        parts: Sequence[Any] = step.split(":") if isinstance(step, str) else _pair(step)
        fine, *more = [float(part) for part in parts]
        coarse = more[0] if more else fine
        shift = round(math.log2(coarse / fine))
        right = len(more) <= 1 and math.isfinite(fine) and abs(fine * 2.0**shift - coarse) <= 1e-9 * coarse
        if right and 0 <= shift < MOST_BITS and fine > 0:
            return fine, shift
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        pass
    raise ValueError(
        f"step={step!r}: write the edge of a lattice cell in the mesh's units (0.01), or those of important "
        "vertices and of the others, a power of two apart ('0.01:0.04')"
    )


def _pair(given: Any) -> Sequence[Any]:
    return tuple(given) if isinstance(given, (tuple, list)) else (given,)


def error_bound(max_error: Union[float, str], diagonal: Optional[float]) -> float:
    """A length in the mesh's units; "0.05%" is a share of the diagonal."""
    text = str(max_error).strip()
    try:
        value = float(text.rstrip("%"))
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise ValueError(
            f"max_error={max_error!r}: write what no coordinate may be off by more, in the mesh's units (0.01) or as "
            "a share of the diagonal of all frames' box ('0.05%')"
        )
    if not text.endswith("%"):
        return value
    if diagonal is None:
        raise ValueError(
            f"max_error={max_error!r}: the diagonal is known only of positions that can be gone through twice (an "
            "array, a list), or with box=: write a length in the mesh's units"
        )
    return value / 100 * diagonal


def resolve_error(bound: float, low: Sequence[float], high: Sequence[float]) -> float:
    """What is left of the bound for the lattice once positions are rounded to float32, as tvg encode has it."""
    largest = max(0.0, *[abs(float(value)) for value in (*low, *high)])
    rounding = (largest + bound) * 2.0**-24
    if bound <= 2 * rounding:
        raise ValueError(
            f"max_error={bound:g} is below what float32 has at coordinates of this size, {2 * rounding:.3g}"
        )
    return bound - rounding


def frame_rate(fps: Union[int, float, str, Fraction]) -> str:
    """A frame rate as streams have it.

    >>> frame_rate(30), frame_rate(29.97), frame_rate(Fraction(30000, 1001))
    ('30', '29.97', '30000/1001')
    """
    try:
        value = float(Fraction(str(fps)))
    except (ValueError, ZeroDivisionError, OverflowError):
        value = math.nan
    if not 0.01 <= value <= 1000:
        raise ValueError(
            f"fps={fps!r}: write frames per second as 30, 29.97 or '30000/1001', from 0.01 to 1000"
        )
    text = str(fps).strip()
    return text[:-2] if text.endswith(".0") else text


def thread_count(threads: Optional[int]) -> int:
    """As many as there are processors unless given."""
    if threads is None:
        return min(os.cpu_count() or 1, 256)
    return _whole("threads", threads, 1, 256)


def _whole(name: str, value: Any, least: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise ValueError(f"{name}={value!r}: write a whole number from {least} to {most}")
    return int(value)


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in a range; ValueError for anything else."""
    return _whole(name, value, least, most)


def texts(metadata: Optional[Mapping[str, Any]]) -> "dict[str, str]":
    """Metadata as texts."""
    found = {}
    for key, value in (metadata or {}).items():
        if not isinstance(key, str) or not key or "\0" in key + str(value):
            raise ValueError(f"metadata[{key!r}]: keys are texts that are not empty, without zeros")
        found[key] = str(value)
    return found
