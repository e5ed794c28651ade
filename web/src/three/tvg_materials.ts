import * as THREE from "three";
import type { FreeFormData } from "../types.js";
import { pictureOf, unpack } from "./tvg_data.js";

interface TextureInfo {
  index?: number;
  texCoord?: number;
  scale?: number;
  strength?: number;
}
/** As glTF 2.0 has it; nothing of it is sure to be there. */
interface MaterialInfo {
  name?: string;
  pbrMetallicRoughness?: {
    baseColorFactor?: number[];
    baseColorTexture?: TextureInfo;
    metallicFactor?: number;
    roughnessFactor?: number;
    metallicRoughnessTexture?: TextureInfo;
  };
  normalTexture?: TextureInfo;
  occlusionTexture?: TextureInfo;
  emissiveTexture?: TextureInfo;
  emissiveFactor?: number[];
  alphaMode?: string;
  alphaCutoff?: number;
  doubleSided?: boolean;
  extensions?: { KHR_materials_emissive_strength?: { emissiveStrength?: number } };
}
interface SamplerInfo {
  wrapS?: number;
  wrapT?: number;
  magFilter?: number;
  minFilter?: number;
}
interface MaterialsInfo {
  materials?: MaterialInfo[];
  textures?: { source?: number; sampler?: number }[];
  images?: { extras?: { data?: string } }[];
  samplers?: SamplerInfo[];
}

const kWrappings: Record<number, THREE.Wrapping> = {
  10497: THREE.RepeatWrapping,
  33071: THREE.ClampToEdgeWrapping,
  33648: THREE.MirroredRepeatWrapping,
};
const kFilters: Record<number, THREE.MinificationTextureFilter> = {
  9728: THREE.NearestFilter,
  9729: THREE.LinearFilter,
  9984: THREE.NearestMipmapNearestFilter,
  9985: THREE.LinearMipmapNearestFilter,
  9986: THREE.NearestMipmapLinearFilter,
  9987: THREE.LinearMipmapLinearFilter,
};

/** Makes three's materials of what goes along with a stream as "materials" and "image/NAME" (docs/formats.md). */
export class TVGMaterials {
  private described: Promise<MaterialsInfo> | undefined;
  private describedBy: FreeFormData | undefined;
  private readonly textures = new Map<string, Promise<THREE.Texture | undefined>>();
  private pending: Promise<unknown> = Promise.resolve();
  private disposed = false;

  /** `data` by their names, as they come. */
  constructor(private readonly data: ReadonlyMap<string, FreeFormData>) {}

  /** Until every material that was asked for is what it is described as, with its pictures. */
  get ready(): Promise<unknown> {
    return this.pending;
  }

  /** A material of this name; plain at first, and where there is none of the name. The caller disposes of it. */
  make(name: string, coloured: boolean): THREE.MeshStandardMaterial {
    const color = coloured || this.data.has("materials") ? 0xffffff : 0xb8b8c0;
    const material = new THREE.MeshStandardMaterial({ name, color, roughness: 0.75, side: THREE.DoubleSide });
    material.vertexColors = coloured;
    const done = this.describe(material).catch((error) => console.warn(`material ${name}: ${(error as Error).message}`));
    this.pending = Promise.all([this.pending, done]);
    return material;
  }

  /** Gives the pictures back. */
  dispose(): void {
    this.disposed = true;
    for (const texture of this.textures.values()) void texture.then(release);
    this.textures.clear();
  }

  private async describe(material: THREE.MeshStandardMaterial): Promise<void> {
    const all = await this.info();
    const info = list(all.materials).find(({ name }) => name === material.name);
    if (!info || this.disposed) return;
    takeNumbers(material, info);
    const surface = info.pbrMetallicRoughness ?? {};
    const set = async (slot: Slot, texture: TextureInfo | undefined, isColour: boolean): Promise<void> => {
      const made = await this.texture(all, texture, isColour);
      if (made && !this.disposed) material[slot] = made;
    };
    await Promise.all([
      set("map", surface.baseColorTexture, true),
      set("metalnessMap", surface.metallicRoughnessTexture, false),
      set("roughnessMap", surface.metallicRoughnessTexture, false),
      set("normalMap", info.normalTexture, false),
      set("aoMap", info.occlusionTexture, false),
      set("emissiveMap", info.emissiveTexture, true),
    ]);
    material.needsUpdate = true;
  }

  private info(): Promise<MaterialsInfo> {
    const data = this.data.get("materials");
    if (!data) return Promise.resolve({});
    if (data !== this.describedBy || !this.described) {
      this.describedBy = data;
      this.described = unpack(data).then((bytes) => JSON.parse(new TextDecoder().decode(bytes)) as MaterialsInfo);
    }
    return this.described;
  }

  /** One for each use of a picture; undefined where the stream does not have it. Nothing is fetched. */
  private texture(all: MaterialsInfo, info: TextureInfo | undefined, isColour: boolean): Promise<THREE.Texture | undefined> {
    const described = list(all.textures)[info?.index ?? -1];
    const data = this.data.get(list(all.images)[described?.source ?? -1]?.extras?.data ?? "");
    if (!data) return Promise.resolve(undefined);
    const channel = Math.min(Math.max(0, Math.floor(info?.texCoord ?? 0)), 3);
    const key = [info!.index, channel, isColour].join();
    let made = this.textures.get(key);
    if (!made) {
      const sampler = list(all.samplers)[described?.sampler ?? -1] ?? {};
      made = pictureOf(data).then((picture) => newTexture(picture, sampler, channel, isColour));
      this.textures.set(key, made);
    }
    return made;
  }
}

type Slot = "map" | "metalnessMap" | "roughnessMap" | "normalMap" | "aoMap" | "emissiveMap";

/** An array that a stranger's JSON has, or not. */
function list<T extends object>(values: T[] | undefined): Partial<T>[] {
  return Array.isArray(values) ? values.map((value) => (typeof value === "object" && value !== null ? value : {})) : [];
}

function number(value: unknown, otherwise: number): number {
  return typeof value === "number" && Number.isFinite(value) ? value : otherwise;
}

function takeNumbers(material: THREE.MeshStandardMaterial, info: Partial<MaterialInfo>): void {
  const surface = info.pbrMetallicRoughness;
  const [red, green, blue, alpha] = [0, 1, 2, 3].map((i) => number(surface?.baseColorFactor?.[i], 1));
  material.color.setRGB(red!, green!, blue!, THREE.LinearSRGBColorSpace);
  // What says nothing of its surface is hardly meant to be metal, which is glTF's word for nothing.
  material.metalness = surface ? number(surface.metallicFactor, 1) : 0;
  material.roughness = number(surface?.roughnessFactor, surface ? 1 : 0.75);
  const [r, g, b] = [0, 1, 2].map((i) => number(info.emissiveFactor?.[i], 0));
  material.emissive.setRGB(r!, g!, b!, THREE.LinearSRGBColorSpace);
  material.emissiveIntensity = number(info.extensions?.KHR_materials_emissive_strength?.emissiveStrength, 1);
  const scale = number(info.normalTexture?.scale, 1);
  material.normalScale.set(scale, scale);
  material.aoMapIntensity = number(info.occlusionTexture?.strength, 1);
  // Both sides are drawn unless a material asks for one: not all importers know.
  material.side = info.doubleSided === false ? THREE.FrontSide : THREE.DoubleSide;
  material.transparent = info.alphaMode === "BLEND";
  material.depthWrite = !material.transparent;
  material.opacity = material.transparent ? alpha! : 1;
  material.alphaTest = info.alphaMode === "MASK" ? number(info.alphaCutoff, 0.5) : 0;
}

function newTexture(picture: ImageBitmap, sampler: SamplerInfo, channel: number, isColour: boolean): THREE.Texture {
  const texture = new THREE.Texture(picture);
  texture.wrapS = kWrappings[sampler.wrapS ?? 0] ?? THREE.RepeatWrapping;
  texture.wrapT = kWrappings[sampler.wrapT ?? 0] ?? THREE.RepeatWrapping;
  texture.magFilter = sampler.magFilter === 9728 ? THREE.NearestFilter : THREE.LinearFilter;
  texture.minFilter = kFilters[sampler.minFilter ?? 0] ?? THREE.LinearMipmapLinearFilter;
  texture.channel = channel;
  if (isColour) texture.colorSpace = THREE.SRGBColorSpace;
  // A bitmap's first row is the last of a texture, whose v points up: it was turned when it was made.
  texture.flipY = false;
  texture.needsUpdate = true;
  return texture;
}

function release(texture: THREE.Texture | undefined): void {
  texture?.dispose();
  (texture?.image as ImageBitmap | undefined)?.close();
}
