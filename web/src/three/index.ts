export { TVGLoader } from "./tvg_loader.js";
export { TVGMaterials } from "./tvg_materials.js";
export { TVGMesh, type TVGMeshEventMap } from "./tvg_mesh.js";
