/**
 * Names of what can go wrong, as `tvg_code_name` has them. The decoder's own say what is wrong with a stream;
 * `io` is what the network or a file gave.
 */
export type TvgErrorCode =
  | "invalid-argument"
  | "invalid-input"
  | "wrong-state"
  | "not-tvg"
  | "unsupported-version"
  | "truncated"
  | "checksum-mismatch"
  | "malformed"
  | "digest-mismatch"
  | "unsupported"
  | "limit-exceeded"
  | "out-of-memory"
  | "io"
  | "unknown";

const kNames: ReadonlyMap<number, TvgErrorCode> = new Map<number, TvgErrorCode>([
  [10, "invalid-argument"],
  [11, "invalid-input"],
  [12, "wrong-state"],
  [20, "not-tvg"],
  [21, "unsupported-version"],
  [22, "truncated"],
  [23, "checksum-mismatch"],
  [24, "malformed"],
  [25, "digest-mismatch"],
  [26, "unsupported"],
  [30, "limit-exceeded"],
  [31, "out-of-memory"],
  [40, "io"],
]);

/** The name of a `tvg_code`; "unknown" for a number that is none. */
export function errorCodeName(code: number): TvgErrorCode {
  return kNames.get(code) ?? "unknown";
}

/** What every function of the package throws or rejects with, but for an aborted signal's own reason. */
export class TvgError extends Error {
  override readonly name = "TvgError";

  constructor(
    /** What kind of error it is; a program may decide by it. */
    readonly code: TvgErrorCode,
    message: string,
  ) {
    super(message);
  }

  /** As it went through `postMessage`. */
  static from(plain: { code: TvgErrorCode; message: string }): TvgError {
    return new TvgError(plain.code, plain.message);
  }
}

/** The same error if it is a TvgError already, or one of `code` that says what the other says. */
export function asTvgError(error: unknown, code: TvgErrorCode = "io"): TvgError {
  if (error instanceof TvgError) return error;
  return new TvgError(code, error instanceof Error ? error.message : String(error));
}
