/** Of one measurement at least. */
const kWindowBytes = 1 << 14;
const kWindowSeconds = 0.05;
/** After so many seconds of receiving an older measurement counts half: in what follows soon, and in what stays calm. */
const kHalfLives = [1, 4];
/** What may have been buffered while nobody read, and then comes faster than the line is. */
const kBufferedBytes = 1 << 20;
const kAtOnceSeconds = 0.001;

/** How fast a line is: the lesser of two averages that forget, so that what becomes slow is seen soon. */
export class Throughput {
  private bytes = 0;
  private seconds = 0;
  private readonly averages = kHalfLives.map((halfLife) => ({ halfLife, sum: 0, weight: 0 }));
  private buffered = 0;
  private waiting = 0;
  private since = 0;

  /** Bytes are waited for; to be called once for each `came`. Several connections may share the line. */
  wait(now = performance.now()): void {
    if (this.waiting++ === 0) this.since = now;
  }
  /** So many came, or none where the wait came to nothing. */
  came(bytes: number, now = performance.now()): void {
    --this.waiting;
    this.add(bytes, (now - this.since) / 1000);
    this.since = now;
  }

  /** Bytes that came, and how long they were waited for. */
  add(bytes: number, seconds: number): void {
    if (seconds < kAtOnceSeconds && (this.buffered -= bytes) > 0) return;
    this.buffered = 0;
    this.bytes += bytes;
    this.seconds += seconds;
    if (this.seconds < kWindowSeconds || this.bytes < kWindowBytes) return;
    for (const average of this.averages) {
      const keep = 0.5 ** (this.seconds / average.halfLife);
      average.sum = keep * average.sum + (1 - keep) * (this.bytes / this.seconds);
      average.weight = keep * average.weight + (1 - keep);
    }
    this.bytes = this.seconds = 0;
  }

  /** For a while nobody reads, unless another does. */
  pause(): void {
    if (this.waiting > 0) return;
    this.bytes = this.seconds = 0;
    this.buffered = kBufferedBytes;
  }

  /** Undefined until enough has come. */
  get bytesPerSecond(): number | undefined {
    if (this.averages[0]!.weight === 0) return undefined;
    return Math.min(...this.averages.map(({ sum, weight }) => sum / weight));
  }
}
