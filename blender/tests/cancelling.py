"""Run by Blender in a window: an export goes on frame by frame, and Esc ends it without a trace."""
import os
import sys
import traceback

import toolbox
from toolbox import bpy
from tvg_blender import exporting

steps = []
taken = []


def in_window(action):
    """Does something as if it came from the window's menu."""
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=window.screen.areas[0]):
        return action()


def press(key):
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type=key, value="PRESS", x=200, y=200)
    window.event_simulate(type=key, value="RELEASE", x=200, y=200)


def running():
    return exporting.TVG_OT_export_frames.running > 0


def export(name):
    path = os.path.join(toolbox.folder, name)
    assert in_window(lambda: bpy.ops.export_scene.tvg(filepath=path)) == {"FINISHED"}
    assert running() and not os.path.exists(path)
    return path


def begin():
    toolbox.clear()
    toolbox.use_frames(1, 2000)
    toolbox.make_cloth()
    taken.append(export("cancelled.tvg"))


def cancel():
    if bpy.context.scene.frame_current < 5:
        return False  # not yet on its way
    press("ESC")
    return True


def cancelled():
    if running():
        return False
    assert bpy.context.scene.frame_current == 1, "the frame that was shown is shown again"
    assert os.listdir(toolbox.folder) == [], os.listdir(toolbox.folder)
    toolbox.use_frames(1, 20)
    taken.append(export("whole.tvg"))
    return True


def whole():
    if running():
        return False
    assert os.listdir(toolbox.folder) == ["whole.tvg"], os.listdir(toolbox.folder)
    import tvg

    assert len(tvg.open(taken[-1])) == 20
    toolbox.passed()
    return True


steps = [begin, cancel, cancelled, whole]


def go_on():
    try:
        if steps[0]() is not False:
            steps.pop(0)
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    if not steps:
        os._exit(0)  # Blender would ask whether to save
    return 0.1


bpy.app.timers.register(go_on, first_interval=1.0)
