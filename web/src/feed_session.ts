import { asTvgError } from "./errors.js";
import type { FeedAnswer, FeedRequest } from "./feed_messages.js";
import { TvgModule } from "./module.js";
import { TvgStream } from "./stream.js";

type Post = (answer: FeedAnswer, transfer: Transferable[]) => void;
type OpenRequest = Extract<FeedRequest, { type: "open" }>;

/** One stream that is decoded ahead of who shows it, by as many frames as were asked for. Runs in a worker or not. */
export class FeedSession {
  private stream: TvgStream | undefined;
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

  constructor(
    private readonly request: OpenRequest,
    private readonly post: Post,
  ) {
    void this.run();
  }

  handle(request: FeedRequest): void {
    if (request.type === "take") this.asked += request.frames;
    if (request.type === "loop") this.loops = request.on;
    if (request.type === "close") this.abort.abort(new Error("closed"));
    if (request.type === "seek") {
      this.sought = request.frame;
      this.turn = request.turn;
      this.lap = 0;
      this.stream?.seek(request.frame);
      this.atEnd = false;
    }
    this.wake?.();
  }

  private async run(): Promise<void> {
    const { signal } = this.abort;
    try {
      const { id, source, limits, headers, code } = this.request;
      this.stream = await TvgStream.open(source, {
        module: await TvgModule.load(code),
        signal,
        onDamage: (damage) => this.post({ type: "damage", id, damage }, []),
        ...(limits ? { limits } : {}),
        ...(headers ? { headers } : {}),
      });
      if (this.sought !== undefined) this.stream.seek(this.sought);
      await this.play(this.stream);
    } catch (error) {
      if (!signal.aborted) {
        const { code, message } = asTvgError(error);
        this.post({ type: "error", id: this.request.id, code, message }, []);
      }
    } finally {
      this.stream?.dispose();
    }
  }

  private async play(stream: TvgStream): Promise<void> {
    let toldHead = false;
    while (!this.abort.signal.aborted) {
      if (this.asked <= 0 || this.atEnd) {
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

  private tellHead({ decoder, frameRate }: TvgStream): void {
    const { id } = this.request;
    this.post({ type: "head", id, info: decoder.stream(), frameRate, metadata: [...decoder.metadata()] }, []);
  }

  private tellMesh({ decoder }: TvgStream): void {
    const view = decoder.view();
    const attributes = decoder
      .attributes()
      .filter((attribute) => !attribute.animated)
      .map((attribute) => {
        const values = new Float32Array(attribute.components * view.vertexCount);
        decoder.copyViewAttribute(attribute, values);
        return { kind: attribute.kind, name: attribute.name, components: attribute.components, values };
      });
    this.hasNormals = attributes.some(({ kind }) => kind === "normal");
    this.vertexCount = view.vertexCount;
    const mesh = { ...view, parts: decoder.parts(), attributes };
    this.post({ type: "mesh", id: this.request.id, mesh }, []);
  }

  private tellFrame({ decoder, frameNumber }: TvgStream): void {
    const positions = new Float32Array(3 * this.vertexCount);
    decoder.copyViewPositions(positions);
    const frame = { turn: this.turn, lap: this.lap, number: frameNumber, positions };
    const transfer = [positions.buffer as ArrayBuffer];
    --this.asked;
    this.lastFrame = Math.max(this.lastFrame, frameNumber);
    if (this.hasNormals) return this.post({ type: "frame", id: this.request.id, frame }, transfer);
    const normals = new Float32Array(positions.length);
    decoder.computeViewNormals(normals);
    transfer.push(normals.buffer as ArrayBuffer);
    this.post({ type: "frame", id: this.request.id, frame: { ...frame, normals } }, transfer);
  }

  private finish(stream: TvgStream): void {
    const frameCount = stream.frameCount ?? this.lastFrame + 1;
    this.post({ type: "end", id: this.request.id, turn: this.turn, frameCount }, []);
    this.atEnd = true;
    if (this.loops && frameCount > 0) this.startOver(stream);
  }

  private startOver(stream: TvgStream): void {
    ++this.lap;
    this.atEnd = false;
    stream.seek(0);
  }
}
