"""Runs inside Blender: makes an animated mesh and exports it, or imports files and tells what Blender sees.

    blender -b --factory-startup --python-exit-code 1 --python in_blender.py -- make KIND FOLDER
    blender -b --factory-startup --python-exit-code 1 --python in_blender.py -- look KIND FRAMES FILE... OUT.json
"""

import json
import math
import os
import sys

import addon_utils
import bpy

FRAMES = 12
RATE = 25
# The sides of the sheet, in squares.
ACROSS, ALONG = 9, 6


def fail(message):
    print("in_blender:", message)
    sys.exit(1)


def enable(addon):
    if addon_utils.enable(addon) is None:
        fail("there is no add-on " + addon)


def enable_gltf():
    try:
        import numpy
    except ImportError:
        fail("skipped: Blender's glTF add-on needs NumPy")
    # The add-on of Blender 3.4 has a name that NumPy 1.24 has no more.
    if not hasattr(numpy, "bool"):
        numpy.bool = bool
    enable("io_scene_gltf2")


def height(x, y, time):
    return 0.3 * math.sin(2 * x + 3 * time) * math.cos(1.5 * y - 2 * time)


def material(name, colour):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*colour, 1)
    return made


def make_sheet():
    """A sheet of squares, waving: texture coordinates with a seam in the middle, colours, two materials."""
    points = [(x / 3, y / 3, height(x / 3, y / 3, 0)) for y in range(ALONG + 1) for x in range(ACROSS + 1)]
    corner = lambda x, y: y * (ACROSS + 1) + x
    squares = [
        (corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1))
        for y in range(ALONG)
        for x in range(ACROSS)
    ]
    mesh = bpy.data.meshes.new("sheet")
    mesh.from_pydata(points, [], squares)
    mesh.materials.append(material("wood", (0.5, 0.25, 0.125)))
    mesh.materials.append(material("cloth", (0.125, 0.25, 0.75)))
    layer = mesh.uv_layers.new(name="UVMap")
    for face in mesh.polygons:
        right = face.index % ACROSS >= ACROSS // 2
        face.material_index = 1 if right else 0
        face.use_smooth = True
        for loop in face.loop_indices:
            vertex = mesh.loops[loop].vertex_index
            x, y = vertex % (ACROSS + 1), vertex // (ACROSS + 1)
            layer.data[loop].uv = (x / ACROSS * 0.9 + (0.1 if right else 0), y / ALONG)
    # At corners, where the PLY add-on looks for them.
    colours = mesh.color_attributes.new("Col", "BYTE_COLOR", "CORNER")
    for loop, value in enumerate(colours.data):
        i = mesh.loops[loop].vertex_index
        value.color_srgb = ((i * 37 % 256) / 255, (i * 91 % 256) / 255, (i * 5 % 256) / 255, 1)
    mesh.color_attributes.active_color = colours
    sheet = bpy.data.objects.new("sheet", mesh)
    bpy.context.collection.objects.link(sheet)
    bpy.context.view_layer.objects.active = sheet
    sheet.select_set(True)
    sheet.shape_key_add(name="Basis")
    for frame in range(1, FRAMES):
        key = sheet.shape_key_add(name="frame %d" % frame)
        for i, (x, y, _) in enumerate(points):
            key.data[i].co = (x + 0.02 * frame, y, height(x, y, frame / FRAMES))
        for at in (frame - 1, frame, frame + 1):
            key.value = 1.0 if at == frame else 0.0
            key.keyframe_insert("value", frame=at)
        curve = sheet.data.shape_keys.animation_data.action.fcurves[-1]
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    return sheet


def make(kind, folder):
    scene = bpy.context.scene
    scene.render.fps = RATE
    scene.frame_start, scene.frame_end = 0, FRAMES - 1
    make_sheet()
    folder = os.path.join(folder, kind)
    os.makedirs(folder, exist_ok=True)
    axes = {"forward_axis": "Y", "up_axis": "Z"}
    scene.frame_set(0)
    if kind == "cache":
        bpy.ops.wm.obj_export(filepath=os.path.join(folder, "sheet.obj"), export_colors=True, **axes)
        enable("io_shape_mdd")
        bpy.ops.export_shape.mdd(
            filepath=os.path.join(folder, "sheet.mdd"), fps=RATE, frame_start=0, frame_end=FRAMES - 1
        )
    elif kind == "obj":
        bpy.ops.wm.obj_export(
            filepath=os.path.join(folder, "sheet.obj"),
            export_animation=True,
            start_frame=0,
            end_frame=FRAMES - 1,
            export_colors=True,
            **axes
        )
    elif kind == "ply":
        enable("io_mesh_ply")
        for frame in range(FRAMES):
            scene.frame_set(frame)
            bpy.ops.export_mesh.ply(filepath=os.path.join(folder, "sheet_%04d.ply" % frame))
    else:
        enable_gltf()
        bpy.ops.export_scene.gltf(
            filepath=os.path.join(folder, "sheet.glb"), export_frame_range=True, export_colors=True
        )


def base_colour(made):
    """The base colour, also where colours of vertices are multiplied by it."""
    if not made.use_nodes:
        return list(made.diffuse_color)[:3]
    for node in made.node_tree.nodes:
        if node.type != "BSDF_PRINCIPLED":
            continue
        entry = node.inputs["Base Color"]
        if not entry.is_linked:
            return list(entry.default_value)[:3]
        for mixed in entry.links[0].from_node.inputs:
            if mixed.type == "RGBA" and mixed.enabled and not mixed.is_linked:
                return list(mixed.default_value)[:3]
    return [1, 1, 1]


def colours_of(mesh):
    """[vertex][red, green, blue] as stored in sRGB, or None."""
    if not mesh.color_attributes:
        return None
    layer = mesh.color_attributes[0]
    found = [None] * len(mesh.vertices)
    for i, value in enumerate(layer.data):
        vertex = mesh.loops[i].vertex_index if layer.domain == "CORNER" else i
        found[vertex] = list(value.color_srgb)[:3]
    return [colour or [0, 0, 0] for colour in found]


def describe(objects):
    """What does not change over time."""
    result = {"faces": [], "materials": {}}
    for item in objects:
        mesh = item.data
        first = len(result.setdefault("vertices", []))
        result["vertices"] += [None] * len(mesh.vertices)
        uv = mesh.uv_layers.active.data if mesh.uv_layers.active else None
        colours = colours_of(mesh)
        for face in mesh.polygons:
            slot = item.material_slots[face.material_index].material if item.material_slots else None
            if slot:
                result["materials"][slot.name] = base_colour(slot)
            loops = list(face.loop_indices)
            vertices = [mesh.loops[loop].vertex_index for loop in loops]
            result["faces"].append(
                {
                    "vertices": [first + vertex for vertex in vertices],
                    "uv": [list(uv[loop].uv) for loop in loops] if uv else None,
                    "colours": [colours[vertex] for vertex in vertices] if colours else None,
                    "material": slot.name if slot else None,
                }
            )
    del result["vertices"]
    return result


def positions_now(objects):
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for item in objects:
        evaluated = item.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        matrix = evaluated.matrix_world
        found += [list(matrix @ vertex.co) for vertex in mesh.vertices]
        evaluated.to_mesh_clear()
    return found


def meshes():
    return [item for item in bpy.data.objects if item.type == "MESH"]


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = RATE


def look_at_files(kind, files):
    """One file for each frame."""
    result = None
    frames = []
    for path in files:
        clear()
        if kind == "obj":
            bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z")
        else:
            enable("io_mesh_ply")
            bpy.ops.import_mesh.ply(filepath=path)
        result = result or describe(meshes())
        frames.append(positions_now(meshes()))
    return dict(result, frames=frames)


def look_at_clip(frame_count):
    result = describe(meshes())
    frames = []
    for frame in range(frame_count):
        bpy.context.scene.frame_set(frame)
        frames.append(positions_now(meshes()))
    return dict(result, frames=frames)


def look(kind, frame_count, files, out):
    clear()
    if kind == "cache":
        enable("io_shape_mdd")
        bpy.ops.wm.obj_import(filepath=files[0], forward_axis="Y", up_axis="Z")
        bpy.context.view_layer.objects.active = meshes()[0]
        bpy.ops.import_shape.mdd(filepath=files[1])
        result = look_at_clip(frame_count)
    elif kind == "gltf":
        enable_gltf()
        bpy.ops.import_scene.gltf(filepath=files[0])
        result = look_at_clip(frame_count)
    else:
        result = look_at_files(kind, files)
    with open(out, "w") as file:
        json.dump(result, file)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :]
    clear()
    if arguments[0] == "make":
        make(arguments[1], arguments[2])
    else:
        look(arguments[1], int(arguments[2]), arguments[3:-1], arguments[-1])


main()
