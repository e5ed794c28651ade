/** Where this script was loaded from; only told while it is first run. */
const script = typeof document === "undefined" ? null : (document.currentScript as HTMLScriptElement | null);

/** A file that `tvg page -o NAME.html` put into the page itself; undefined where it lies beside the page. */
export function embeddedFile(name: string): Uint8Array | undefined {
  const element = document.querySelector(`script[data-file="${CSS.escape(name)}"]`);
  if (!element) return undefined;
  const text = atob((element.textContent ?? "").trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The decoder: in the page, or beside the player's script, wherever the page itself is. */
export function decoderSource(): Uint8Array | URL {
  return embeddedFile("tvg.wasm") ?? new URL("tvg.wasm", script?.src || document.baseURI);
}
