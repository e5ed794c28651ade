interface Piece {
  from: number;
  bytes: Uint8Array;
}

/** Pieces of a stream that were fetched, by their place. When it is full, what is farthest from the reader goes. */
export class ByteCache {
  /** In order, without overlaps. */
  private readonly pieces: Piece[] = [];
  private used = 0;

  constructor(
    /** Bytes at most. */
    private readonly limit: number,
  ) {}

  /** What is there from `offset` on, up to the end of its piece. */
  at(offset: number): Uint8Array | undefined {
    const piece = this.pieces[this.indexOf(offset)];
    return piece && offset < endOf(piece) ? piece.bytes.subarray(offset - piece.from) : undefined;
  }

  /** The first place from `offset` on that is not there. */
  firstGap(offset: number): number {
    for (let i = this.indexOf(offset); i >= 0 && i < this.pieces.length; ++i) {
      const piece = this.pieces[i]!;
      if (piece.from > offset || endOf(piece) <= offset) break;
      offset = endOf(piece);
    }
    return offset;
  }

  /** Keeps what is not there yet of some bytes; `reader` is where they are read. */
  add(from: number, bytes: Uint8Array, reader: number): void {
    for (const end = from + bytes.length; from < end; ) {
      const start = this.firstGap(from);
      if (start >= end) break;
      const index = this.indexOf(start) + 1;
      const stop = Math.min(end, this.pieces[index]?.from ?? end);
      this.pieces.splice(index, 0, { from: start, bytes: bytes.subarray(bytes.length - (end - start), bytes.length - (end - stop)) });
      this.used += stop - start;
      from = stop;
    }
    while (this.used > this.limit && this.pieces.length > 1) this.dropFarthest(reader);
  }

  /** What is there, as [from, to) in order. */
  ranges(): [number, number][] {
    const ranges: [number, number][] = [];
    for (const piece of this.pieces) {
      const last = ranges[ranges.length - 1];
      if (last && last[1] === piece.from) last[1] = endOf(piece);
      else ranges.push([piece.from, endOf(piece)]);
    }
    return ranges;
  }

  /** The last piece that begins at or before `offset`; -1 where there is none. */
  private indexOf(offset: number): number {
    let low = 0;
    let high = this.pieces.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.pieces[middle]!.from <= offset) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** One of the two ends is the farthest, since pieces are in order. */
  private dropFarthest(reader: number): void {
    const first = this.pieces[0]!;
    const last = this.pieces[this.pieces.length - 1]!;
    const dropped = reader - endOf(first) >= last.from - reader ? this.pieces.shift()! : this.pieces.pop()!;
    this.used -= dropped.bytes.length;
  }
}

function endOf(piece: Piece): number {
  return piece.from + piece.bytes.length;
}
