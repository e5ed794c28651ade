import type { FeedFrame, FeedMesh } from "./feed_messages.js";

export function isFrame(entry: FeedFrame | FeedMesh): entry is FeedFrame {
  return "positions" in entry;
}

/** Frames that wait to be shown, and the meshes that those behind them belong to. */
export class FrameQueue {
  private entries: (FeedFrame | FeedMesh)[] = [];

  push(entry: FeedFrame | FeedMesh): void {
    this.entries.push(entry);
  }
  get first(): FeedFrame | FeedMesh | undefined {
    return this.entries[0];
  }
  shift(): void {
    this.entries.shift();
  }
  get isEmpty(): boolean {
    return this.entries.length === 0;
  }
  get frameCount(): number {
    return this.entries.filter(isFrame).length;
  }

  /** The last frame of this time through the stream. */
  last(lap: number): FeedFrame | undefined {
    return this.entries.filter(isFrame).filter((frame) => frame.lap === lap).pop();
  }

  /** Drops all frames, and tells how many. The last mesh stays: frames to come belong to it. */
  clear(): number {
    return this.dropFirst(this.entries.length);
  }

  /** Drops frames before this one. */
  skipTo(frame: number): void {
    const index = this.entries.findIndex((entry) => isFrame(entry) && entry.number >= frame);
    this.dropFirst(index < 0 ? this.entries.length : index);
  }

  /** Drops the oldest frames until there are no more than so many, of so many bytes. */
  trim(frames: number, bytes: number): void {
    const { length } = this.entries;
    let keep = 0;
    for (let i = length - 1; i >= 0; --i) {
      const entry = this.entries[i]!;
      if (isFrame(entry) && (--frames < 0 || (bytes -= bytesOf(entry)) < 0)) break;
      ++keep;
    }
    if (keep < length) this.dropFirst(length - keep);
  }

  private dropFirst(count: number): number {
    const dropped = this.entries.splice(0, count);
    const mesh = dropped.filter((entry) => !isFrame(entry)).pop();
    if (mesh) this.entries.unshift(mesh);
    return dropped.filter(isFrame).length;
  }
}

function bytesOf({ positions, rows, normals, values }: FeedFrame): number {
  return [positions, rows, normals, ...(values ?? [])].reduce((sum, array) => sum + (array?.byteLength ?? 0), 0);
}
