"""What objects are in a frame of the scene, with all modifiers, as one mesh."""
import numpy as np
import tvg


class Evaluation:
    """The selected objects as one mesh in the world's space, a part for each object and material.

    A frame whose faces are those of the frame before it shares its mesh, UVs and all.
    """

    def __init__(self, items, uvs):
        self._items, self._with_uvs = items, uvs
        self._uv_name = None
        self._faces = None  # of each object in the frame before: how many vertices, and its faces
        self._mesh = None

    def frame(self, context):
        """The scene's current frame as a tvg.Frame."""
        graph = context.evaluated_depsgraph_get()
        positions, faces, uvs = [], [], []
        for item in self._items:
            evaluated = item.evaluated_get(graph)
            mesh = evaluated.to_mesh()
            world = np.array(evaluated.matrix_world, dtype=np.float64)
            positions.append((_numbers(mesh.vertices, "co", 3) @ world[:3, :3].T + world[:3, 3]).astype(np.float32))
            faces.append(_Faces(mesh))
            uvs.append(mesh.uv_layers.active)
            if self._with_uvs and self._uv_name is None and uvs[-1] is not None:
                self._uv_name = uvs[-1].name
        if not any(map(len, positions)):  # a frame that shows nothing: a stream's meshes have one vertex at least
            positions[0] = np.float32([self._items[0].evaluated_get(graph).matrix_world.translation])
        try:
            counts = [len(rows) for rows in positions]
            before, self._faces = self._faces, (counts, faces)
            if before is None or before[0] != counts or not all(map(_Faces.same, faces, before[1])):
                self._mesh = self._join(faces, uvs, counts)
            return tvg.Frame(np.concatenate(positions), self._mesh)
        finally:
            for item in self._items:
                item.evaluated_get(graph).to_mesh_clear()

    def _join(self, all_faces, uv_layers, vertex_counts):
        """One tvg.Mesh of the faces of all objects."""
        triangles, corner_uvs, polygons, parts, face_parts = [], [], [], [], []
        vertices = count = 0
        for item, faces, layer, vertex_count in zip(self._items, all_faces, uv_layers, vertex_counts):
            names = [slot.material.name if slot.material else "" for slot in item.material_slots] or [""]
            corners, owners = faces.fans()
            firsts = count + np.cumsum(faces.sizes - 2) - (faces.sizes - 2)
            more = faces.sizes > 3
            polygons.append(np.stack([firsts[more], faces.sizes[more]], axis=1))
            triangles.append(vertices + faces.loops[corners])
            face_parts.append(len(parts) + np.minimum(faces.materials[owners], len(names) - 1))
            uv = np.zeros((len(faces.loops), 2)) if layer is None else _numbers(layer.data, "uv", 2)
            corner_uvs.append(uv[corners])
            parts += [tvg.Part(object=item.name, material=name) for name in names]
            vertices += vertex_count
            count += len(corners)
        attributes = tvg.Attributes([])
        if self._uv_name is not None:
            values, corners = np.unique(
                np.concatenate(corner_uvs).astype(np.float32).reshape(-1, 2), axis=0, return_inverse=True
            )
            corners = corners.reshape(-1, 3).astype(np.uint32)
            attributes = tvg.Attributes([tvg.Attribute(values, "texcoord", "corner", corners, name=self._uv_name)])
        return tvg.Mesh(
            np.concatenate(triangles).astype(np.uint32),
            vertices,
            attributes,
            parts,
            np.concatenate(face_parts).astype(np.uint32),
            np.concatenate(polygons).astype(np.uint32),
        )


class _Faces:
    """Polygons of one of Blender's meshes: of each its first loop, corners and material; of each loop its vertex."""

    def __init__(self, mesh):
        self.loops = _numbers(mesh.loops, "vertex_index")
        self.starts = _numbers(mesh.polygons, "loop_start")
        self.sizes = _numbers(mesh.polygons, "loop_total")
        self.materials = _numbers(mesh.polygons, "material_index")

    def same(self, other):
        """Whether the two are the same polygons."""
        mine, its = vars(self), vars(other)
        return all(np.array_equal(mine[name], its[name]) for name in mine)

    def fans(self):
        """Triangles around each polygon's first corner: loops [triangle, 3] and the polygon of each."""
        counts = self.sizes - 2
        owners = np.repeat(np.arange(len(counts)), counts)
        place = np.arange(len(owners)) - (np.cumsum(counts) - counts)[owners]
        first = self.starts[owners]
        return np.stack([first, first + place + 1, first + place + 2], axis=1), owners


def _numbers(collection, name, columns=1):
    """A property of all items of one of Blender's collections; [item], or [item, columns] of reals."""
    values = np.empty(columns * len(collection), dtype=np.int32 if columns == 1 else np.float32)
    collection.foreach_get(name, values)
    return values.astype(np.int64) if columns == 1 else values.reshape(-1, columns)
