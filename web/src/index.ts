export { type FetchOptions, type StreamSource } from "./byte_source.js";
export { Decoder } from "./decoder.js";
export { errorCodeName, TvgError, type TvgErrorCode } from "./errors.js";
export { type FeedHost, LocalHost, WorkerHost } from "./feed.js";
export { type FeedAttribute, type FeedFrame, type FeedMesh } from "./feed_messages.js";
export { compileModule, type ModuleSource, type TvgExports, TvgModule } from "./module.js";
export { type PlayerOptions, TvgPlayer } from "./player.js";
export { type StreamEvent, type StreamOptions, TvgStream } from "./stream.js";
export * from "./types.js";
