"""Plays streams just in time: at each frame of the scene the positions of imported meshes are decoded.

An imported object has two properties of its own, kept in .blend files: `tvg_file` (its stream; "//" is the folder of the
.blend) and `tvg_start` (the frame of the scene that shows the first frame). Objects that show the same stream from the same
frame on share a clip and the frame that is held; others have clips of their own, so that each goes forwards.
"""
import zlib

import bpy
import numpy as np
import tvg
from bpy.app.handlers import persistent

FILE = "tvg_file"
START = "tvg_start"
_MOST_DAMAGES = 5  # that are told of each stream


class _Stream:
    """An open stream and the frame of it that was decoded last."""

    def __init__(self, path):
        self.clip = tvg.open(path, on_damage=lambda damage: _note_damage(path, damage))
        self._number = self._frame = None

    def frame(self, number):
        """A frame; those beyond either end are the first and the last."""
        number = min(max(0, number), len(self.clip) - 1)
        if number != self._number:
            self._number = None
            self._frame = self.clip[number]
            self._number = number
        return self._frame


_streams = {}  # by absolute path and the frame of the scene that they start at
_errors = {}  # by absolute path: why the frame at hand is not shown
_damages = {}  # by absolute path: where the stream is broken


def _note_damage(path, damage):
    texts = _damages.setdefault(path, [])
    if damage.text not in texts and len(texts) < _MOST_DAMAGES:
        texts.append(damage.text)
        print(f"TVG: {path}: {damage.text}")


def path_of(item):
    """The absolute path of an imported object's stream."""
    return bpy.path.abspath(item[FILE])


def open_stream(path, start):
    """The stream of a path, for objects that show its first frame at the scene's frame `start`."""
    key = (path, int(start))
    if key not in _streams:
        _streams[key] = _Stream(path)
    return _streams[key]


def troubles(item):
    """What the user should know of an imported object's stream: an error or None, and where the stream is broken."""
    path = path_of(item)
    return _errors.get(path), list(_damages.get(path, ()))


def close_all():
    """Closes every stream; they are opened again where they are needed."""
    _close_but(())
    _errors.clear()
    _damages.clear()


def _close_but(keys):
    for key in [key for key in _streams if key not in keys]:
        _streams.pop(key).clip.close()


def fill_mesh(mesh, frame):
    """Makes `mesh` that of a frame: polygons, parts' materials, attributes."""
    polygons = [polygon.tolist() for polygon in frame.mesh.polygon_faces()]
    mesh.clear_geometry()
    mesh.from_pydata(frame.positions.tolist(), [], polygons)
    _fill_attributes(mesh, frame)
    _fill_materials(mesh, frame.mesh)
    mesh.validate()
    mesh.update()


def _corner_places(frame):
    """Of each loop of Blender's polygons: its face and corner among the triangles that the stream has."""
    sizes = dict(np.asarray(frame.mesh.polygons if frame.mesh.polygons is not None else []).reshape(-1, 2).tolist())
    faces, corners, at = [], [], 0
    while at < len(frame.faces):
        count = sizes.get(at, 3)
        faces += [at, at] + list(range(at, at + count - 2))
        corners += [0, 1] + [2] * (count - 2)
        at += count - 2
    return np.array(faces, dtype=np.int64), np.array(corners, dtype=np.int64)


def _fill_attributes(mesh, frame):
    faces, corners = _corner_places(frame)
    vertices = frame.faces[faces, corners]
    for key, attribute in frame.attributes.items():
        if attribute.domain == "part" or attribute.kind not in ("texcoord", "colour"):
            continue
        index = attribute.corners[faces, corners] if attribute.domain == "corner" else vertices
        values = attribute.values[index]
        if attribute.kind == "texcoord":
            layer = mesh.uv_layers.new(name=key)
            layer.data.foreach_set("uv", np.ascontiguousarray(values[:, :2]).ravel())
        else:
            colours = np.ones((len(values), 4), dtype=np.float32)
            colours[:, : values.shape[1]] = values
            layer = mesh.color_attributes.new(key, "FLOAT_COLOR", "CORNER")
            layer.data.foreach_set("color", colours.ravel())


def _fill_materials(mesh, source):
    mesh.materials.clear()
    names = [part.material for part in source.parts]
    if not any(names):
        return
    slots = {}
    for name in names:
        if name not in slots:
            slots[name] = len(mesh.materials)
            mesh.materials.append(bpy.data.materials.get(name) or bpy.data.materials.new(name))
    starts = [0]
    for polygon in source.polygon_faces():
        starts.append(starts[-1] + len(polygon) - 2)
    parts = source.face_parts[np.array(starts[:-1], dtype=np.int64)]
    mesh.polygons.foreach_set("material_index", np.array([slots[names[part]] for part in parts], dtype=np.int32))


def show(item, scene_frame):
    """Puts the frame of an imported object that belongs to a frame of the scene into its mesh, and says whether it could."""
    path, start = path_of(item), int(item[START])
    try:
        frame = open_stream(path, start).frame(scene_frame - start)
    except (OSError, tvg.Error, IndexError) as error:
        if path not in _errors:
            print(f"TVG: {item.name}: {error}")
        _errors[path] = str(error)
        return False
    _errors.pop(path, None)
    mesh = item.data
    if len(mesh.vertices) != len(frame.positions) or mesh.get("tvg_faces") != _mark(frame.mesh):
        fill_mesh(mesh, frame)
        mesh["tvg_faces"] = _mark(frame.mesh)
        return True
    mesh.vertices.foreach_set("co", frame.positions.ravel())
    mesh.update()
    return True


def _mark(mesh):
    """Tells meshes apart that have as many vertices."""
    return f"{len(mesh.faces)}:{zlib.crc32(mesh.faces.tobytes())}"


def _imported(scene):
    return [item for item in scene.objects if FILE in item and START in item and item.type == "MESH"]


@persistent
def _on_frame(scene, *_):
    items = _imported(scene)
    for item in items:
        show(item, scene.frame_current)
    _close_but({(path_of(item), int(item[START])) for other in bpy.data.scenes for item in _imported(other)})


@persistent
def _on_load(*_):
    close_all()
    for scene in bpy.data.scenes:
        _on_frame(scene)


def register():
    """Plays from now on, whatever file is loaded."""
    bpy.app.handlers.frame_change_pre.append(_on_frame)
    bpy.app.handlers.load_post.append(_on_load)


def unregister():
    """Leaves meshes as they are."""
    bpy.app.handlers.frame_change_pre.remove(_on_frame)
    bpy.app.handlers.load_post.remove(_on_load)
    close_all()
