"""File > Export > TVG."""
import time
from fractions import Fraction

import bpy
import tvg
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from .export_job import ExportJob

_EXPECTED = (OSError, tvg.Error, ValueError)


class EXPORT_SCENE_OT_tvg(bpy.types.Operator, ExportHelper):
    """Export the selected meshes, as they are evaluated in each frame of the scene's range"""

    bl_idname = "export_scene.tvg"
    bl_label = "Export TVG"

    filename_ext = ".tvg"
    filter_glob: StringProperty(default="*.tvg", options={"HIDDEN"})
    mode: EnumProperty(
        name="Mode",
        items=[
            ("elp", "ELP", "Each frame from those before it; begins to play at once"),
            ("basis", "Basis", "Sums of planes that many frames share: far smaller, slower to make"),
        ],
        default="elp",
    )
    bits: IntProperty(name="Bits", description="Per coordinate, of important vertices", default=11, min=1, max=24)
    other_bits: IntProperty(
        name="Other bits",
        description="Per coordinate of vertices that are not important; 0: as many as of important ones",
        default=0, min=0, max=24,
    )
    important: FloatProperty(
        name="Important", description="Share of vertices that count as important, where others have fewer bits",
        default=35, min=0, max=100, subtype="PERCENTAGE",
    )
    uvs: BoolProperty(name="UVs", default=True)

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("mode", "bits", "other_bits"):
            layout.prop(self, name)
        row = layout.row()
        row.enabled = 0 < self.other_bits < self.bits
        row.prop(self, "important")
        layout.prop(self, "uvs")

    def execute(self, context):
        items = [item for item in context.selected_objects if item.type == "MESH"]
        if not items:
            self.report({"ERROR"}, "Select one mesh at least")
            return {"CANCELLED"}
        path = bpy.path.abspath(self.filepath)
        try:
            options = self._options(context.scene)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if context.window is not None and not bpy.app.background:
            # The dialogue's operator ends with the dialogue: what goes on is another.
            TVG_OT_export_frames.job = ExportJob(context, items, path, options, self.uvs)
            TVG_OT_export_frames.path = path
            bpy.ops.tvg.export_frames("INVOKE_DEFAULT")
            return {"FINISHED"}
        return self._wait(context, ExportJob(context, items, path, options, self.uvs), path)

    def _wait(self, context, job, path):
        """Exports at one go, as there is no window to keep alive."""
        wm = context.window_manager
        wm.progress_begin(0, 1000)
        try:
            report = None
            while report is None:
                before = job.progress
                report = job.step()
                done, count, _ = job.progress
                wm.progress_update(1000 * done // max(count, 1))
                if report is None and job.progress == before:
                    time.sleep(0.005)  # the encoder is at work
        except _EXPECTED as error:
            self.report({"ERROR"}, f"{path}: {error}")
            return {"CANCELLED"}
        finally:
            wm.progress_end()
            job.restore()
        self.report({"INFO"}, _summary(path, report))
        return {"FINISHED"}

    def _options(self, scene):
        """What tvg.encode() is asked for. ValueError where the settings contradict each other."""
        options = {"mode": self.mode, "bits": self.bits, "metadata": {"up": "z"}}
        options["fps"] = Fraction(scene.render.fps) / Fraction(scene.render.fps_base).limit_denominator(1001)
        if self.other_bits > self.bits:
            raise ValueError(f"Other bits are {self.other_bits}, more than the {self.bits} of important vertices")
        two = 0 < self.other_bits < self.bits
        if two:
            options["bits"] = (self.bits, self.other_bits)
            options["importance"] = tvg.Importance(share=self.important / 100)
        elif self.properties.is_property_set("important") and self.important != 35:
            self.report({"WARNING"}, "Important has no effect: Other bits are not fewer than Bits")
        return options


class TVG_OT_export_frames(bpy.types.Operator):
    """Goes on with an export, a frame at a time; Esc cancels it"""

    bl_idname = "tvg.export_frames"
    bl_label = "Export TVG: frames"
    bl_options = {"INTERNAL"}

    job = None  # what there is to do, set before it is invoked
    path = ""
    running = 0  # how many are on their way

    def invoke(self, context, _event):
        cls = type(self)
        self._job, self._path, cls.job = cls.job, cls.path, None
        if self._job is None:
            return {"CANCELLED"}
        wm = context.window_manager
        wm.progress_begin(0, 1000)
        self._timer = wm.event_timer_add(0.001, window=context.window)
        wm.modal_handler_add(self)
        cls.running += 1
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.cancel()
            self._end(context)
            self.report({"WARNING"}, f"{self._path}: cancelled, no file is left")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}  # the scene is not to change on the way
        try:
            report = self._job.step()
        except _EXPECTED as error:
            self._end(context)
            self.report({"ERROR"}, f"{self._path}: {error}")
            return {"CANCELLED"}
        if report is not None:
            self._end(context)
            self.report({"INFO"}, _summary(self._path, report))
            return {"FINISHED"}
        done, count, what = self._job.progress
        context.window_manager.progress_update(1000 * done // max(count, 1))
        context.workspace.status_text_set(f"TVG: {what} frame {min(done, count)} of {count}    Esc: cancel")
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Blender closes the window or the file."""
        self._job.cancel()
        self._end(context)

    def _end(self, context):
        type(self).running -= 1
        wm = context.window_manager
        wm.event_timer_remove(self._timer)
        wm.progress_end()
        context.workspace.status_text_set(None)
        self._job.restore()


def _summary(path, report):
    return f"{path}: {report.frames} frames, {report.bytes} bytes"
