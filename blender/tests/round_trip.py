"""Run by Blender: exports a scene, imports what it made, and holds both beside each other."""
import os

import toolbox
from toolbox import bpy, np
import tvg
from tvg_blender import playback

stream = os.path.join(toolbox.folder, "wave.tvg")
kFrames = 12


def make_scene():
    """A grid of quads with UVs, two materials and a wave, and a cube beside it."""
    toolbox.clear()
    grid = toolbox.make_cloth()
    for name in ("red", "blue"):
        grid.data.materials.append(bpy.data.materials.new(name))
    for polygon in grid.data.polygons:
        polygon.material_index = polygon.index % 2
    bpy.ops.mesh.primitive_cube_add(location=(3, 0, 0))
    bpy.context.object.name = "Box"
    scene = bpy.context.scene
    toolbox.use_frames(5, kFrames)
    scene.render.fps, scene.render.fps_base = 24, 1.0
    for item in bpy.data.objects:
        item.select_set(item.type == "MESH")
    return [bpy.data.objects[name] for name in ("Cloth", "Box")]


def world_positions(items, number):
    bpy.context.scene.frame_set(number)
    graph = bpy.context.evaluated_depsgraph_get()
    rows = []
    for item in items:
        evaluated = item.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        rows += [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
        evaluated.to_mesh_clear()
    return np.array(rows)


def uv_of(mesh):
    values = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers[0].data.foreach_get("uv", values)
    return values.reshape(-1, 2)


def corners_by_vertices(mesh):
    """UVs and materials of polygons by their vertices, whatever the order of polygons."""
    uv = uv_of(mesh)
    found = {}
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        vertices = [mesh.loops[loop].vertex_index for loop in loops]
        turn = vertices.index(min(vertices))
        key = tuple(vertices[turn:] + vertices[:turn])
        slot = mesh.materials[polygon.material_index] if mesh.materials else None
        found[key] = (uv[loops[turn:] + loops[:turn]], slot.name if slot else "")
    return found


items = make_scene()
# In the order that the export takes them.
items = [item for item in bpy.context.selected_objects if item.type == "MESH"]
wanted = [world_positions(items, 5 + number) for number in range(kFrames)]
cloth = corners_by_vertices(bpy.data.objects["Cloth"].data)
first_vertex = 0 if items[0].name == "Cloth" else len(items[0].data.vertices)
assert bpy.ops.export_scene.tvg(filepath=stream, bits=12) == {"FINISHED"}
clip = tvg.open(stream)
assert len(clip) == kFrames and clip.fps == 24
assert [part.object for part in clip.parts] == [item.name for item in items for _ in (item.material_slots or [0])]
step = clip[0].gop.coarse_step

toolbox.clear()
assert bpy.ops.import_scene.tvg(filepath=stream, set_frame_rate=True) == {"FINISHED"}
item = bpy.context.object
assert bpy.context.scene.frame_end == 4 + kFrames
assert bpy.context.scene.render.fps == 24
for number in (0, 7, 3, kFrames - 1):
    bpy.context.scene.frame_set(5 + number)
    got = np.array([vertex.co for vertex in item.data.vertices])
    assert np.abs(got - wanted[number]).max() <= 0.5 * step * 1.001, number
    assert not item.data.shape_keys
back = corners_by_vertices(item.data)
for vertices, (uv, material) in cloth.items():
    uv_back, material_back = back[tuple(vertex + first_vertex for vertex in vertices)]
    assert np.abs(uv - uv_back).max() < 1e-3 and material == material_back, vertices

# A saved file plays again when it is loaded.
saved = os.path.join(toolbox.folder, "scene.blend")
bpy.context.scene.frame_set(5)
bpy.ops.wm.save_as_mainfile(filepath=saved)
playback.close_all()
bpy.ops.wm.open_mainfile(filepath=saved)
bpy.context.scene.frame_set(5 + 7)
item = next(other for other in bpy.data.objects if playback.FILE in other)
got = np.array([vertex.co for vertex in item.data.vertices])
assert np.abs(got - wanted[7]).max() <= 0.5 * step * 1.001

toolbox.passed()
