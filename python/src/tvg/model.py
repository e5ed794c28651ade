"""What a stream is made of: meshes, what they have beside their faces, frames, and groups of frames."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]
Indices = npt.NDArray[np.uint32]

#: As a number of bits of an attribute: float32, of which every bit comes back.
EXACT = 32

KINDS = ("texcoord", "normal", "colour", "generic")
DOMAINS = ("vertex", "corner", "part")
MODES = ("elp", "basis", "lossless")
PREDICTORS = {0: "space", 1: "time", 2: "elp", 3: "pyramid", 4: "rows", 255: "auto"}


class Attribute:
    """Values that a mesh has beside positions: texture coordinates, normals, colours, or numbers by name.

    Attributes:
        name: as the stream has it; may be "".
        kind: "texcoord" (v points up), "normal" (of length 1), "colour" (red, green, blue, alpha) or "generic".
        domain: what has a value each: "vertex", "corner" of a face, or "part".
        corners: of domain "corner", uint32 [face, 3]: which value each corner has; else None.
        bits: of each component, or `EXACT`; None: what is usual for the kind (to be encoded).
        animated: whether each frame has values of its own; they are in `frame.attributes` then.

    To encode, values may be an array [value, component] (or [value] of one component); animated, they are
    [frame, value, component], or any iterable of arrays [value, component].

    >>> uv = tvg.Attribute(np.zeros((4, 2)), kind="texcoord")
    >>> uv.values.shape, uv.components
    ((4, 2), 2)
    """

    def __init__(
        self,
        values: Any,
        kind: str = "generic",
        domain: str = "vertex",
        corners: Optional[npt.ArrayLike] = None,
        bits: Optional[int] = None,
        animated: bool = False,
        name: str = "",
        components: Optional[int] = None,
    ) -> None:
        if kind not in KINDS:
            raise ValueError(f"kind={kind!r}: write one of {', '.join(KINDS)}")
        if domain not in DOMAINS:
            raise ValueError(f"domain={domain!r}: write one of {', '.join(DOMAINS)}")
        if domain != "corner" and corners is not None:
            raise ValueError("corners are of domain 'corner' only: which value each corner of a face has")
        self.name, self.kind, self.domain, self.bits, self.animated = name, kind, domain, bits, animated
        self.corners: Optional[Indices] = None if corners is None else np.asarray(corners, dtype=np.uint32)
        self.given: Any = values
        if values is not None and not animated:
            self.given = as_values(values, f"attribute {name or kind!r}")
            components = self.given.shape[1]
        self._components = components

    @property
    def values(self) -> Floats:
        """float32 [value, component]. Those of an animated attribute are in `frame.attributes`."""
        if self.animated:
            raise ValueError(
                f"attribute {self.name or self.kind!r} is animated: its values are frame.attributes' of each frame"
            )
        values: Floats = self.given
        return values

    @property
    def components(self) -> int:
        """Numbers of a value, 1 to 4."""
        return 0 if self._components is None else self._components

    def at_corners(self) -> Floats:
        """The value of each corner, float32 [face, 3, component]; of domain "corner"."""
        if self.corners is None:
            raise ValueError(f"attribute {self.name or self.kind!r} is of each {self.domain}, not of corners")
        return self.values[self.corners]

    def __repr__(self) -> str:
        shape = "animated" if self.animated else "x".join(map(str, self.values.shape))
        return f"<tvg.Attribute {self.name!r}: {self.kind} of each {self.domain}, {shape}>"


def as_values(values: Any, what: str) -> Floats:
    """Values as float32 [value, component]; ValueError with what is wrong."""
    try:
        array = np.ascontiguousarray(values, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{what}: values are numbers [value, component]: {error}") from None
    if array.ndim == 1:
        array = array[:, np.newaxis]
    if array.ndim != 2 or not 1 <= array.shape[1] <= 4:
        raise ValueError(
            f"{what} has the shape {np.shape(values)}: values are [value, component] with one to four components"
        )
    return array


class Attributes(Mapping[str, Attribute]):
    """The attributes of a mesh or a frame by name, in the order of the stream.

    The key of one without a name is its kind; of two with one name, the second has ".1" behind it.
    """

    def __init__(self, attributes: Sequence[Attribute] = ()) -> None:
        self._by_key: Dict[str, Attribute] = {}
        for attribute in attributes:
            base = key = attribute.name or attribute.kind
            number = 0
            while key in self._by_key:
                number += 1
                key = f"{base}.{number}"
            self._by_key[key] = attribute

    def __getitem__(self, key: str) -> Attribute:
        try:
            return self._by_key[key]
        except KeyError:
            there = ", ".join(map(repr, self._by_key)) or "none"
            raise KeyError(f"{key}: the attributes are {there}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_key)

    def __len__(self) -> int:
        return len(self._by_key)

    def __repr__(self) -> str:
        return f"<tvg.Attributes {', '.join(map(repr, self._by_key.values()))}>"

    def of_kind(self, kind: str) -> List[Attribute]:
        """Those of a kind: "texcoord", "normal", "colour" or "generic"."""
        return [attribute for attribute in self.values() if attribute.kind == kind]


@dataclass(frozen=True)
class Part:
    """Faces that belong together; texts are "" where there are none."""

    object: str = ""
    group: str = ""
    material: str = ""


@dataclass(eq=False)
class Mesh:
    """What frames share that follow one another.

    Attributes:
        faces: uint32 [face, 3], counter-clockwise, every number below `vertex_count`.
        vertex_count: how many vertices a frame has.
        attributes: by name; see `Attribute`.
        parts: in order; [] where all faces are one part without a name.
        face_parts: uint32 [face]: the part of each face.
        polygons: uint32 [polygon, 2]: the first face and the number of corners of each face that had more than
            three corners; faces first to first + corners - 3 are a fan around its first corner.
        lods: how many coarser meshes the stream has of it (`open(..., lod=K)`).
    """

    faces: Indices
    vertex_count: int
    attributes: Attributes = field(default_factory=Attributes)
    parts: List[Part] = field(default_factory=list)
    face_parts: Optional[Indices] = None
    polygons: Optional[Indices] = None
    lods: int = 0

    def __repr__(self) -> str:
        more = f", {', '.join(self.attributes)}" if self.attributes else ""
        return f"<tvg.Mesh: {self.vertex_count} vertices, {len(self.faces)} faces{more}>"

    def property_bytes(self) -> int:
        """What parts, polygons and attributes count for against the bound that a stream declares.

        Of frames that are gone through once, the most of any mesh is `limits={"property_bytes": ...}` of `encode`.
        """
        total = 16 * (0 if self.polygons is None else len(self.polygons))
        for part in self.parts:
            total += 192 + sum(len(text.encode()) for text in (part.object, part.group, part.material))
        if self.parts:
            total += 4 * len(self.faces)
        values = {"vertex": self.vertex_count, "part": len(self.parts)}
        for attribute in self.attributes.values():
            size = 256 + len(attribute.name.encode())
            if attribute.domain == "corner":
                size += 12 * len(self.faces) * (1 + attribute.components)
            else:
                size += 4 * attribute.components * values[attribute.domain]
            total += 5 * size + 2**15 + 48 * len(self.faces) if attribute.animated else size
        return total

    def polygon_faces(self) -> "List[npt.NDArray[np.uint32]]":
        """The faces as they were before they became triangles: vertex numbers of each, in order."""
        starts: Dict[int, int] = {}
        if self.polygons is not None:
            starts = {int(first): int(corners) for first, corners in self.polygons}
        faces, at = [], 0
        while at < len(self.faces):
            corners = starts.get(at, 3)
            fan = self.faces[at : at + corners - 2]
            faces.append(np.concatenate([self.faces[at, :2], fan[:, 2]]))
            at += corners - 2
        return faces


@dataclass(frozen=True, eq=False)
class Gop:
    """A group of frames that can be decoded on its own.

    Attributes:
        first_frame: position of its first frame in the stream; source_frame: its number in what was encoded.
        frame_count: how many frames it has.
        mode: "elp", "basis" or "lossless".
        fine_step, coarse_step: edges of a lattice cell for important and other vertices, in the mesh's units: in
            mode elp no coordinate is off by more than half of it. 0 without loss; of a basis they bound nothing.
        components: planes of the basis; 0 in other modes.
        important: bool [vertex]: those on the fine lattice. Shared by the frames of the GOP.
    """

    first_frame: int
    source_frame: int
    frame_count: int
    mode: str
    fine_step: float
    coarse_step: float
    components: int
    important: "npt.NDArray[np.bool_]"


@dataclass(eq=False)
class Frame:
    """A frame.

    Attributes:
        positions: float32 [vertex, 3], in the mesh's units. The caller's own, unless frames were asked for with
            copy=False: then valid until the next frame.
        mesh: what it shares with its neighbours: `frame.faces` is short for `frame.mesh.faces`.
        number: position in the stream, from 0; lost frames count.
        attributes: those of the mesh, with the values of this frame where they are animated.
        normals: float32 [vertex, 3], of length 1, weighted by area; 0 for a vertex without a face. None unless
            asked for: `open(..., normals=True)`.
        gop: the group of frames it is in; None of a frame that was not decoded.
        packet_bytes: what it takes in the stream.
        predictor: what it was predicted from: "space", "time", "elp", "pyramid" or "rows".

    To encode frames whose mesh changes, make them yourself: Frame(positions, mesh).
    """

    positions: Floats
    mesh: Mesh
    number: int = 0
    attributes: Attributes = field(default_factory=Attributes)
    normals: Optional[Floats] = None
    gop: Optional[Gop] = None
    packet_bytes: int = 0
    predictor: str = ""

    @property
    def faces(self) -> Indices:
        """uint32 [face, 3]; of the mesh."""
        return self.mesh.faces

    def __repr__(self) -> str:
        return f"<tvg.Frame {self.number}: {len(self.positions)} vertices>"


def same_mesh(one: Mesh, other: Mesh) -> bool:
    """Whether all of two meshes is the same."""
    return (
        one.vertex_count == other.vertex_count
        and one.lods == other.lods
        and one.parts == other.parts
        and _same(one.faces, other.faces)
        and _same(one.face_parts, other.face_parts)
        and _same(one.polygons, other.polygons)
        and list(one.attributes) == list(other.attributes)
        and all(_same_attribute(one.attributes[key], other.attributes[key]) for key in one.attributes)
    )


def _same_attribute(one: Attribute, other: Attribute) -> bool:
    facts: List[Tuple[Any, ...]] = [
        (a.name, a.kind, a.domain, a.bits, a.animated, a.components) for a in (one, other)
    ]
    return (
        facts[0] == facts[1]
        and _same(one.corners, other.corners)
        and (one.animated or _same(one.values, other.values))
    )


def _same(one: Union[None, npt.NDArray[Any]], other: Union[None, npt.NDArray[Any]]) -> bool:
    if one is None or other is None:
        return one is other
    return one.shape == other.shape and one.tobytes() == other.tobytes()
