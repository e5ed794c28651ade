/** Of one measurement at least. */
const kWindowBytes = 1 << 16;
const kWindowSeconds = 0.05;
/** After so many seconds of receiving an older measurement counts half. */
const kHalfLife = 3;
/** What may have been buffered while nobody read, and then comes faster than the line is. */
const kBufferedBytes = 1 << 20;
const kAtOnceSeconds = 0.001;

/** How fast a line is: an average that forgets. */
export class Throughput {
  private bytes = 0;
  private seconds = 0;
  private average = 0;
  private weight = 0;
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
    const keep = 0.5 ** (this.seconds / kHalfLife);
    this.average = keep * this.average + (1 - keep) * (this.bytes / this.seconds);
    this.weight = keep * this.weight + (1 - keep);
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
    return this.weight > 0 ? this.average / this.weight : undefined;
  }
}
