/** What the page plays: the address's word comes before the page's own. */
export interface PageSource {
  url: string;
  isLive: boolean;
  title: string;
  poster: string | undefined;
}

const kLiveName = /^[A-Za-z0-9_-][A-Za-z0-9._-]{0,63}$/;

/** By `?live=NAME`, `?stream=URL`, `data-live` or `data-stream`, in this order. */
export function sourceOf(root: HTMLElement, address: Location): PageSource {
  const asked = new URLSearchParams(address.search);
  const live = asked.get("live");
  const stream = asked.get("stream");
  const own = live === null && stream === null;
  const name = live ?? (own ? root.dataset.live : undefined);
  const poster = own ? root.dataset.poster : undefined;
  if (name !== undefined) {
    const url = kLiveName.test(name) ? new URL(`/live/${name}`, address.href).href : name;
    return { url, isLive: true, title: (own && root.dataset.title) || name, poster };
  }
  const url = stream ?? root.dataset.stream ?? "clip.tvg";
  return { url, isLive: false, title: (own ? root.dataset.title : fileName(url)) ?? "", poster };
}

/** What a reader would call it: a ladder goes by its folder. */
function fileName(url: string): string {
  const parts = url.split(/[?#]/)[0]!.split("/").filter((part) => part !== "");
  const name = (parts.length > 1 && parts[parts.length - 1] === "ladder.json" ? parts[parts.length - 2] : parts.pop()) ?? "";
  try {
    return decodeURIComponent(name).replace(/\.(tvg|json)$/, "");
  } catch {
    return name;
  }
}
