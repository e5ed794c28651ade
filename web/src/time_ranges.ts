/** Stretches of time in order, in seconds, as HTMLMediaElement has them. */
export interface TimeRangesLike {
  readonly length: number;
  start(index: number): number;
  end(index: number): number;
}

export class FrameTimeRanges implements TimeRangesLike {
  /** `frames` as [first, end) in any order; those that touch become one. */
  constructor(
    frames: [number, number][],
    private readonly frameRate: number,
  ) {
    for (const [first, end] of [...frames].sort(([a], [b]) => a - b)) {
      const last = this.ranges[this.ranges.length - 1];
      if (last && first <= last[1]) last[1] = Math.max(last[1], end);
      else if (first < end) this.ranges.push([first, end]);
    }
  }
  private readonly ranges: [number, number][] = [];

  get length(): number {
    return this.ranges.length;
  }
  start(index: number): number {
    return this.at(index)[0] / this.frameRate;
  }
  end(index: number): number {
    return this.at(index)[1] / this.frameRate;
  }
  private at(index: number): [number, number] {
    const range = this.ranges[index];
    if (!range) throw new RangeError(`there are ${this.ranges.length} ranges, none of number ${index}`);
    return range;
  }
}
