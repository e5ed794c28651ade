// The examples as a reader would run them: in a project that has the packages beside them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { packageFolder } from "./toolbox.mjs";

const web = fileURLToPath(new URL("..", import.meta.url));
const stream = join(process.env.TVG_CONFORMANCE, "gops.tvg");
const browserPath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const { chromium } = await import("playwright-core").catch(() => ({}));
const hasThree = existsSync(join(web, "node_modules/three")) && existsSync(join(packageFolder, "dist/three/index.js"));
const skip = !hasThree ? "npm ci was not run in web/" : !browserPath || !chromium ? "there is no chromium" : false;

const folder = mkdtempSync(join(tmpdir(), "tvg-examples-"));
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const file = join(folder, new URL(request.url, "http://localhost").pathname);
  if (!existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { "Content-Type": types[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
});

before(async () => {
  cpSync(join(web, "examples"), folder, { recursive: true });
  cpSync(packageFolder, join(folder, "node_modules/tvg"), { recursive: true, filter: (path) => !path.endsWith("/page") });
  if (hasThree) {
    for (const name of readdirSync(join(web, "node_modules"))) {
      if (!name.startsWith(".")) symlinkSync(join(web, "node_modules", name), join(folder, "node_modules", name));
    }
  }
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
});
after(() => {
  server.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Opens a page and waits until the mesh of its global scope has played a few frames. */
async function playsIn(path) {
  const browser = await chromium.launch({
    executablePath: browserPath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
  try {
    const page = await browser.newPage();
    const complaints = [];
    page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    await page.goto(`http://127.0.0.1:${server.address().port}/${path}`);
    await page.waitForFunction(() => globalThis.mesh?.player.frame?.number > 3, undefined, { timeout: 60000 });
    if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, `${path.split("/")[0]}.png`) });
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
  }
}

test("Node writes every frame as an OBJ file", () => {
  const script = join(folder, "node/frames_to_obj.mjs");
  const said = execFileSync("node", [script, stream, join(folder, "frames")], { encoding: "utf8" });
  const files = readdirSync(join(folder, "frames"));
  assert.match(said, new RegExp(`: ${files.length} frames`));
  const lines = readFileSync(join(folder, "frames", files[0]), "utf8").split("\n");
  assert.ok(lines.filter((line) => /^v (\S+ ){2}\S+$/.test(line)).length > 3);
  assert.ok(lines.filter((line) => /^f (\d+ ){2}\d+$/.test(line)).length > 3);
});

test("three.js plays without a bundler", { skip }, async () => {
  symlinkSync(join(folder, "node_modules"), join(folder, "three/node_modules"));
  cpSync(stream, join(folder, "three/clip.tvg"));
  await playsIn("three/index.html");
});

test("react-three-fiber plays", { skip: skip || (!existsSync(join(web, "node_modules/react")) && "there is no React") }, async () => {
  const { build } = await import("esbuild");
  await build({
    entryPoints: [join(folder, "react/main.tsx")],
    outfile: join(folder, "react/main.js"),
    bundle: true,
    format: "esm",
    jsx: "automatic",
    external: ["three", "tvg", "tvg/three"],
    define: { "process.env.NODE_ENV": '"production"' },
  });
  cpSync(stream, join(folder, "react/clip.tvg"));
  const map = /<script type="importmap">[^]*?<\/script>/.exec(readFileSync(join(folder, "three/index.html"), "utf8"))[0];
  const page = readFileSync(join(folder, "react/index.html"), "utf8");
  writeFileSync(join(folder, "react/played.html"), map.replaceAll("./node_modules", "../node_modules") + page.replace("main.tsx", "main.js"));
  await playsIn("react/played.html");
});

test("the example for React is what the types allow", { skip: skip && "npm ci was not run in web/" }, () => {
  writeFileSync(
    join(folder, "tsconfig.json"),
    JSON.stringify({
      compilerOptions: {
        strict: true, noEmit: true, skipLibCheck: true, target: "es2022", module: "es2022", moduleResolution: "bundler",
        jsx: "react-jsx",
      },
      files: ["react/main.tsx"],
    }),
  );
  execFileSync("node", [join(web, "node_modules/typescript/bin/tsc"), "-p", folder], { encoding: "utf8", stdio: ["ignore", "inherit", "inherit"] });
});
