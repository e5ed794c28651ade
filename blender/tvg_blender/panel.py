"""Properties > Object > TVG: where an imported object plays from, and what is wrong with it."""
import bpy

from . import playback


class TVG_OT_reload(bpy.types.Operator):
    """Open streams anew, after their files have changed"""

    bl_idname = "tvg.reload"
    bl_label = "Reload"

    def execute(self, context):
        playback.close_all()
        scene = context.scene
        scene.frame_set(scene.frame_current)
        return {"FINISHED"}


class OBJECT_PT_tvg(bpy.types.Panel):
    """The stream of an imported object"""

    bl_label = "TVG"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and playback.FILE in context.object

    def draw(self, context):
        item, layout = context.object, self.layout
        layout.use_property_split = True
        layout.prop(item, f'["{playback.FILE}"]', text="File")
        layout.prop(item, f'["{playback.START}"]', text="First frame at")
        error, damages = playback.troubles(item)
        for text in filter(None, [error, *damages]):
            line = layout.row()
            line.alert = True
            line.label(text=text, icon="ERROR")
        layout.operator(TVG_OT_reload.bl_idname)
