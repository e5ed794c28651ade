"""File > Import > TVG."""
from pathlib import Path

import bpy
import tvg
from bpy.props import BoolProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import playback


class IMPORT_SCENE_OT_tvg(bpy.types.Operator, ImportHelper):
    """Import an animated mesh that plays from its stream, without shape keys"""

    bl_idname = "import_scene.tvg"
    bl_label = "Import TVG"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".tvg"
    filter_glob: StringProperty(default="*.tvg", options={"HIDDEN"})
    set_frame_range: BoolProperty(
        name="Set frame range", description="Let the scene end with the animation", default=True
    )
    set_frame_rate: BoolProperty(
        name="Set frame rate", description="Give the scene the stream's frames per second", default=False
    )
    relative_path: BoolProperty(
        name="Relative path", description="Keep the path relative to the .blend file, where that has been saved",
        default=True,
    )

    def execute(self, context):
        scene = context.scene
        path = bpy.path.abspath(self.filepath)
        try:
            stream = playback.open_stream(path, scene.frame_start)
            first = stream.frame(0)
            frames = len(stream.clip)
        except (OSError, tvg.Error, IndexError) as error:
            self.report({"ERROR"}, f"{path}: {error}")
            return {"CANCELLED"}
        name = Path(path).stem
        item = bpy.data.objects.new(name, bpy.data.meshes.new(name))
        item[playback.FILE] = self._kept_path()
        item[playback.START] = scene.frame_start
        context.collection.objects.link(item)
        for other in context.selected_objects:
            other.select_set(False)
        item.select_set(True)
        context.view_layer.objects.active = item
        if stream.clip.metadata.get("up") == "y":
            item.rotation_euler[0] = 1.5707963267948966
        if self.set_frame_range:
            scene.frame_end = scene.frame_start + frames - 1
        if self.set_frame_rate and stream.clip.fps:
            scene.render.fps = max(1, round(stream.clip.fps))
            scene.render.fps_base = scene.render.fps / stream.clip.fps
        playback.show(item, scene.frame_current)
        error, damages = playback.troubles(item)
        for text in filter(None, [error, *damages]):
            self.report({"WARNING"}, f"{name}: {text}")
        self.report({"INFO"}, f"{name}: {frames} frames of {len(first.positions)} vertices")
        return {"FINISHED"}

    def _kept_path(self):
        """The path as it was given; relative to the .blend where that is wanted and can be."""
        if self.relative_path and bpy.data.filepath:
            try:
                return bpy.path.relpath(self.filepath)
            except ValueError:  # on another drive
                pass
        return self.filepath
