import * as THREE from "three";
import type { FeedAttribute, FeedFrame, FeedMesh, FeedPlanes } from "../feed_messages.js";
import type { TvgPlayer } from "../player.js";
import type { TimeRangesLike } from "../time_ranges.js";
import { importanceColours, toLinear } from "./colours.js";
import { GpuBasis } from "./gpu_basis.js";
import { TVGMaterials } from "./tvg_materials.js";

const kEvents = [
  "loadedmetadata",
  "durationchange",
  "canplay",
  "play",
  "pause",
  "playing",
  "waiting",
  "seeking",
  "seeked",
  "timeupdate",
  "progress",
  "ended",
  "damage",
  "error",
] as const;

/** What `addEventListener` takes beside three's own events; their meaning is HTMLMediaElement's. */
export type TVGMeshEventMap = THREE.Object3DEventMap & Record<(typeof kEvents)[number], object>;

/** three's names of what a mesh stores: the first of a kind, and further texture coordinates, are drawn. */
function attributeNames(attributes: FeedAttribute[]): string[] {
  const taken = { texcoord: 0, normal: 0, colour: 0, generic: 0 };
  return attributes.map(({ kind, name }) => {
    const number = taken[kind]++;
    if (kind === "texcoord") return number === 0 ? "uv" : `uv${number}`;
    if (number === 0 && kind === "normal") return "normal";
    return number === 0 && kind === "colour" ? "color" : `_${name || `${kind}${number}`}`;
  });
}

/**
 * A mesh that plays a stream. Call `update` before each picture. One group and one material for each part; a mesh that
 * changes has another geometry from that frame on.
 */
export class TVGMesh extends THREE.Mesh<THREE.BufferGeometry, THREE.Material[], TVGMeshEventMap> {
  private last: number | undefined;
  private readonly materials: TVGMaterials;
  /** Those of the parts, while the overlay's may be shown in their place. */
  private own: THREE.Material[] = [];
  /** Of the animated attributes, in their order. */
  private animated: { name: string; attribute: FeedAttribute }[] = [];
  private overlay: THREE.Material | undefined;
  private ownColours: THREE.BufferAttribute | undefined;
  private overlayColours: THREE.BufferAttribute | undefined;
  private shownFlags: Uint8Array | undefined;
  private gpu: GpuBasis | undefined;

  constructor(
    /** The clock and the frames. */
    readonly player: TvgPlayer,
    /** In place of what the stream says of a material. */
    private readonly makeMaterial?: (name: string) => THREE.Material,
  ) {
    super(new THREE.BufferGeometry(), []);
    this.materials = new TVGMaterials(player.data);
    player.addEventListener("mesh", () => this.takeMesh(player.mesh!));
    player.addEventListener("frame", () => this.takeFrame());
    for (const type of kEvents) player.addEventListener(type, () => this.dispatchEvent({ type }));
  }

  play(): void {
    this.player.play();
  }
  pause(): void {
    this.player.pause();
  }
  get paused(): boolean {
    return this.player.paused;
  }
  get ended(): boolean {
    return this.player.ended;
  }
  get loop(): boolean {
    return this.player.loop;
  }
  set loop(on: boolean) {
    this.player.loop = on;
  }
  get playbackRate(): number {
    return this.player.playbackRate;
  }
  set playbackRate(rate: number) {
    this.player.playbackRate = rate;
  }
  /** In seconds; setting it seeks. */
  get currentTime(): number {
    return this.player.currentTime;
  }
  set currentTime(seconds: number) {
    this.player.currentTime = seconds;
  }
  /** In seconds; NaN until it is known, Infinity of a live stream. */
  get duration(): number {
    return this.player.duration;
  }
  /** What is there already, as HTMLMediaElement's. */
  get buffered(): TimeRangesLike {
    return this.player.buffered;
  }
  /** Until materials have their pictures. */
  get ready(): Promise<unknown> {
    return this.materials.ready;
  }
  /** Whether vertices are coloured by their importance, in place of their materials. */
  get importance(): boolean {
    return this.player.wantsFlags;
  }
  set importance(on: boolean) {
    this.player.wantsFlags = on;
    this.showOverlay();
  }

  /**
   * Lets the GPU make frames of mode "basis": the CPU then does nothing for each vertex. False, and frames come as
   * positions, where the renderer is not WebGLRenderer or cannot draw into textures of float32. `geometry` has the first
   * frame of each period then. Materials must be built-in ones, and this mesh's alone; pictures may be drawn with this
   * renderer only.
   */
  useGpu(renderer: unknown): boolean {
    const limits = GpuBasis.limitsOf(renderer);
    if (!limits || this.gpu) return this.gpu !== undefined;
    this.gpu = new GpuBasis(renderer as THREE.WebGLRenderer);
    this.customDepthMaterial = new THREE.MeshDepthMaterial();
    this.customDistanceMaterial = new THREE.MeshDistanceMaterial();
    for (const material of [...this.own, this.overlay, this.customDepthMaterial, this.customDistanceMaterial]) {
      if (material) this.gpu.patch(material);
    }
    if (this.player.mesh) this.gpu.prepare(this.geometry, this.player.mesh);
    this.player.gpu = limits;
    return true;
  }
  /** [vertex of the mesh][xyz] of a frame that the GPU made, which takes long; undefined of another. */
  readGpuPositions(): Float32Array | undefined {
    return this.player.frame?.rows && this.gpu?.readPositions();
  }

  /** Moves on to `now`, in milliseconds as requestAnimationFrame gives them. */
  update(now: number = performance.now()): void {
    this.player.update(this.last === undefined ? 0 : Math.max(0, now - this.last) / 1000);
    this.last = now;
  }

  /** Ends the stream, and gives back geometry, materials and their pictures. */
  override dispose(): void {
    this.player.dispose();
    this.geometry.dispose();
    this.materials.dispose();
    this.overlay?.dispose();
    this.gpu?.dispose();
    this.customDepthMaterial?.dispose();
    this.customDistanceMaterial?.dispose();
    for (const material of this.own) material.dispose();
  }

  private takeMesh(mesh: FeedMesh): void {
    this.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
    const names = attributeNames(mesh.attributes);
    this.animated = [];
    mesh.attributes.forEach((attribute, i) => {
      const name = names[i]!;
      const values = new THREE.BufferAttribute(attribute.values, attribute.components);
      if (attribute.animated) {
        values.setUsage(THREE.DynamicDrawUsage);
        this.animated.push({ name, attribute });
      }
      if (name === "color") toLinear(attribute.values, attribute.components, attribute.values);
      geometry.setAttribute(name, values);
    });
    mesh.ranges.forEach(({ firstIndex, indexCount }, part) => geometry.addGroup(firstIndex, indexCount, part));
    this.geometry = geometry;
    this.gpu?.prepare(geometry, mesh);
    this.ownColours = geometry.getAttribute("color") as THREE.BufferAttribute | undefined;
    this.shownFlags = undefined;
    for (const material of this.own) material.dispose();
    this.own = mesh.ranges.map((_, part) => this.newMaterial(mesh.parts[part]?.material ?? ""));
    this.material = this.own;
  }

  private newMaterial(name: string): THREE.Material {
    const coloured = this.ownColours !== undefined;
    const material = this.makeMaterial?.(name) ?? this.materials.make(name, coloured);
    material.vertexColors = coloured;
    if (this.player.metadata.get("shading") === "flat") Object.assign(material, { flatShading: true });
    this.gpu?.patch(material);
    return material;
  }

  private takeFrame(): void {
    const { rows, planes, values } = this.player.frame!;
    if (rows && planes && this.gpu) this.takeRows(this.gpu, rows, planes);
    else this.takePositions(this.player.frame!);
    values?.forEach((animated, i) => this.takeValues(i, animated));
    this.showOverlay();
  }

  private takePositions({ positions, normals }: Pick<FeedFrame, "positions" | "normals">): void {
    this.gpu?.off();
    this.write("position", positions);
    if (normals) this.write("normal", normals);
    this.geometry.boundingSphere = this.geometry.boundingBox = null;
  }

  private takeRows(gpu: GpuBasis, rows: Float32Array, planes: FeedPlanes): void {
    if (gpu.isNews(planes)) {
      this.takePositions(planes);
      this.geometry.computeBoundingSphere();
      gpu.takePlanes(planes, this.player.mesh!, this.geometry.boundingSphere!);
    }
    gpu.take(rows, (this.geometry.boundingSphere ??= new THREE.Sphere()));
  }

  private takeValues(index: number, values: Float32Array): void {
    const { name, attribute } = this.animated[index]!;
    const { components } = attribute;
    if (name === "color") toLinear(values, components, values);
    if (name === "color" && this.shownFlags) this.ownColours = new THREE.BufferAttribute(values, components);
    else this.write(name, values, components);
  }

  /** The overlay's colours and material where they are wanted and known, else the mesh's own. */
  private showOverlay(): void {
    const count = this.player.mesh?.vertexCount;
    const flags = this.importance && this.player.flags?.length === count ? this.player.flags : undefined;
    if (flags === this.shownFlags) return;
    this.shownFlags = flags;
    if (flags) {
      this.overlay ??= this.newOverlay();
      const { overlay } = this;
      const colours = importanceColours(flags);
      if (this.overlayColours?.array.length !== colours.length) this.overlayColours = new THREE.BufferAttribute(colours, 3);
      this.overlayColours.array = colours;
      this.overlayColours.needsUpdate = true;
      this.geometry.setAttribute("color", this.overlayColours);
      this.material = this.own.map(() => overlay);
      return;
    }
    this.material = this.own;
    if (this.ownColours) this.geometry.setAttribute("color", this.ownColours);
    else this.geometry.deleteAttribute("color");
  }

  private newOverlay(): THREE.Material {
    const overlay = new THREE.MeshStandardMaterial({ roughness: 0.75, side: THREE.DoubleSide, vertexColors: true });
    this.gpu?.patch(overlay);
    return overlay;
  }

  private write(name: string, values: Float32Array, components = 3): void {
    const attribute = this.geometry.getAttribute(name) as THREE.BufferAttribute | undefined;
    if (attribute?.array.length === values.length) {
      attribute.array = values;
      attribute.needsUpdate = true;
    } else {
      const made = new THREE.BufferAttribute(values, components).setUsage(THREE.DynamicDrawUsage);
      this.geometry.setAttribute(name, made);
    }
  }
}
