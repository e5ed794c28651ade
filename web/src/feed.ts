import type { FeedAnswer, FeedRequest } from "./feed_messages.js";
import { FeedSession } from "./feed_session.js";

/** Something that decodes streams: a worker, or this thread. */
export interface FeedHost {
  /** How many streams it has open. */
  readonly load: number;
  /** Whether nothing can be opened any more. */
  readonly isBroken: boolean;
  open(id: number, request: Extract<FeedRequest, { type: "open" }>, answer: (answer: FeedAnswer) => void): void;
  send(request: FeedRequest): void;
  dispose(): void;
}

let lastId = 0;
/** A number for a stream that no other of this thread has. */
export function nextFeedId(): number {
  return ++lastId;
}

/** Decodes on the calling thread: where there are no workers, and in Node. */
export class LocalHost implements FeedHost {
  private readonly sessions = new Map<number, FeedSession>();
  readonly isBroken = false;
  get load(): number {
    return this.sessions.size;
  }
  open(id: number, request: Extract<FeedRequest, { type: "open" }>, answer: (answer: FeedAnswer) => void): void {
    this.sessions.set(id, new FeedSession(request, answer));
  }
  send(request: FeedRequest): void {
    this.sessions.get(request.id)?.handle(request);
    if (request.type === "close") this.sessions.delete(request.id);
  }
  dispose(): void {
    for (const id of [...this.sessions.keys()]) this.send({ type: "close", id });
  }
}

/** Decodes in a worker. */
export class WorkerHost implements FeedHost {
  private readonly answers = new Map<number, (answer: FeedAnswer) => void>();
  /** Why the worker does nothing any more. */
  private broken: string | undefined;

  constructor(private readonly worker: Worker) {
    worker.onmessage = ({ data }: MessageEvent<FeedAnswer>) => this.answers.get(data.id)?.(data);
    worker.onerror = (event) => {
      const message = (this.broken = event.message || "the worker could not be started");
      for (const [id, answer] of this.answers) answer({ type: "error", id, code: "io", message });
    };
  }
  get load(): number {
    return this.answers.size;
  }
  get isBroken(): boolean {
    return this.broken !== undefined;
  }
  open(id: number, request: Extract<FeedRequest, { type: "open" }>, answer: (answer: FeedAnswer) => void): void {
    if (this.broken !== undefined) return answer({ type: "error", id, code: "io", message: this.broken });
    this.answers.set(id, answer);
    this.worker.postMessage(request);
  }
  send(request: FeedRequest): void {
    this.worker.postMessage(request);
    if (request.type === "close") this.answers.delete(request.id);
  }
  dispose(): void {
    this.worker.terminate();
    this.answers.clear();
  }
}
