// plays.mjs ADDRESS PICTURE: opens a page in chromium, waits until its mesh has played a few frames, takes a picture.
// Exits with 77 where there is no chromium or playwright-core.
import { hasChromium, launch } from "../../web/test/chromium.mjs";

const [address, path] = process.argv.slice(2);
if (!hasChromium) process.exit(77);
const browser = await launch();
try {
  const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  page.on("pageerror", (error) => console.error(String(error)));
  await page.goto(address);
  await page.waitForFunction(() => globalThis.mesh?.player.frame?.number > 3, undefined, { timeout: 60000 });
  await page.screenshot({ path });
} finally {
  await browser.close();
}
