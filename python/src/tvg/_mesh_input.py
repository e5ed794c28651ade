"""Meshes and frames as callers give them, on their way into an encoder."""
from __future__ import annotations

import itertools
from typing import Any, Dict, Iterable, Iterator, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arrays import as_faces, as_frame, check_faces
from .model import Attribute, Attributes, Floats, Frame, Indices, Mesh, Part, as_values

AttributeLike = Union[Attribute, npt.ArrayLike]

#: A frame for the encoder: positions, the mesh, and values of the animated attributes by their key.
Item = Tuple[Floats, Mesh, Dict[str, Floats]]


def kind_of(name: str, components: int) -> str:
    """What an attribute is by its name.

    >>> kind_of("uv", 2), kind_of("Normals", 3), kind_of("color_0", 4), kind_of("heat", 1)
    ('texcoord', 'normal', 'colour', 'generic')
    """
    low = name.lower()
    if low.startswith(("uv", "texcoord", "st")) and components == 2:
        return "texcoord"
    if low.startswith("normal") and components == 3:
        return "normal"
    if low.startswith(("color", "colour", "rgb")) and components in (3, 4):
        return "colour"
    return "generic"


def attribute_of(name: str, given: Any, vertices: int, faces: int, frames: Optional[int]) -> Attribute:
    """An attribute under a name from an `Attribute`, or from an array whose shape says what it is of."""
    if isinstance(given, Attribute):
        return Attribute(
            given.given,
            given.kind,
            given.domain,
            given.corners,
            given.bits,
            given.animated,
            given.name or ("" if name == given.kind else name),
            given.components,
        )
    try:
        array = np.asarray(given, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise ValueError(f"attributes[{name!r}] is no array of numbers: {error}") from None
    shape = array.shape
    if array.ndim in (1, 2) and len(array) == vertices:
        values = as_values(array, f"attributes[{name!r}]")
        return Attribute(values, kind_of(name, values.shape[1]), name=name)
    of_corners = array.ndim == 3 and shape[:2] == (faces, 3)
    of_frames = array.ndim == 3 and shape[:2] == (frames, vertices)
    if of_corners == of_frames:
        why = "is ambiguous" if of_corners else f"of shape {shape} fits nothing"
        raise ValueError(
            f"attributes[{name!r}] {why}: with {vertices} vertices and {faces} faces it is [{vertices}, N], or "
            f"[{faces}, 3, N] for each corner of the faces, or [frame, {vertices}, N] where it is animated; "
            "tvg.Attribute(values, ...) says all there is to say"
        )
    kind = kind_of(name, shape[2])
    if of_frames:
        return Attribute(array, kind, animated=True, name=name, components=shape[2])
    values, corners = np.unique(array.reshape(-1, shape[2]), axis=0, return_inverse=True)
    return Attribute(values, kind, "corner", np.asarray(corners).reshape(-1, 3), name=name)


class PlainFrames:
    """Frames of one mesh, given as arrays: [frame, vertex, 3] or any iterable of [vertex, 3]."""

    def __init__(
        self,
        positions: Iterable[Any],
        faces: Any,
        attributes: Optional[Mapping[str, AttributeLike]],
        parts: Optional[Sequence[Part]],
        face_parts: Optional[npt.ArrayLike],
        polygons: Optional[npt.ArrayLike],
    ) -> None:
        self._frames: Iterable[Any] = positions
        self.frame_count: Optional[int] = (
            len(positions) if isinstance(positions, (list, np.ndarray)) else None
        )
        iterator = iter(positions)
        first = next(iterator, None)
        if first is None:
            raise ValueError("there is no frame: positions are [frame, vertex, 3], with one frame at least")
        if iterator is positions:
            self._frames = itertools.chain([first], iterator)
        vertices = len(as_frame(first, 0, None))
        triangles, made = as_faces(faces)
        check_faces(triangles, vertices)
        self.mesh = Mesh(triangles, vertices, parts=list(parts or ()))
        self.mesh.polygons = made if polygons is None else _pairs(polygons)
        if face_parts is not None:
            self.mesh.face_parts = _parts_of_faces(face_parts, len(triangles), made)
        if self.mesh.parts and self.mesh.face_parts is None:
            raise ValueError("parts need face_parts=: the number of the part of each face, [face]")
        self.mesh.attributes = Attributes(
            [
                attribute_of(name, given, vertices, len(triangles), self.frame_count)
                for name, given in (attributes or {}).items()
            ]
        )

    def plain(self) -> Iterable[Any]:
        """The frames alone, to be looked through."""
        return self._frames

    def __iter__(self) -> Iterator[Item]:
        animated = {
            key: iter(attribute.given)
            for key, attribute in self.mesh.attributes.items()
            if attribute.animated
        }
        for number, positions in enumerate(self._frames):
            frame = as_frame(positions, number, self.mesh.vertex_count)
            values: Dict[str, Floats] = {}
            for key, rows in animated.items():
                row = next(rows, None)
                if row is None:
                    raise ValueError(
                        f"attribute {key!r} has values of {number} frames, and there are more frames"
                    )
                values[key] = as_values(row, f"attribute {key!r} of frame {number}")
            yield frame, self.mesh, values


class GivenFrames:
    """Frames that bring their mesh: those of a clip, or `Frame`s made by hand."""

    def __init__(self, frames: Iterable[Frame], first: Frame) -> None:
        self._frames, self.mesh = frames, first.mesh
        self.frame_count = len(frames) if isinstance(frames, list) else None

    def plain(self) -> Iterable[Any]:
        """The positions alone."""
        return (frame.positions for frame in self._frames)

    def __iter__(self) -> Iterator[Item]:
        for number, frame in enumerate(self._frames):
            if not isinstance(frame, Frame):
                raise ValueError(f"frame {number} is a {type(frame).__name__}, and the first is a tvg.Frame")
            mesh = frame.mesh
            positions = as_frame(frame.positions, number, mesh.vertex_count)
            if mesh.faces.ndim != 2 or mesh.faces.shape[1] != 3 or mesh.faces.dtype.kind not in "iu":
                raise ValueError(f"frame {number}: the faces of a tvg.Mesh are uint32 [face, 3]")
            check_faces(mesh.faces, mesh.vertex_count)
            values = {}
            for key, attribute in mesh.attributes.items():
                if attribute.animated:
                    values[key] = frame.attributes[key].values
            yield positions, mesh, values


def _pairs(polygons: npt.ArrayLike) -> Indices:
    array = np.ascontiguousarray(polygons, dtype=np.uint32)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(
            f"polygons have the shape {array.shape}: they are [polygon, 2], first face and corners"
        )
    return array


def _parts_of_faces(face_parts: npt.ArrayLike, triangles: int, made: Optional[Indices]) -> Indices:
    array = np.ascontiguousarray(face_parts, dtype=np.uint32)
    if made is not None and array.shape == (len(made),):
        array = np.repeat(array, made[:, 1] - 2)  # one for each face as it was given
    if array.shape != (triangles,):
        raise ValueError(
            f"face_parts have the shape {array.shape}: there is one for each of {triangles} faces"
        )
    return array
