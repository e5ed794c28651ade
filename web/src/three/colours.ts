/** The importance overlay's colours, as `tvg render` has them, in sRGB. */
const kPlain = [0.62, 0.65, 0.69] as const;
const kImportant = [0.93, 0.45, 0.13] as const;

const kSteps = 4095;
let table: Float32Array | undefined;

function linearOf(value: number): number {
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

/** Colours of a stream, which are sRGB, as renderers want them: of linear light. Alpha stays. Into `to`. */
export function toLinear(colours: Float32Array, components: number, to: Float32Array): void {
  table ??= Float32Array.from({ length: kSteps + 1 }, (_, i) => linearOf(i / kSteps));
  const coloured = Math.min(components, 3);
  for (let i = 0; i < colours.length; i += components) {
    for (let c = 0; c < coloured; ++c) {
      const at = Math.min(Math.max(0, colours[i + c]!), 1) * kSteps;
      to[i + c] = table[Math.round(at)]!;
    }
    if (components === 4) to[i + 3] = colours[i + 3]!;
  }
}

/** The overlay's colour of each vertex, of linear light. */
export function importanceColours(flags: Uint8Array): Float32Array {
  const [plain, important] = [kPlain, kImportant].map((colour) => colour.map(linearOf)) as [number[], number[]];
  const colours = new Float32Array(3 * flags.length);
  flags.forEach((flag, vertex) => colours.set(flag ? important : plain, 3 * vertex));
  return colours;
}
