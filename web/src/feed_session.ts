import { BasisFeed } from "./basis_feed.js";
import type { Decoder } from "./decoder.js";
import { asTvgError } from "./errors.js";
import type { FeedAnswer, FeedFrame, FeedRequest } from "./feed_messages.js";
import { LadderStream } from "./ladder.js";
import { TvgModule } from "./module.js";
import { type StreamOptions, TvgStream } from "./stream.js";
import type { AttributeInfo } from "./types.js";

type Post = (answer: FeedAnswer, transfer: Transferable[]) => void;
type OpenRequest = Extract<FeedRequest, { type: "open" }>;
type Stream = TvgStream | LadderStream;

/** Milliseconds between looks at what has been fetched. */
const kLook = 200;

/** One stream that is decoded ahead of who shows it, by as many frames as were asked for. Runs in a worker or not. */
export class FeedSession {
  private stream: Stream | undefined;
  private readonly abort = new AbortController();
  private asked = 0;
  private sought: number | undefined;
  private turn = 0;
  private lap = 0;
  private loops = false;
  private atEnd = false;
  private wake: (() => void) | undefined;
  private lastFrame = -1;
  private hasNormals = false;
  private vertexCount = 0;
  private animated: AttributeInfo[] = [];
  private sourceVertices = new Uint32Array();
  private wantsFlags = false;
  /** The group whose flags were told last; -1 for none. */
  private toldFlags = -1;
  private toldProgress = "";
  private readonly basis = new BasisFeed();

  constructor(
    private readonly request: OpenRequest,
    private readonly post: Post,
  ) {
    void this.run();
  }

  handle(request: FeedRequest): void {
    if (request.type === "take") this.asked += request.frames;
    if (request.type === "loop") this.loops = request.on;
    if (request.type === "flags") this.wantsFlags = request.on;
    if (request.type === "gpu") this.basis.limits = request.limits;
    if (request.type === "close") this.abort.abort(new Error("closed"));
    if (request.type === "seek") {
      this.sought = request.frame;
      this.turn = request.turn;
      this.lap = 0;
      this.toldFlags = -1;
      this.stream?.seek(request.frame);
      this.atEnd = false;
    }
    this.wake?.();
  }

  private async run(): Promise<void> {
    const { signal } = this.abort;
    const { id } = this.request;
    const look = setInterval(() => this.tellProgress(), kLook);
    // In Node nothing is to wait for it.
    (look as { unref?(): void }).unref?.();
    try {
      const stream = (this.stream = await this.open());
      if (signal.aborted) return;
      const index = stream.readIndex().then(
        (found) => found && !signal.aborted && this.tellLength(stream),
        () => undefined,
      );
      if (this.sought !== undefined) {
        await index;
        stream.seek(this.sought);
      }
      await this.play(stream);
    } catch (error) {
      if (!signal.aborted) {
        const { code, message } = asTvgError(error);
        this.post({ type: "error", id, code, message }, []);
      }
    } finally {
      clearInterval(look);
      this.stream?.dispose();
      this.stream = undefined;
    }
  }

  private async open(): Promise<Stream> {
    const { id, source, limits, headers, code, live, cacheBytes } = this.request;
    const options: StreamOptions = {
      module: await TvgModule.load(code),
      signal: this.abort.signal,
      // Pictures need not wait for it.
      index: false,
      onDamage: (damage) => this.post({ type: "damage", id, damage }, []),
      onData: (data) => this.post({ type: "data", id, data }, [data.bytes.buffer as ArrayBuffer]),
      ...(limits && { limits }),
      ...(headers && { headers }),
      ...(live && { live }),
      ...(cacheBytes !== undefined && { cacheBytes }),
    };
    const isLadder = typeof source === "string" && /\.json$/.test(new URL(source).pathname);
    return isLadder ? LadderStream.open(source, options) : TvgStream.open(source, options);
  }

  private async play(stream: Stream): Promise<void> {
    let toldHead = false;
    while (!this.abort.signal.aborted) {
      if ((this.asked <= 0 && !this.request.live) || this.atEnd) {
        await new Promise<void>((resolve) => (this.wake = resolve));
        // A loop that is switched on at the end goes on from there.
        if (this.atEnd && this.loops) this.startOver(stream);
        continue;
      }
      const event = await stream.next();
      // What a seek overtook is there no more; a mesh still is.
      if (!stream.isAtHand && event !== "mesh") continue;
      if (this.abort.signal.aborted) return;
      if (!toldHead) this.tellHead(stream);
      toldHead = true;
      if (event === "mesh") this.tellMesh(stream);
      if (event === "frame") this.tellFrame(stream);
      if (event === "end") this.finish(stream);
    }
  }

  private tellHead({ decoder, frameRate }: Stream): void {
    const { id } = this.request;
    this.post({ type: "head", id, info: decoder.stream(), frameRate, metadata: [...decoder.metadata()] }, []);
  }

  private tellLength({ frameCount }: Stream): void {
    if (frameCount !== undefined) this.post({ type: "length", id: this.request.id, frameCount }, []);
  }

  private tellProgress(): void {
    if (this.stream === undefined || this.abort.signal.aborted) return;
    const progress = this.stream.progress();
    const told = JSON.stringify(progress);
    if (told !== this.toldProgress) this.post({ type: "progress", id: this.request.id, progress }, []);
    this.toldProgress = told;
  }

  private tellMesh({ decoder }: Stream): void {
    const view = decoder.view();
    const all = decoder.attributes();
    const attributes = all.map((attribute) => {
      const { kind, name, components, animated } = attribute;
      const values = new Float32Array(components * view.vertexCount);
      if (!animated) decoder.copyViewAttribute(attribute, values);
      return { kind, name, components, animated, values };
    });
    this.animated = all.filter(({ animated }) => animated);
    this.hasNormals = all.some(({ kind }) => kind === "normal");
    this.vertexCount = view.vertexCount;
    this.sourceVertices = view.sourceVertices.slice();
    this.toldFlags = -1;
    this.basis.forget();
    const mesh = { ...view, parts: decoder.parts(), attributes };
    this.post({ type: "mesh", id: this.request.id, mesh }, []);
  }

  private tellFrame({ decoder, frameNumber }: Stream): void {
    const gop = decoder.gop().firstFrame;
    const frame: FeedFrame = {
      turn: this.turn,
      lap: this.lap,
      number: frameNumber,
      gop,
      ...(this.rowsOf(decoder) ?? this.positionsOf(decoder)),
    };
    if (this.animated.length > 0) frame.values = this.animated.map((attribute) => this.valuesOf(decoder, attribute));
    if (this.wantsFlags && this.toldFlags !== gop) frame.flags = this.flagsOf(decoder);
    this.toldFlags = this.wantsFlags ? gop : -1;
    --this.asked;
    this.lastFrame = Math.max(this.lastFrame, frameNumber);
    const arrays = [frame.positions, frame.rows, frame.normals, frame.flags, ...(frame.values ?? [])];
    const transfer = arrays.flatMap((array) => (array ? [array.buffer as ArrayBuffer] : []));
    this.post({ type: "frame", id: this.request.id, frame }, transfer);
  }

  private positionsOf(decoder: Decoder): Pick<FeedFrame, "positions" | "normals"> {
    const positions = new Float32Array(3 * this.vertexCount);
    decoder.copyViewPositions(positions);
    if (this.hasNormals) return { positions };
    const normals = new Float32Array(positions.length);
    decoder.computeViewNormals(normals);
    return { positions, normals };
  }

  /** Where a GPU makes the frame; its planes are told first where they are others. */
  private rowsOf(decoder: Decoder): Pick<FeedFrame, "positions" | "rows"> | undefined {
    const basis = this.basis.takes(decoder);
    if (!basis) return undefined;
    if (this.basis.isNews(decoder, basis)) {
      const planes = this.basis.planes(decoder, basis, this.positionsOf(decoder));
      this.post({ type: "planes", id: this.request.id, planes }, [planes.coefficients.buffer as ArrayBuffer]);
    }
    return { positions: new Float32Array(0), rows: this.basis.rows(decoder, basis) };
  }

  private valuesOf(decoder: Decoder, attribute: AttributeInfo): Float32Array {
    const values = new Float32Array(attribute.components * this.vertexCount);
    decoder.copyViewAttribute(attribute, values);
    return values;
  }

  private flagsOf(decoder: Decoder): Uint8Array {
    const flags = new Uint8Array(decoder.mesh().vertexCount);
    decoder.copyFlags(flags);
    return Uint8Array.from(this.sourceVertices, (vertex) => flags[vertex]!);
  }

  private finish(stream: Stream): void {
    const frameCount = stream.frameCount ?? this.lastFrame + 1;
    this.post({ type: "end", id: this.request.id, turn: this.turn, frameCount }, []);
    this.atEnd = true;
    if (this.loops && frameCount > 0) this.startOver(stream);
  }

  private startOver(stream: Stream): void {
    ++this.lap;
    this.atEnd = false;
    stream.seek(0);
  }
}
