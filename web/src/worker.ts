import type { FeedAnswer, FeedRequest } from "./feed_messages.js";
import { FeedSession } from "./feed_session.js";

/** What a worker has of its global object, without the library of types that pages exclude. */
interface WorkerScope {
  onmessage: ((event: MessageEvent<FeedRequest>) => void) | null;
  postMessage(message: FeedAnswer, transfer: Transferable[]): void;
}

const scope = globalThis as unknown as WorkerScope;
const sessions = new Map<number, FeedSession>();

scope.onmessage = ({ data }) => {
  if (data.type === "open") {
    sessions.set(data.id, new FeedSession(data, (answer, transfer) => scope.postMessage(answer, transfer)));
    return;
  }
  sessions.get(data.id)?.handle(data);
  if (data.type === "close") sessions.delete(data.id);
};
