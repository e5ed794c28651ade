// Debian's chromium without a GPU, for tests; undefined where it or playwright-core is not there.
import { existsSync } from "node:fs";

const path = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const { chromium } = await import("playwright-core").catch(() => ({}));
const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--enable-precise-memory-info"];

export const hasChromium = path !== undefined && chromium !== undefined;
export const launch = () => chromium.launch({ executablePath: path, args });
