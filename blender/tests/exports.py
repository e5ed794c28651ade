"""Run by Blender: exports that are unusual, or fail."""
import os

import toolbox
from toolbox import bpy, np
import tvg

scene = bpy.context.scene
toolbox.clear()
toolbox.use_frames(5, 12)
cloth = toolbox.make_cloth()
path = os.path.join(toolbox.folder, "cloth.tvg")

# Bits alone are those of all vertices; fewer for others mark the important share.
assert bpy.ops.export_scene.tvg(filepath=path, bits=12) == {"FINISHED"}
gop = tvg.open(path)[0].gop
assert gop.fine_step == gop.coarse_step
assert bpy.ops.export_scene.tvg(filepath=path, bits=12, other_bits=10, important=25) == {"FINISHED"}
gop = tvg.open(path)[0].gop
assert 3.9 < gop.coarse_step / gop.fine_step < 4.1 and 0.2 < gop.important.mean() < 0.3, gop
before = open(path, "rb").read()
assert toolbox.refuses(bpy.ops.export_scene.tvg, "10", "12", filepath=path, bits=10, other_bits=12)
assert bpy.ops.export_scene.tvg(filepath=path + ".basis", mode="basis", bits=10) == {"FINISHED"}
assert tvg.open(path + ".basis")[0].gop.mode == "basis"



def loops_of(faces):
    """Polygons by their vertices, whatever their order and the corner that they begin at."""
    return sorted(tuple(face[face.index(min(face)) :] + face[: face.index(min(face))]) for face in faces)


# A mesh that grows and shrinks on the way is a mesh that changes in the stream, UVs and materials with it.
cloth.data.materials.append(bpy.data.materials.new("red"))
build = cloth.modifiers.new("Build", "BUILD")
build.frame_start, build.frame_duration = 5, 8
changing = os.path.join(toolbox.folder, "changing.tvg")
assert bpy.ops.export_scene.tvg(filepath=changing, bits=14) == {"FINISHED"}
clip = tvg.open(changing)
assert len(clip) == 12
assert scene.frame_current == 1, "the frame that was shown is shown again"
counts = {}
for number, frame in enumerate(clip):
    scene.frame_set(5 + number)
    evaluated = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    wanted = np.array([evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]).reshape(-1, 3)
    faces = [list(polygon.vertices) for polygon in mesh.polygons]
    if len(faces) == 0:
        assert len(frame.faces) == 0, number
        continue
    assert frame.positions.shape == wanted.shape, number
    assert np.abs(frame.positions - wanted).max() <= 0.5 * frame.gop.fine_step * 1.001, number
    assert loops_of(face.tolist() for face in frame.mesh.polygon_faces()) == loops_of(faces), number
    assert frame.mesh.parts == [tvg.Part(object="Cloth", material="red")]
    counts[number] = len(wanted)
    evaluated.to_mesh_clear()
assert len(set(counts.values())) > 3, counts
toolbox.clear()
assert bpy.ops.import_scene.tvg(filepath=changing) == {"FINISHED"}
for number in (11, 3, 9, 5):
    scene.frame_set(5 + number)
    assert len(bpy.context.object.data.vertices) == counts[number], number

# What fails leaves nothing, and leaves what was there before.
os.remove(changing)
toolbox.clear()
cloth = toolbox.make_cloth()
cloth.modifiers.new("Build", "BUILD").frame_start = 100
files = sorted(os.listdir(toolbox.folder))
assert toolbox.refuses(bpy.ops.export_scene.tvg, "no face", filepath=path)
nowhere = os.path.join(toolbox.folder, "no-such-folder", "a.tvg")
assert toolbox.refuses(bpy.ops.export_scene.tvg, "no-such-folder", filepath=nowhere)
bpy.ops.object.select_all(action="DESELECT")
assert toolbox.refuses(bpy.ops.export_scene.tvg, "Select", filepath=path)
assert sorted(os.listdir(toolbox.folder)) == files and open(path, "rb").read() == before
toolbox.passed()
