"""Plays streams just in time: at each frame of the scene the positions of imported meshes are decoded.

An imported object has two properties of its own, kept in .blend files: `tvg_file` (its stream, "//" relative to the
file) and `tvg_start` (the frame of the scene that shows the first frame). Of each stream one clip is open, and one
frame is held.
"""
import zlib

import bpy
import numpy as np
import tvg
from bpy.app.handlers import persistent

FILE = "tvg_file"
START = "tvg_start"

_clips = {}  # by absolute path
_broken = set()  # paths that were complained of


def clip_of(path):
    """The open clip of a file."""
    if path not in _clips:
        _clips[path] = tvg.open(path, on_damage=lambda damage: print(f"TVG: {path}: {damage}"))
    return _clips[path]


def close_all():
    """Closes every clip; they are opened again where they are needed."""
    for clip in _clips.values():
        clip.close()
    _clips.clear()
    _broken.clear()


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
    """Puts the frame of an imported object that belongs to a frame of the scene into its mesh."""
    path = bpy.path.abspath(item[FILE])
    try:
        clip = clip_of(path)
        number = min(max(0, scene_frame - int(item[START])), len(clip) - 1)
        frame = clip[number]
    except (OSError, tvg.Error, IndexError) as error:
        if path not in _broken:
            _broken.add(path)
            print(f"TVG: {item.name}: {error}")
        return
    mesh = item.data
    if len(mesh.vertices) != len(frame.positions) or mesh.get("tvg_faces") != _mark(frame.mesh):
        fill_mesh(mesh, frame)
        mesh["tvg_faces"] = _mark(frame.mesh)
        return
    mesh.vertices.foreach_set("co", frame.positions.ravel())
    mesh.update()


def _mark(mesh):
    """Tells meshes apart that have as many vertices."""
    return f"{len(mesh.faces)}:{zlib.crc32(mesh.faces.tobytes())}"


@persistent
def _on_frame(scene, *_):
    for item in scene.objects:
        if FILE in item and item.type == "MESH":
            show(item, scene.frame_current)


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
