// build_reference.mjs DIST REFERENCE.md: writes the reference of the package's interface from its types: what index.d.ts
// and three/index.d.ts in DIST export, in their order, with their comments.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const ts = createRequire(import.meta.url)("typescript");

const parse = (path) => ts.createSourceFile(path, readFileSync(path, "utf8"), ts.ScriptTarget.Latest, true);
const isPrivate = (node) => node.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.PrivateKeyword);
const isExported = (node) => node.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword);
const fileOf = (from, specifier) => join(dirname(from), specifier.text.replace(/\.js$/, ".d.ts"));

/** The names that an entry exports, each with the file that declares it. */
function exportsOf(entry) {
  return parse(entry).statements.filter(ts.isExportDeclaration).flatMap((statement) => {
    const file = fileOf(entry, statement.moduleSpecifier);
    const names = statement.exportClause?.elements.map(({ name }) => name.text);
    const declared = () => parse(file).statements.filter(isExported).map(nameOf);
    return (names ?? declared()).map((name) => ({ name, file }));
  });
}
function nameOf(statement) {
  return statement.name?.text ?? statement.declarationList.declarations[0].name.text;
}

const commentsOf = (node) => ts.getJSDocCommentsAndTags(node).filter(ts.isJSDoc).map((comment) => comment.getText());
const proseOf = (comment) => comment.replace(/^\/\*\*\s*|\s*\*\/$/g, "").replace(/^\s*\* ?/gm, "");

/** A declaration as TypeScript writes it, less what is private and its own comment, which stands above it. */
function codeOf(statement) {
  const text = statement.getText().replace(/^export (declare )?/, "");
  const start = statement.getStart() + statement.getText().length - text.length;
  const hidden = (statement.members ?? []).filter(isPrivate);
  const cuts = hidden.map((member) => [member.getFullStart() - start, member.getEnd() - start]);
  return cuts.reverse().reduce((code, [from, to]) => code.slice(0, from) + code.slice(to), text);
}

function section({ name, file }) {
  const statement = parse(file).statements.find((other) => isExported(other) && nameOf(other) === name);
  const prose = commentsOf(statement).map(proseOf).join("\n");
  return `### ${name}\n\n${prose ? `${prose}\n\n` : ""}\`\`\`ts\n${codeOf(statement)}\n\`\`\`\n`;
}

/** The reference, or undefined where the package was built without what stands on three.js. */
export function reference(dist) {
  const entries = { tvg: "index.d.ts", "tvg/three": "three/index.d.ts" };
  const parts = ["# The npm package's interface\n\nMade from the types by `web/build_reference.mjs`; how it is used is in [web.md](web.md).\n"];
  for (const [title, file] of Object.entries(entries)) {
    const entry = join(dist, file);
    if (!existsSync(entry)) return undefined;
    parts.push(`## \`${title}\`\n`, ...exportsOf(entry).map(section));
  }
  return parts.join("\n");
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [dist, output] = process.argv.slice(2);
  const text = reference(dist);
  if (text === undefined) throw new Error(`${dist}: built without three.js`);
  writeFileSync(output, text);
}
