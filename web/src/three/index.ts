export { TVGLoader } from "./tvg_loader.js";
export { TVGMesh, type TVGMeshEventMap } from "./tvg_mesh.js";
