/** Of a chunk, before and behind its payload. */
const kChunkHeaderBytes = 16;
const kChecksumBytes = 4;
const kMesh = 1;
const kPlan = 2;
const kGop = 3;
const kDependentGop = 4;

interface Chunk {
  from: number;
  to: number;
}
interface Gop {
  first: number;
  end: number;
  needs: Chunk[];
}

/** Which bytes of a stream frames need, by its index (format-spec §4.6), which the decoder has found good. */
export class FrameTable {
  private readonly gops: Gop[] = [];

  /** `index` is the index chunk, which lies at `offset`. */
  constructor(index: Uint8Array, offset: number) {
    const reader = new Varints(index.subarray(kChunkHeaderBytes, index.length - kChecksumBytes));
    const chunks: Chunk[] = [];
    const named: Record<number, Chunk[]> = { [kMesh]: [], [kPlan]: [] };
    let frames = 0;
    let place = 0;
    for (let entries = reader.next(); entries > 0; --entries) {
      const kind = reader.next();
      place += reader.next();
      const fields = new Varints(reader.take(reader.next()));
      if (chunks.length > 0) chunks[chunks.length - 1]!.to = place;
      const chunk = { from: place, to: offset };
      chunks.push(chunk);
      named[kind]?.push(chunk);
      if (kind !== kGop && kind !== kDependentGop) continue;
      const first = frames;
      frames += fields.next();
      const needs = [chunk, back(named[kMesh]!, fields.next())];
      for (let planes = fields.next(); planes > 0; --planes) needs.push(back(named[kPlan]!, fields.next()));
      this.gops.push({ first, end: frames, needs: needs.filter((need) => need !== undefined) as Chunk[] });
    }
  }

  /** Frames of which all bytes are among these, as [first, end) in order. */
  framesOf(bytes: [number, number][]): [number, number][] {
    const isThere = ({ from, to }: Chunk): boolean => bytes.some(([first, end]) => first <= from && to <= end);
    const ranges: [number, number][] = [];
    for (const { first, end, needs } of this.gops) {
      if (!needs.every(isThere)) continue;
      const last = ranges[ranges.length - 1];
      if (last && last[1] === first) last[1] = end;
      else ranges.push([first, end]);
    }
    return ranges;
  }

  /** Where the first frames end: what is to come before a picture is there for certain. */
  get firstBytes(): number | undefined {
    return this.gops[0]?.needs[0]?.to;
  }
}

function back(chunks: Chunk[], entries: number): Chunk | undefined {
  return chunks[chunks.length - entries];
}

class Varints {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}
  /** 0 behind the end. */
  next(): number {
    let value = 0;
    for (let unit = 1; this.at < this.bytes.length; unit *= 128) {
      const byte = this.bytes[this.at++]!;
      value += (byte & 127) * unit;
      if (byte < 128) break;
    }
    return value;
  }
  take(count: number): Uint8Array {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
}
