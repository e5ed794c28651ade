import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { TVGMesh } from "../src/three/tvg_mesh.js";

// The camera and the lights of `tvg render`, so that its pictures look like the page.
const kFieldOfView = 30;
const kMargin = 1.06;
const kAzimuth = (30 * Math.PI) / 180;
const kElevation = (15 * Math.PI) / 180;

/** Where the mesh is looked at. Throws where there is no WebGL. */
export class Stage {
  readonly camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01, 1000);
  private controls: OrbitControls;
  readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly sky = new THREE.HemisphereLight(new THREE.Color(0.3, 0.325, 0.36), new THREE.Color(0.13, 0.115, 0.11), Math.PI);
  private stale = true;
  /** What the camera was placed to show, and whether somebody has placed it otherwise since. */
  private readonly shown = new THREE.Box3();
  private isUpZ = false;
  private isTurned = false;
  /** Pixels at the canvas' lower edge that something covers: the middle is that of what is above. */
  bottom = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly mesh: TVGMesh,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    mesh.useGpu(this.renderer);
    this.controls = this.newControls();
    const key = new THREE.DirectionalLight(new THREE.Color(0.98, 0.91, 0.8), Math.PI);
    key.position.set(-0.5, 0.66, 0.56);
    const fill = new THREE.DirectionalLight(new THREE.Color(0.1, 0.135, 0.2), Math.PI);
    fill.position.set(0.76, -0.08, 0.645);
    this.camera.add(key, fill);
    for (const light of [key, fill]) this.camera.add(light.target);
    this.scene.add(this.camera, this.sky, mesh);
    mesh.frustumCulled = false;
  }

  /** Another picture is to be drawn. */
  refresh(): void {
    this.stale = true;
  }

  /** Draws where something has changed. */
  draw(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== clientWidth || size.y !== clientHeight) {
      this.renderer.setSize(clientWidth, clientHeight, false);
      this.place();
    }
    if (!this.stale || !this.mesh.player.frame) return;
    this.stale = false;
    this.renderer.render(this.scene, this.camera);
  }

  private place(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.camera.aspect = width / Math.max(1, height);
    this.camera.setViewOffset(width, height, 0, this.bottom / 2, width, height);
    this.stale = true;
  }

  /** Puts the frame into the middle of the picture, as near as its box allows, with room for so much of its radius. */
  fit(isUpZ: boolean, room = 0.24): void {
    const { geometry } = this.mesh;
    geometry.computeBoundingBox();
    const radius = radiusOf(geometry.boundingBox!);
    this.isUpZ = isUpZ;
    this.isTurned = false;
    this.shown.copy(geometry.boundingBox!).expandByScalar(room * radius);
    this.show(radius);
  }

  /** Shows more where the mesh has moved out of the picture, unless somebody has chosen the view. */
  keepInView(): void {
    if (this.isTurned || this.shown.isEmpty()) return;
    const { geometry } = this.mesh;
    geometry.computeBoundingBox();
    if (this.shown.containsBox(geometry.boundingBox!)) return;
    this.shown.union(geometry.boundingBox!);
    this.show(radiusOf(this.shown));
  }

  private show(radius: number): void {
    const { isUpZ, shown: box } = this;
    const center = box.getCenter(new THREE.Vector3());
    const up = isUpZ ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0, 1, 0);
    this.camera.up.copy(up);
    // They ask for the upright axis when they are made.
    this.controls.dispose();
    this.controls = this.newControls();
    this.sky.position.copy(up);
    const axes = axesOf(isUpZ);
    const { clientWidth, clientHeight } = this.canvas;
    this.place();
    const share = 1 - Math.min(this.bottom / Math.max(1, clientHeight), 0.5);
    const { target, distance } = fitBox(box, center, axes, clientWidth / Math.max(1, clientHeight), share);
    this.camera.position.copy(target).addScaledVector(axes.backward, distance);
    this.camera.near = distance / 100;
    this.camera.far = distance + 100 * radius;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.update();
    this.refresh();
  }

  private newControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.addEventListener("change", () => this.refresh());
    controls.addEventListener("start", () => (this.isTurned = true));
    return controls;
  }

  /** Turns the view about the upright axis and to the top, in radians. */
  orbit(around: number, up: number): void {
    const { camera, controls } = this;
    this.isTurned = true;
    const offset = camera.position.clone().sub(controls.target);
    const side = new THREE.Vector3().crossVectors(camera.up, offset).normalize();
    offset.applyAxisAngle(camera.up, around).applyAxisAngle(side, up);
    camera.position.copy(controls.target).add(offset);
    controls.update();
  }

  zoom(by: number): void {
    this.isTurned = true;
    this.camera.position.sub(this.controls.target).multiplyScalar(by).add(this.controls.target);
    this.controls.update();
  }
}

const radiusOf = (box: THREE.Box3): number => box.getSize(new THREE.Vector3()).length() / 2 || 1;

interface Axes {
  right: THREE.Vector3;
  up: THREE.Vector3;
  backward: THREE.Vector3;
}

function axesOf(isUpZ: boolean): Axes {
  const [sin, cos] = [Math.sin(kAzimuth), Math.cos(kAzimuth)];
  const right = new THREE.Vector3(cos, 0, -sin);
  const backward = new THREE.Vector3(sin * Math.cos(kElevation), Math.sin(kElevation), cos * Math.cos(kElevation));
  const up = backward.clone().cross(right);
  if (isUpZ) for (const axis of [right, up, backward]) axis.set(axis.x, -axis.z, axis.y);
  return { right, up, backward };
}

/** A corner that lies (x, y, z) from the middle is in the picture from the distance d where |x - x0| <= slope (d - z); only a share of its height is used. */
function fitBox(
  box: THREE.Box3,
  center: THREE.Vector3,
  axes: Axes,
  aspect: number,
  share: number,
): { target: THREE.Vector3; distance: number } {
  const slopeY = Math.tan((kFieldOfView * Math.PI) / 360) / kMargin;
  const slopes = [slopeY * aspect, slopeY * share];
  const sides = [axes.right, axes.up];
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  const flatLow = [Infinity, Infinity];
  const flatHigh = [-Infinity, -Infinity];
  let nearest = -Infinity;
  for (let corner = 0; corner < 8; ++corner) {
    const pick = (bit: number, axis: "x" | "y" | "z"): number => (corner & bit ? box.max : box.min)[axis];
    const point = new THREE.Vector3(pick(1, "x"), pick(2, "y"), pick(4, "z")).sub(center);
    const z = point.dot(axes.backward);
    nearest = Math.max(nearest, z);
    sides.forEach((side, i) => {
      const place = point.dot(side);
      low[i] = Math.min(low[i]!, place - slopes[i]! * z);
      high[i] = Math.max(high[i]!, place + slopes[i]! * z);
      flatLow[i] = Math.min(flatLow[i]!, place);
      flatHigh[i] = Math.max(flatHigh[i]!, place);
    });
  }
  const distances = slopes.map((slope, i) => (high[i]! - low[i]!) / 2 / slope);
  const distance = Math.max(...distances, nearest + 1e-6);
  const target = center.clone();
  sides.forEach((side, i) => {
    // Where there is room left, the middle is about that of planes that are less steep, as ViewExtent has it.
    const flatHalf = (flatHigh[i]! - flatLow[i]!) / 2;
    const steepness = flatHalf / (distance - distances[i]! + flatHalf / slopes[i]!) / slopes[i]!;
    const [flat, steep] = [(flatLow[i]! + flatHigh[i]!) / 2, (low[i]! + high[i]!) / 2];
    target.addScaledVector(side, flat + (steep - flat) * (steepness || 0));
  });
  return { target, distance };
}
