import * as THREE from "three";
import type { FeedAttribute, FeedMesh } from "../feed_messages.js";
import type { TvgPlayer } from "../player.js";

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
  "ended",
  "damage",
  "error",
] as const;

/** What `addEventListener` takes beside three's own events; their meaning is HTMLMediaElement's. */
export type TVGMeshEventMap = THREE.Object3DEventMap & Record<(typeof kEvents)[number], object>;

/** three's names of what a mesh stores; texture coordinates beyond the first are uv1, uv2, ... */
function attributeName({ kind, name }: FeedAttribute, texcoords: number): string {
  if (kind === "texcoord") return texcoords === 0 ? "uv" : `uv${texcoords}`;
  if (kind === "normal") return "normal";
  return kind === "colour" ? "color" : `_${name}`;
}

/**
 * A mesh that plays a stream. Call `update` before each picture. One group and one material for each part; a mesh that
 * changes has another geometry from that frame on.
 */
export class TVGMesh extends THREE.Mesh<THREE.BufferGeometry, THREE.Material[], TVGMeshEventMap> {
  private last: number | undefined;

  constructor(
    /** The clock and the frames. */
    readonly player: TvgPlayer,
    private readonly makeMaterial: (name: string) => THREE.Material = defaultMaterial,
  ) {
    super(new THREE.BufferGeometry(), []);
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
  /** In seconds; NaN until it is known. */
  get duration(): number {
    return this.player.duration;
  }
  /** The end of what is decoded ahead, in seconds. */
  get buffered(): number {
    return this.player.bufferedTime;
  }

  /** Moves on to `now`, in milliseconds as requestAnimationFrame gives them. */
  update(now: number = performance.now()): void {
    this.player.update(this.last === undefined ? 0 : Math.max(0, now - this.last) / 1000);
    this.last = now;
  }

  /** Ends the stream, and gives back geometry and materials. */
  override dispose(): void {
    this.player.dispose();
    this.geometry.dispose();
    for (const material of this.material) material.dispose();
  }

  private takeMesh(mesh: FeedMesh): void {
    this.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
    let texcoords = 0;
    for (const attribute of mesh.attributes) {
      const name = attributeName(attribute, texcoords);
      if (attribute.kind === "texcoord") ++texcoords;
      geometry.setAttribute(name, new THREE.BufferAttribute(attribute.values, attribute.components));
    }
    mesh.ranges.forEach(({ firstIndex, indexCount }, part) => geometry.addGroup(firstIndex, indexCount, part));
    this.geometry = geometry;
    const coloured = mesh.attributes.some(({ kind }) => kind === "colour");
    for (const material of this.material) material.dispose();
    this.material = mesh.ranges.map((_, part) => {
      const material = this.makeMaterial(mesh.parts[part]?.material ?? "");
      material.vertexColors = coloured;
      return material;
    });
  }

  private takeFrame(): void {
    const { positions, normals } = this.player.frame!;
    this.write("position", positions);
    if (normals) this.write("normal", normals);
    this.geometry.boundingSphere = this.geometry.boundingBox = null;
  }

  private write(name: string, values: Float32Array): void {
    const attribute = this.geometry.getAttribute(name) as THREE.BufferAttribute | undefined;
    if (attribute?.array.length === values.length) {
      attribute.array = values;
      attribute.needsUpdate = true;
    } else {
      const made = new THREE.BufferAttribute(values, 3).setUsage(THREE.DynamicDrawUsage);
      this.geometry.setAttribute(name, made);
    }
  }
}

function defaultMaterial(name: string): THREE.Material {
  return new THREE.MeshStandardMaterial({ name, color: 0xb8b8c0, roughness: 0.75, side: THREE.DoubleSide });
}
