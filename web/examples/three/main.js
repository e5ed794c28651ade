// A mesh that plays, beside anything else of a scene. No bundler: index.html maps the packages.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { TVGLoader } from "tvg/three";

const renderer = new THREE.WebGLRenderer({ antialias: true });
document.body.append(renderer.domElement);
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
const controls = new OrbitControls(camera, renderer.domElement);
const scene = new THREE.Scene();
scene.add(new THREE.HemisphereLight(0xffffff, 0x445566, 3));

const loader = new TVGLoader().preload();
const mesh = await loader.loadAsync(new URLSearchParams(location.search).get("stream") ?? "clip.tvg");
mesh.addEventListener("damage", () => console.warn("some frames are lost"));
mesh.addEventListener("error", () => console.error(mesh.player.error));
scene.add(mesh);

// The first frame is there: the camera looks at it from a distance that shows all of it.
mesh.geometry.computeBoundingSphere();
const { center, radius } = mesh.geometry.boundingSphere;
controls.target.copy(center);
camera.position.set(0.5, 0.35, 1).setLength(3.1 * radius).add(center);
camera.near = radius / 100;
camera.far = radius * 100;

function resize() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();

mesh.loop = true;
mesh.play();
renderer.setAnimationLoop((now) => {
  mesh.update(now);
  controls.update();
  renderer.render(scene, camera);
});
Object.assign(globalThis, { mesh });
