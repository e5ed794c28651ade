import type { Decoder } from "./decoder.js";
import type { FeedPlanes, GpuLimits } from "./feed_messages.js";
import type { BasisInfo } from "./types.js";

/** What every WebGL2 has. */
export const kLeastGpuLimits: GpuLimits = { textureSize: 2048, layers: 256, components: 256 };

/** Texels of a layer that has one for each vertex: about as many each way, in whole powers of two across. */
export function texelsFor(count: number): { width: number; height: number } {
  const width = 2 ** Math.ceil(Math.log2(Math.max(1, Math.sqrt(count))));
  return { width, height: Math.max(1, Math.ceil(count / width)) };
}

/** Which planes whoever draws has, and what he needs of a frame beside them. */
export class BasisFeed {
  /** Undefined while frames are wanted as positions. */
  limits: GpuLimits | undefined;
  private decoder: Decoder | undefined;
  private number = 0;

  /** Whether the GPU makes the frame at hand. */
  takes(decoder: Decoder): BasisInfo | undefined {
    const basis = this.limits && decoder.basis();
    if (!this.limits || !basis) return undefined;
    const { width, height } = texelsFor(basis.vertexCount);
    const fits =
      basis.vertexCount > 0 &&
      basis.components > 0 &&
      basis.components <= this.limits.components &&
      Math.ceil(basis.components / 4) <= this.limits.layers &&
      Math.max(width, height) <= this.limits.textureSize;
    return fits ? basis : undefined;
  }

  /** Whether the planes of such a frame were not told last; they are from now on. */
  isNews(decoder: Decoder, { number }: BasisInfo): boolean {
    if (decoder === this.decoder && number === this.number) return false;
    this.decoder = decoder;
    this.number = number;
    return true;
  }

  /** The planes of such a frame, and the frame as it is without a GPU. */
  planes(decoder: Decoder, basis: BasisInfo, frame: Pick<FeedPlanes, "positions" | "normals">): FeedPlanes {
    const { components, vertexCount } = basis;
    const { width, height } = texelsFor(vertexCount);
    const layers = Math.ceil(components / 4);
    const size = 4 * width * height;
    const coefficients = new (basis.most < 32768 ? Int16Array : Float32Array)(layers * size);
    const most = new Float32Array(4 * layers);
    for (let layer = 0; layer < layers; ++layer) {
      const values = coefficients.subarray(layer * size, layer * size + 4 * vertexCount);
      decoder.copyPlanes(layer, values);
      for (let i = 0; i < values.length; ++i) {
        const at = 4 * layer + (i & 3);
        most[at] = Math.max(most[at]!, Math.abs(values[i]!));
      }
    }
    const shape = { components, vertexCount, width, height, layers };
    return { ...shape, coefficients, most: most.slice(0, components), rows: this.rows(decoder, basis), ...frame };
  }

  rows(decoder: Decoder, { components }: BasisInfo): Float32Array {
    const rows = new Float32Array(3 * (1 + components));
    decoder.copyRows(rows);
    return rows;
  }

  /** Whoever draws has none any more. */
  forget(): void {
    this.decoder = undefined;
  }
}

/** No vertex is further away along an axis from where the planes' first frame has it: [xyz]. */
export function farthestFrom({ most, rows: first }: FeedPlanes, rows: Float32Array): [number, number, number] {
  const along = (axis: number): number => {
    let far = Math.abs(rows[axis]! - first[axis]!);
    for (let a = 0, at = 3 + axis; a < most.length; ++a, at += 3) far += most[a]! * Math.abs(rows[at]! - first[at]!);
    return far;
  };
  return [along(0), along(1), along(2)];
}
