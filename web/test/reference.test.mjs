import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { reference } from "../build_reference.mjs";
import { packageFolder } from "./toolbox.mjs";

const built = reference(join(packageFolder, "dist"));

test("the reference says what the types say", { skip: built ? false : "built without three.js" }, () => {
  const written = readFileSync(new URL("../../docs/web_reference.md", import.meta.url), "utf8");
  assert.equal(written, built, "run: node web/build_reference.mjs build/wasm/web/dist docs/web_reference.md");
});
