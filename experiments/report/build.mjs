// Bundles a page: node build.mjs FOLDER_WITH_NODE_MODULES NAME OUT.html
// page.html around NAME.html, with NAME.js as its script and NAME.css as its style.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [packages, name, out] = process.argv.slice(2);
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
    metafile: true,
  });
  return { text: result.outputFiles[0].text.trim(), files: Object.keys(result.metafile.inputs) };
}

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

// A script ends at the first "</script", wherever that stands.
const { text: plain, files } = await bundle(`${name}.js`);
const script = plain.replace(/<\/script/gi, "<\\/script");
const { text: style } = await bundle(`${name}.css`);
const licences = ["three", "uplot"]
  .filter((used) => files.some((file) => file.includes(`node_modules/${used}/`)))
  .map((used) => `${used}\n\n${readFileSync(join(modules, used, "LICENSE"), "utf8").trim()}`)
  .join("\n\n\n");

// Only this script and this style run, and nothing is fetched but an episode: whatever a run's files are named.
const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; ` +
  "img-src data:; base-uri 'none'; form-action 'none'" +
  (name === "live" ? "; connect-src @HALFSTEP_SOCKET@" : "");

const text = (file) => readFileSync(join(here, file), "utf8");
const parts = {
  "@TITLE@": name === "live" ? "halfstep live" : "halfstep",
  "@BODY@": text(`${name}.html`).trim(),
  "@POLICY@": policy,
  "@STYLE@": style,
  "@LICENCES@": escaped(licences),
  "@SCRIPT@": script,
};
let page = text("page.html");
for (const [place, part] of Object.entries(parts)) page = page.replace(place, () => part);
writeFileSync(out, page);
