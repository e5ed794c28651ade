"""File > Export > TVG."""
from fractions import Fraction

import bpy
import numpy as np
import tvg
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper


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
    bits: IntProperty(name="Bits", description="Per coordinate of important vertices", default=11, min=1, max=24)
    other_bits: IntProperty(name="Other bits", description="Per coordinate of other vertices", default=11, min=1, max=24)
    important: FloatProperty(
        name="Important", description="Share of vertices that count as important", default=35, min=0, max=100,
        subtype="PERCENTAGE",
    )
    uvs: BoolProperty(name="UVs", default=True)

    def execute(self, context):
        items = [item for item in context.selected_objects if item.type == "MESH"]
        if not items:
            self.report({"ERROR"}, "Select one mesh at least")
            return {"CANCELLED"}
        scene = context.scene
        shown = scene.frame_current
        wm = context.window_manager
        wm.progress_begin(0, scene.frame_end - scene.frame_start + 1)
        try:
            report = self._encode(context, items)
        except (OSError, tvg.Error, ValueError) as error:
            self.report({"ERROR"}, f"{self.filepath}: {error}")
            return {"CANCELLED"}
        finally:
            wm.progress_end()
            scene.frame_set(shown)
        self.report({"INFO"}, f"{self.filepath}: {report.frames} frames, {report.bytes} bytes")
        return {"FINISHED"}

    def _encode(self, context, items):
        scene = context.scene
        scene.frame_set(scene.frame_start)
        meshes = _Evaluated(context, items)
        options = {}
        if self.mode == "elp" and self.other_bits < self.bits:
            options["bits"] = (self.bits, self.other_bits)
            options["importance"] = tvg.Importance(share=self.important / 100)
        else:
            options["bits"] = self.bits
        fps = Fraction(scene.render.fps) / Fraction(scene.render.fps_base).limit_denominator(1001)
        return tvg.encode(
            self._frames(context, meshes),
            meshes.triangles,
            self.filepath,
            mode=self.mode,
            fps=fps,
            attributes=meshes.uvs() if self.uvs else None,
            parts=meshes.parts,
            face_parts=meshes.face_parts,
            polygons=meshes.polygons,
            metadata={"up": "z"},
            **options,
        )

    def _frames(self, context, meshes):
        scene = context.scene
        for number in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(number)
            context.window_manager.progress_update(number - scene.frame_start)
            yield meshes.positions(context, number)


class _Evaluated:
    """What selected objects are at the first frame: all of them one mesh, a part for each object and material."""

    def __init__(self, context, items):
        self._items = items
        graph = context.evaluated_depsgraph_get()
        triangles, polygons, places, self.parts, face_parts = [], [], [], [], []
        self._uv_names, uv_values = [], {}
        vertices = faces = 0
        all_loops = []
        for item in items:
            evaluated = item.evaluated_get(graph)
            mesh = evaluated.to_mesh()
            first_part = len(self.parts)
            names = [slot.material.name if slot.material else "" for slot in item.material_slots] or [""]
            self.parts += [tvg.Part(object=item.name, material=name) for name in names]
            loops = np.empty(len(mesh.loops), dtype=np.int64)
            mesh.loops.foreach_get("vertex_index", loops)
            all_loops.append(loops)
            layer = mesh.uv_layers.active
            uv = np.zeros((len(loops), 2), dtype=np.float32)
            if layer is not None:
                layer.data.foreach_get("uv", uv.ravel())
                self._uv_names.append(layer.name)
            for polygon in mesh.polygons:
                start, count = polygon.loop_start, polygon.loop_total
                if count > 3:
                    polygons.append((faces, count))
                for corner in range(1, count - 1):
                    triangles.append([start, start + corner, start + corner + 1])
                    face_parts.append(first_part + min(polygon.material_index, len(names) - 1))
                    faces += 1
            local = np.array(triangles[len(places) :], dtype=np.int64).reshape(-1, 3)
            places += [(vertices + loops[corners], uv[corners]) for corners in local]
            vertices += len(mesh.vertices)
            evaluated.to_mesh_clear()
        if not places:
            raise ValueError("the selected meshes have no face")
        self._vertices = vertices
        self._loops = all_loops
        self.triangles = np.array([numbers for numbers, _ in places], dtype=np.uint32)
        self._corner_uvs = np.array([values for _, values in places], dtype=np.float32)
        self.polygons = np.array(polygons, dtype=np.uint32).reshape(-1, 2)
        self.face_parts = np.array(face_parts, dtype=np.uint32)

    def uvs(self):
        """The active UV map of each object, for each corner; None where no object has one."""
        if not self._uv_names:
            return None
        values, corners = np.unique(self._corner_uvs.reshape(-1, 2), axis=0, return_inverse=True)
        name = self._uv_names[0]
        return {name: tvg.Attribute(values, "texcoord", "corner", corners.reshape(-1, 3), name=name)}

    def positions(self, context, number):
        """Of all vertices in a frame, in the world's space, float32 [vertex, 3]."""
        graph = context.evaluated_depsgraph_get()
        rows = []
        for item, first_loops in zip(self._items, self._loops):
            evaluated = item.evaluated_get(graph)
            mesh = evaluated.to_mesh()
            loops = np.empty(len(mesh.loops), dtype=np.int64)
            mesh.loops.foreach_get("vertex_index", loops)
            if not np.array_equal(loops, first_loops):
                evaluated.to_mesh_clear()
                raise ValueError(
                    f"{item.name} has other faces in frame {number} than in the first: a modifier changes the mesh from "
                    "frame to frame; apply it, or export frames with one mesh"
                )
            co = np.empty(3 * len(mesh.vertices), dtype=np.float32)
            mesh.vertices.foreach_get("co", co)
            world = np.array(evaluated.matrix_world, dtype=np.float64)
            rows.append((co.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]).astype(np.float32))
            evaluated.to_mesh_clear()
        positions = np.concatenate(rows)
        if len(positions) != self._vertices:
            raise ValueError(
                f"frame {number} has {len(positions)} vertices and the first {self._vertices}: a modifier changes the "
                "mesh from frame to frame; apply it, or export frames with one mesh"
            )
        return positions
