import { type FeedHost, LocalHost, WorkerHost } from "../src/index.js";

type Open = Parameters<FeedHost["open"]>;

/** A worker of the page's own script; where none starts, the page's thread decodes. */
export class PageHost implements FeedHost {
  private host: FeedHost;
  /** What was asked before the worker showed that it lives. */
  private asked: Parameters<FeedHost["send"]>[0][] | undefined = [];

  constructor(script: string) {
    try {
      const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
      this.host = new WorkerHost(new Worker(address));
    } catch {
      this.host = new LocalHost();
    }
  }
  get load(): number {
    return this.host.load;
  }
  get isBroken(): boolean {
    return this.host.isBroken;
  }
  open(...[id, request, answer]: Open): void {
    this.host.open(id, request, (told) => {
      if (!this.host.isBroken || this.asked === undefined) {
        this.asked = undefined;
        return answer(told);
      }
      this.host = new LocalHost();
      this.host.open(id, request, answer);
      for (const asked of this.asked) this.host.send(asked);
      this.asked = undefined;
    });
  }
  send(request: Parameters<FeedHost["send"]>[0]): void {
    this.asked?.push(request);
    this.host.send(request);
  }
  dispose(): void {
    this.host.dispose();
  }
}
