"""Run by Blender: what import makes of streams, and what it says of those that are broken or gone."""
import os
import shutil
from types import SimpleNamespace

import toolbox
from toolbox import bpy, np, vertices_of
import tvg
from tvg_blender import panel, playback

scene = bpy.context.scene
toolbox.clear()
toolbox.use_frames(1, 30)
path = os.path.join(toolbox.folder, "strip.tvg")
faces = [[0, 1, 2], [0, 2, 3]]
square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
positions = square + np.arange(30, dtype=np.float32)[:, None, None] * np.float32([0, 0, 0.1])
colours = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]], dtype=np.float32)
tvg.encode(positions, faces, path, bits=16, gop=10, attributes={"color": colours}, fps=24)


def height(item):
    return float(vertices_of(item)[:, 2].mean())


# Colours of vertices become those of corners.
assert bpy.ops.import_scene.tvg(filepath=path, set_frame_range=False) == {"FINISHED"}
first = bpy.context.object
(layer,) = first.data.color_attributes
for loop, shown in zip(first.data.loops, layer.data):
    assert np.allclose(shown.color, [*colours[loop.vertex_index], 1], atol=1 / 255), loop.vertex_index

# A second import of the same stream, ten frames later, beside the first; each shows its own frame, whichever way one goes.
scene.frame_start = 11
assert bpy.ops.import_scene.tvg(filepath=path, set_frame_range=False) == {"FINISHED"}
second = bpy.context.object
assert second is not first
scene.frame_start = 1
for number in (1, 15, 14, 30, 12, 13, 2):
    scene.frame_set(number)
    assert abs(height(first) - 0.1 * (number - 1)) < 1e-3, number
    assert abs(height(second) - 0.1 * max(0, number - 11)) < 1e-3, number

# Where the .blend is saved the path is kept relative to it, and both can be moved.
home = os.path.join(toolbox.folder, "here")
os.mkdir(home)
shutil.copy(path, home)
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(home, "scene.blend"))
assert bpy.ops.import_scene.tvg(filepath=os.path.join(home, "strip.tvg")) == {"FINISHED"}
assert bpy.context.object[playback.FILE] == "//strip.tvg"
assert bpy.ops.import_scene.tvg(filepath="//strip.tvg", relative_path=False) == {"FINISHED"}
assert bpy.context.object[playback.FILE] == "//strip.tvg", "a path is kept as it was given"
assert bpy.ops.import_scene.tvg(filepath=path, relative_path=False) == {"FINISHED"}
assert bpy.context.object[playback.FILE] == path
bpy.ops.wm.save_mainfile()
moved = os.path.join(toolbox.folder, "there")
os.rename(home, moved)
bpy.ops.wm.open_mainfile(filepath=os.path.join(moved, "scene.blend"))
scene = bpy.context.scene
item = next(other for other in bpy.data.objects if other.get(playback.FILE) == "//strip.tvg")
scene.frame_set(20)
assert abs(height(item) - 1.9) < 1e-3 and playback.troubles(item) == (None, [])


class Lines:
    """A layout that keeps what a panel writes."""

    def __init__(self):
        self.texts = []

    def row(self):
        return self

    def label(self, text, icon):
        self.texts.append(text)

    def prop(self, item, name, text):
        assert item.path_resolve(name) is not None, name

    def operator(self, _name):
        pass


def shown_by_panel(item):
    lines = Lines()
    panel.OBJECT_PT_tvg.draw(SimpleNamespace(layout=lines), SimpleNamespace(object=item))
    return lines.texts


assert shown_by_panel(item) == []

# A damaged stream plays on, and the object knows where it is broken.
stream = os.path.join(moved, "strip.tvg")
whole = open(stream, "rb").read()
damaged = bytearray(whole)
damaged[len(whole) // 2] ^= 0xFF
open(stream, "wb").write(damaged)
bpy.ops.tvg.reload()
for number in range(1, 31):
    scene.frame_set(number)
error, damages = playback.troubles(item)
assert damages and len(damages[0]) > 10, damages
assert shown_by_panel(item)[-len(damages) :] == damages
scene.frame_set(2)
assert playback.troubles(item)[0] is None and abs(height(item) - 0.1) < 1e-3

# A stream that is gone: the mesh stays, the object says why, until the stream is there again.
os.remove(stream)
bpy.ops.tvg.reload()
scene.frame_set(7)
error, damages = playback.troubles(item)
assert shown_by_panel(item) == [error]
assert "strip.tvg" in error and abs(height(item) - 0.1) < 1e-3
open(stream, "wb").write(whole)
scene.frame_set(8)
assert playback.troubles(item)[0] is None and abs(height(item) - 0.7) < 1e-3

# What is no stream is refused.
assert toolbox.refuses(bpy.ops.import_scene.tvg, "scene.blend", filepath=os.path.join(moved, "scene.blend"))
assert toolbox.refuses(bpy.ops.import_scene.tvg, "nothing.tvg", filepath=os.path.join(moved, "nothing.tvg"))
toolbox.passed()
