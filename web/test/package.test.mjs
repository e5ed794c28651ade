import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { packageFolder } from "./toolbox.mjs";

const hasNpm = spawnSync("npm", ["--version"]).status === 0;

test("the packed package works in a project of its own", { skip: hasNpm ? false : "there is no npm" }, () => {
  const folder = mkdtempSync(join(tmpdir(), "tvg-consumer-"));
  try {
    const run = (program, ...args) => execFileSync(program, args, { cwd: folder, encoding: "utf8" });
    const packed = run("npm", "pack", packageFolder, "--silent", "--offline").trim();
    const home = join(folder, "node_modules/tvg");
    mkdirSync(home, { recursive: true });
    run("tar", "-xzf", packed, "-C", home, "--strip-components=1");
    writeFileSync(join(folder, "package.json"), '{"type": "module"}');
    const stream = join(process.env.TVG_CONFORMANCE, "elp.tvg");
    writeFileSync(
      join(folder, "main.mjs"),
      `import { readFileSync } from "node:fs";
       import { TvgStream } from "tvg";
       const stream = await TvgStream.open(new Uint8Array(readFileSync(${JSON.stringify(stream)})));
       let frames = 0;
       for (let event; (event = await stream.next()) !== "end"; ) if (event === "frame") ++frames;
       console.log(frames, stream.decoder.module.version);`,
    );
    assert.equal(run("node", "main.mjs"), "6 0.2.0\n");

    writeFileSync(join(folder, "main.ts"), 'import { TvgStream } from "tvg";\nexport const open: Promise<TvgStream> = TvgStream.open("a.tvg");\n');
    run("tsc", "--noEmit", "--strict", "--target", "es2020", "--module", "node16", "--moduleResolution", "node16", "main.ts");
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

test("the package needs nothing but three, and that only where it is asked for", () => {
  const about = JSON.parse(readFileSync(join(packageFolder, "package.json"), "utf8"));
  assert.equal(about.dependencies, undefined);
  assert.deepEqual(Object.keys(about.peerDependencies), ["three"]);
  for (const entry of Object.values(about.exports)) {
    if (typeof entry === "object") assert.equal(Object.keys(entry)[0], "types");
  }
});
