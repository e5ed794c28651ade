"""TVG: animated triangle meshes as small streams, from numpy and into numpy.

    tvg.encode(positions, faces, "clip.tvg", bits=11, fps=30)     # positions [frame, vertex, 3], faces [face, 3]
    for frame in tvg.open("clip.tvg"):
        frame.positions                                           # float32 [vertex, 3]
    positions, faces = tvg.decode("clip.tvg")

`encode`, `open`, `decode`, `compare` and `measure` are where to begin; all lengths are in the mesh's own units.
"""
from ._encoder import Report, join
from ._library import version
from ._options import Importance, criteria
from .clip import Clip, Frames, decode, open
from .encoding import encode
from .errors import Code, Damage, DamageWarning, Error, InputError
from .metrics import Comparison, Measure, compare, measure
from .model import EXACT, Attribute, Attributes, Frame, Gop, Mesh, Part

__version__ = "0.2.0"

__all__ = [
    "Attribute",
    "Attributes",
    "Clip",
    "Code",
    "Comparison",
    "Damage",
    "DamageWarning",
    "EXACT",
    "Error",
    "Frame",
    "Frames",
    "Gop",
    "Importance",
    "InputError",
    "Measure",
    "Mesh",
    "Part",
    "Report",
    "compare",
    "criteria",
    "decode",
    "encode",
    "join",
    "measure",
    "open",
    "version",
]
