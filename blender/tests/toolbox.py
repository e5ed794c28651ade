"""What the tests share; imported inside Blender. TVG_BLENDER is the folder that the add-on was unpacked in."""
import os
import sys
import tempfile

sys.path.insert(0, os.environ["TVG_BLENDER"])
import bpy  # noqa: E402
import numpy as np  # noqa: E402
import tvg_blender  # noqa: E402  (brings the package along)

tvg_blender.register()
folder = tempfile.mkdtemp(prefix="tvg-blender-", dir=os.environ["TVG_BLENDER"])


def clear():
    """Removes all objects."""
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item, do_unlink=True)


def use_frames(first, count):
    """Makes the scene so long."""
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = first, first + count - 1


def make_cloth(name="Cloth", height=0.4):
    """A grid of quads that waves, selected."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=12, y_subdivisions=9, size=2)
    item = bpy.context.object
    item.name = name
    wave = item.modifiers.new("Wave", "WAVE")
    wave.height, wave.speed = height, 0.1
    return item


def vertices_of(item):
    """[vertex, 3] in the object's own space."""
    values = np.empty(3 * len(item.data.vertices), dtype=np.float32)
    item.data.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def refuses(operator, *words, **options):
    """Whether an operator reports an error with all of these words."""
    try:
        operator(**options)
    except RuntimeError as error:
        assert all(word in str(error) for word in words), error
        return True
    return False


def passed():
    """The last line of every test, for run.py."""
    tvg_blender.unregister()
    print("all of it passed", flush=True)
