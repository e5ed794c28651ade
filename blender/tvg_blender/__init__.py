"""File > Import and File > Export of .tvg streams of animated meshes."""
bl_info = {
    "name": "TVG",
    "author": "The TVG authors",
    "version": (0, 2, 0),
    "blender": (3, 0, 0),
    "location": "File > Import-Export",
    "description": "Import and export animated meshes as TVG streams",
    "category": "Import-Export",
}

import sys
from pathlib import Path

# The add-on brings the package along; one that is installed is as good.
_brought = Path(__file__).parent / "vendor"
if _brought.is_dir() and str(_brought) not in sys.path:
    sys.path.insert(0, str(_brought))

import bpy  # noqa: E402

from . import exporting, importing, panel, playback  # noqa: E402

_CLASSES = (
    importing.IMPORT_SCENE_OT_tvg,
    exporting.EXPORT_SCENE_OT_tvg,
    exporting.TVG_OT_export_frames,
    panel.TVG_OT_reload,
    panel.OBJECT_PT_tvg,
)


def _import_entry(menu, _context):
    menu.layout.operator(importing.IMPORT_SCENE_OT_tvg.bl_idname, text="TVG animation (.tvg)")


def _export_entry(menu, _context):
    menu.layout.operator(exporting.EXPORT_SCENE_OT_tvg.bl_idname, text="TVG animation (.tvg)")


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.TOPBAR_MT_file_import.append(_import_entry)
    bpy.types.TOPBAR_MT_file_export.append(_export_entry)
    playback.register()


def unregister():
    playback.unregister()
    bpy.types.TOPBAR_MT_file_export.remove(_export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(_import_entry)
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
