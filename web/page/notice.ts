const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

/** What the page says beside its picture: that it loads, what is damaged, what went wrong. */
export class Notice {
  private readonly loading = element("loading");
  private readonly percent = element("percent");
  private readonly status = element("status");
  private readonly trouble = element("trouble");
  private readonly retry = element<HTMLButtonElement>("retry");
  private poster: HTMLImageElement | undefined;

  constructor(onRetry: () => void) {
    this.retry.onclick = () => {
      this.trouble.hidden = true;
      onRetry();
    };
  }

  /** Until the first frame is drawn; none where the picture cannot be had. */
  showPoster(url: string): void {
    const poster = new Image();
    poster.id = "poster";
    poster.alt = "";
    poster.onerror = () => poster.remove();
    poster.src = url;
    element("view").after(poster);
    this.poster = poster;
  }
  hidePoster(): void {
    const { poster } = this;
    if (!poster) return;
    this.poster = undefined;
    poster.classList.add("gone");
    setTimeout(() => poster.remove(), 300);
  }

  /** That one waits, and for which share of what is needed, where it is known. */
  wait(share?: number): void {
    this.loading.classList.add("on");
    const text = share === undefined ? "Loading" : `Loading ${Math.floor(100 * share)} %`;
    if (this.percent.textContent !== text) this.percent.textContent = text;
  }
  get waits(): boolean {
    return this.loading.classList.contains("on");
  }
  goOn(): void {
    this.loading.classList.remove("on");
  }

  say(text: string, isWarning = false): void {
    this.status.textContent = text;
    this.status.classList.toggle("warning", isWarning);
  }

  /** An end that only `action` leads on from. */
  stop(title: string, text: string, action: string | undefined): void {
    this.goOn();
    element("trouble-title").textContent = title;
    element("trouble-text").textContent = text;
    this.retry.hidden = action === undefined;
    this.retry.textContent = action ?? "";
    this.trouble.hidden = false;
  }
  clear(): void {
    this.trouble.hidden = true;
  }
}
