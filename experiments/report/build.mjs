// Bundles the page: node build.mjs FOLDER_WITH_NODE_MODULES OUT.html
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [packages, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const modules = join(packages, "node_modules");
const esbuild = createRequire(join(packages, "package.json"))("esbuild");

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(here, entry)],
    nodePaths: [modules],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2020",
    charset: "ascii",
    legalComments: "inline",
  });
  return result.outputFiles[0].text.trim();
}

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

// A script ends at the first "</script", wherever that stands.
const script = (await bundle("main.js")).replace(/<\/script/gi, "<\\/script");
const style = await bundle("report.css");
const licences = ["three", "uplot"]
  .map((name) => `${name}\n\n${readFileSync(join(modules, name, "LICENSE"), "utf8").trim()}`)
  .join("\n\n\n");

// Only this script and this style run, and nothing is fetched: whatever a run's files are named.
const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; ` +
  "img-src data:; base-uri 'none'; form-action 'none'";

const parts = {
  "@POLICY@": policy,
  "@STYLE@": style,
  "@LICENCES@": escaped(licences),
  "@SCRIPT@": script,
};
let page = readFileSync(join(here, "index.html"), "utf8");
for (const [place, text] of Object.entries(parts)) page = page.replace(place, () => text);
writeFileSync(out, page);
