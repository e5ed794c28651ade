import * as THREE from "three";
import { farthestFrom, texelsFor } from "../basis_feed.js";
import { kFillVertexShader, kLayerStep, kNormalsShader, packRows, positionsShader } from "../basis_shaders.js";
import type { FeedMesh, FeedPlanes, GpuLimits } from "../feed_messages.js";

/** What materials read in the place of `position` and `normal`. */
const kDeclarations = `
#include <common>
attribute uint tvgVertex;
uniform highp sampler2D tvgPositions;
uniform highp sampler2D tvgNormals;
uniform bool tvgMade;
uniform bool tvgHasNormals;
vec3 tvgFetch(highp sampler2D values) {
  int width = textureSize(values, 0).x;
  return texelFetch(values, ivec2(int(tvgVertex) % width, int(tvgVertex) / width), 0).xyz;
}
`;
const kPosition = `
#include <begin_vertex>
if (tvgMade) transformed = tvgFetch(tvgPositions);
#ifdef USE_ALPHAHASH
  vPosition = transformed;
#endif
`;
const kNormal = `
#include <beginnormal_vertex>
if (tvgHasNormals) objectNormal = tvgFetch(tvgNormals);
`;

/**
 * Makes frames of mode "basis" on the GPU: two passes with a texel for each vertex, positions and from these normals,
 * which materials then read. On the CPU nothing is done for each vertex, but for planes that are uploaded.
 */
export class GpuBasis {
  private readonly uniforms = {
    tvgPositions: { value: null as THREE.Texture | null },
    tvgNormals: { value: null as THREE.Texture | null },
    tvgMade: { value: false },
    tvgHasNormals: { value: false },
  };
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly triangle: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  private readonly positionsPass = passMaterial({
    planes: { value: null },
    layers: { value: 0 },
    base: { value: new Float32Array(3) },
    rows: { value: new Float32Array(0) },
  });
  private readonly normalsPass = passMaterial({
    positions: { value: null },
    fans: { value: null },
    corners: { value: null },
  });
  private planes: FeedPlanes | undefined;
  private texture: THREE.DataArrayTexture | undefined;
  private positions: THREE.WebGLRenderTarget | undefined;
  private normals: THREE.WebGLRenderTarget | undefined;
  private fansOf: FeedMesh | undefined;
  private readonly firstSphere = new THREE.Sphere();

  /** What the renderer can do: undefined where it is not WebGL2, or cannot draw into textures of float32. */
  static limitsOf(renderer: unknown): GpuLimits | undefined {
    if (!(renderer as { isWebGLRenderer?: boolean }).isWebGLRenderer) return undefined;
    const gl = (renderer as THREE.WebGLRenderer).getContext() as WebGL2RenderingContext;
    if (!gl.getExtension("EXT_color_buffer_float")) return undefined;
    const room = Math.floor((gl.getParameter(gl.MAX_FRAGMENT_UNIFORM_VECTORS) - 8) / 3 / kLayerStep) * kLayerStep;
    const layers = Math.min(room, gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS));
    return { textureSize: gl.getParameter(gl.MAX_TEXTURE_SIZE), layers, components: 4 * layers };
  }

  constructor(private readonly renderer: THREE.WebGLRenderer) {
    const corners = new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3);
    this.triangle = new THREE.Mesh(new THREE.BufferGeometry().setAttribute("position", corners), this.positionsPass);
    this.triangle.frustumCulled = false;
    this.scene.add(this.triangle);
    // Nothing of it moves.
    for (const object of [this.scene, this.camera, this.triangle]) {
      object.matrixAutoUpdate = object.matrixWorldAutoUpdate = false;
    }
    this.normalsPass.fragmentShader = kNormalsShader;
    renderer.domElement.addEventListener("webglcontextrestored", this.redraw);
  }

  /** Lets a material draw what was made. It must be drawn with geometry of this mesh only. */
  patch(material: THREE.Material): void {
    const before = material.onBeforeCompile;
    material.onBeforeCompile = (shader, renderer) => {
      before.call(material, shader, renderer);
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", kDeclarations)
        .replace("#include <begin_vertex>", kPosition)
        .replace("#include <beginnormal_vertex>", kNormal);
    };
    const key = material.customProgramCacheKey;
    material.customProgramCacheKey = () => `${key.call(material)}tvg`;
    material.needsUpdate = true;
  }

  /** What geometry must have for such a material. */
  prepare(geometry: THREE.BufferGeometry, mesh: FeedMesh): void {
    geometry.setAttribute("tvgVertex", new THREE.BufferAttribute(mesh.sourceVertices, 1));
    this.planes = undefined;
    this.off();
  }

  /** Frames come as positions. */
  off(): void {
    this.uniforms.tvgMade.value = this.uniforms.tvgHasNormals.value = false;
  }

  /** Whether these planes are others than those that are there. */
  isNews(planes: FeedPlanes): boolean {
    return planes !== this.planes;
  }

  /** Takes the planes of a period of frames; `sphere` is around the first of them. */
  takePlanes(planes: FeedPlanes, mesh: FeedMesh, sphere: THREE.Sphere): void {
    this.planes = planes;
    this.firstSphere.copy(sphere);
    const { width, height, layers, coefficients } = planes;
    const isShort = coefficients instanceof Int16Array;
    const texture = this.texture;
    const { image } = texture ?? {};
    const hasKind = texture && (texture.type === THREE.ShortType) === isShort;
    if (hasKind && image?.width === width && image.height === height && image.depth === layers) {
      texture.image.data = coefficients as Float32Array<ArrayBuffer>;
    } else {
      texture?.dispose();
      this.texture = new THREE.DataArrayTexture(coefficients as Float32Array<ArrayBuffer>, width, height, layers);
      this.texture.format = isShort ? THREE.RGBAIntegerFormat : THREE.RGBAFormat;
      this.texture.type = isShort ? THREE.ShortType : THREE.FloatType;
      this.texture.internalFormat = isShort ? "RGBA16I" : "RGBA32F";
    }
    this.texture!.needsUpdate = true;
    this.compile(Math.ceil(layers / kLayerStep) * kLayerStep, isShort);
    this.positionsPass.uniforms["planes"]!.value = this.texture;
    this.positionsPass.uniforms["layers"]!.value = layers;
    this.positions = targetOf(this.positions, width, height);
    this.uniforms.tvgPositions.value = this.positions.texture;
    if (planes.normals) this.takeFans(mesh, planes);
  }

  /** Makes a frame of the planes that are there, and says what sphere it is within. */
  take(rows: Float32Array, sphere: THREE.Sphere): void {
    const { uniforms } = this.positionsPass;
    packRows(rows, uniforms["base"]!.value, uniforms["rows"]!.value);
    this.redraw();
    this.uniforms.tvgMade.value = true;
    this.uniforms.tvgHasNormals.value = this.planes!.normals !== undefined;
    sphere.copy(this.firstSphere);
    sphere.radius += Math.hypot(...farthestFrom(this.planes!, rows));
  }

  /** [vertex of the mesh][xyz], read back; undefined before there are any. */
  readPositions(): Float32Array | undefined {
    if (!this.planes) return undefined;
    const { width, height, vertexCount } = this.planes;
    const texels = new Float32Array(4 * width * height);
    this.renderer.readRenderTargetPixels(this.positions!, 0, 0, width, height, texels);
    return Float32Array.from({ length: 3 * vertexCount }, (_, i) => texels[4 * Math.floor(i / 3) + (i % 3)]!);
  }

  dispose(): void {
    this.renderer.domElement.removeEventListener("webglcontextrestored", this.redraw);
    this.texture?.dispose();
    this.positions?.dispose();
    this.normals?.dispose();
    this.disposeFans();
    this.triangle.geometry.dispose();
    this.positionsPass.dispose();
    this.normalsPass.dispose();
  }

  private readonly redraw = (): void => {
    if (!this.positions) return;
    const { renderer } = this;
    const target = renderer.getRenderTarget();
    const face = renderer.getActiveCubeFace();
    const level = renderer.getActiveMipmapLevel();
    const { autoClear } = renderer;
    const { enabled } = renderer.xr;
    renderer.autoClear = renderer.xr.enabled = false;
    this.draw(this.positionsPass, this.positions);
    if (this.planes?.normals) this.draw(this.normalsPass, this.normals!);
    renderer.autoClear = autoClear;
    renderer.xr.enabled = enabled;
    renderer.setRenderTarget(target, face, level);
  };

  private draw(material: THREE.RawShaderMaterial, target: THREE.WebGLRenderTarget): void {
    this.triangle.material = material;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene, this.camera);
  }

  private compile(room: number, isShort: boolean): void {
    const shader = positionsShader(room, isShort);
    if (shader === this.positionsPass.fragmentShader) return;
    this.positionsPass.fragmentShader = shader;
    this.positionsPass.uniforms["rows"]!.value = new Float32Array(12 * room);
    this.positionsPass.needsUpdate = true;
  }

  /** Which other corners the faces around each vertex have; once for a mesh. */
  private takeFans(mesh: FeedMesh, { width, height, vertexCount }: FeedPlanes): void {
    this.normals = targetOf(this.normals, width, height);
    this.uniforms.tvgNormals.value = this.normals.texture;
    this.normalsPass.uniforms["positions"]!.value = this.positions!.texture;
    if (mesh === this.fansOf) return;
    this.fansOf = mesh;
    this.disposeFans();
    const { fans, corners, cornerTexels } = fansOf(mesh, vertexCount, width * height);
    this.normalsPass.uniforms["fans"]!.value = pairTexture(fans, width, height);
    this.normalsPass.uniforms["corners"]!.value = pairTexture(corners, cornerTexels.width, cornerTexels.height);
  }

  private disposeFans(): void {
    for (const name of ["fans", "corners"]) (this.normalsPass.uniforms[name]!.value as THREE.Texture | null)?.dispose();
  }
}

interface Fans {
  /** [vertex]: where its faces begin in `corners`, and how many. */
  fans: Uint32Array;
  /** [vertex's face]: the other two corners, in order. */
  corners: Uint32Array;
  cornerTexels: { width: number; height: number };
}

function fansOf(mesh: FeedMesh, vertexCount: number, texels: number): Fans {
  const { indices, sourceVertices } = mesh;
  const fans = new Uint32Array(2 * texels);
  for (const index of indices) ++fans[2 * sourceVertices[index]! + 1]!;
  let first = 0;
  for (let v = 0; v < vertexCount; ++v) {
    fans[2 * v] = first;
    first += fans[2 * v + 1]!;
    fans[2 * v + 1] = 0;
  }
  const cornerTexels = texelsFor(indices.length);
  const corners = new Uint32Array(2 * cornerTexels.width * cornerTexels.height);
  for (let i = 0; i < indices.length; ++i) {
    const face = i - (i % 3);
    const corner = (step: number): number => sourceVertices[indices[face + ((i + step) % 3)]!]!;
    const fan = 2 * corner(0);
    const at = 2 * (fans[fan]! + fans[fan + 1]!++);
    corners[at] = corner(1);
    corners[at + 1] = corner(2);
  }
  return { fans, corners, cornerTexels };
}

function pairTexture(values: Uint32Array, width: number, height: number): THREE.DataTexture {
  const data = values as Uint32Array<ArrayBuffer>;
  const texture = new THREE.DataTexture(data, width, height, THREE.RGIntegerFormat, THREE.UnsignedIntType);
  texture.internalFormat = "RG32UI";
  texture.needsUpdate = true;
  return texture;
}

function targetOf(target: THREE.WebGLRenderTarget | undefined, width: number, height: number): THREE.WebGLRenderTarget {
  if (target?.width === width && target.height === height) return target;
  target?.dispose();
  const { NearestFilter, FloatType, RGBAFormat } = THREE;
  return new THREE.WebGLRenderTarget(width, height, {
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    type: FloatType,
    format: RGBAFormat,
    depthBuffer: false,
  });
}

function passMaterial(uniforms: Record<string, THREE.IUniform>): THREE.RawShaderMaterial {
  return new THREE.RawShaderMaterial({
    uniforms,
    vertexShader: kFillVertexShader,
    glslVersion: THREE.GLSL3,
    blending: THREE.NoBlending,
    depthTest: false,
    depthWrite: false,
  });
}
