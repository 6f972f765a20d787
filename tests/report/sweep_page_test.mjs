// Opens the report.html of a sweep, and of a comparison of its cases, in Chromium:
// node sweep_page_test.mjs HALFSTEP SOURCE_FOLDER
// Exit status 77, which ctest counts as skipped, when there is no Chromium or no report.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, flat, hasBrowser, pause } from "./browser.mjs";

const [halfstep, source] = process.argv.slice(2);
const hostile = "<img src=x onerror=alert(1)> \"&'";
const place = mkdtempSync(join(tmpdir(), "halfstep_sweep_page_"));
const url = `file://${place}/swept/report.html`;
const cdp = (browser, cmd, params) => browser.send("POST", "/goog/cdp/execute", { cmd, params });
const screen = (browser, width, height) => cdp(browser, "Emulation.setDeviceMetricsOverride",
  { width, height, deviceScaleFactor: 1, mobile: false });
const texts = (browser, selector) => browser.run(
  "return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)", selector);

// Eight cases by three keys; the longest steps are out of reach.
function makeSweep() {
  writeFileSync(join(place, "sweep.yaml"), `name: ${JSON.stringify(hostile)}
config: ${join(source, "experiments/configs/fig3_two_half_steps.yaml")}
keep: all
vary:
  - {key: footsteps.0.x_m, values: [0.2, 0.32]}
  - {key: half_step.duration_s, values: [1.8, 2]}
  - {key: smoothing.margins.zmp_m, values: [0.01, 0.012]}
  - {key: output.period_s, values: [0.05]}
`);
  execFileSync(halfstep, ["sweep", "sweep.yaml", "--out", "swept", "--quiet"], { cwd: place });
}

function testBytes() {
  const first = readFileSync(join(place, "swept/report.html"));
  execFileSync(halfstep, ["report", "swept", "--quiet"], { cwd: place });
  assert.ok(first.equals(readFileSync(join(place, "swept/report.html"))), "the same page again");
}

// A large sweep: its rows would make a page of 15 MB.
function makeLargeSweep() {
  const manifest = JSON.parse(readFileSync(join(place, "swept/manifest.json"), "utf8"));
  execFileSync("mkdir", [join(place, "large")]);
  writeFileSync(join(place, "large/manifest.json"),
                JSON.stringify({ ...manifest, name: "large", keys: ["seed", "half_step.duration_s"] }));
  const rows = ["case,seed,half_step.duration_s,method,status,certified,duration_s,worst_margin," +
    "worst_margin_name,iterations,effort,message"];
  for (let i = 0; i < 100000; ++i) {
    const id = `${String(i + 1).padStart(4, "0")}-${((i * 2654435761) % 2 ** 32).toString(16).padStart(8, "0")}`;
    const keys = `${id},${Math.floor(i / 100)},${1 + (i % 100) / 100}`;
    rows.push(`${keys},raw,converged,true,${(2 + i / 77777).toFixed(9)},0.01,floor,0,${i % 977},none`);
    rows.push(`${keys},dichotomy,${i % 10 ? "converged,true" : "failed,false"},${(1 + i / 77777).toFixed(9)},` +
      `-0.01,floor,7,${i % 877},"message number ${i}, of its own"`);
  }
  writeFileSync(join(place, "large/runs.csv"), rows.join("\n") + "\n");
  execFileSync(halfstep, ["report", "large", "--quiet"], { cwd: place });
  assert.ok(statSync(join(place, "large/report.html")).size < 5e6);
}

const clickCell = (browser, i) => browser.run(
  "document.querySelector(`#map .cell[data-cell='${arguments[0]}']`).dispatchEvent(new MouseEvent('click', { bubbles: true }))", i);

async function testCharts(browser) {
  await browser.load(url);
  assert.equal(await browser.run("return document.title"), `${hostile} – halfstep`);
  assert.equal((await texts(browser, "img")).length, 0, "names are text");
  const subtitle = await browser.run("return document.getElementById('subtitle').textContent");
  assert.match(subtitle, /8 cases: footsteps.0.x \[m\] \(2\) × half_step.duration \[s\] \(2\) × .*same in every case: output.period \[s\] 0.05/);
  assert.equal((await texts(browser, "#map .cell")).length, 4);
  assert.equal((await texts(browser, "#map path[stroke='#D55E00']")).length, 2, "two cells where nothing is proved");

  await clickCell(browser, 0);
  assert.match((await texts(browser, "#chosen h2"))[0], /2 chosen cases/);
  const id = /^\d{4}-[0-9a-f]{8}/.exec((await texts(browser, "#chosen td"))[0])[0];
  const links = await browser.run("return [...document.querySelectorAll('#chosen a')].map((a) => a.href)");
  assert.equal(links.length, 4, "a config and a report each");
  assert.ok(links.every((link) => existsSync(decodeURIComponent(link.replace("file://", "")))), `${links}`);
  assert.ok(links.includes(`file://${place}/swept/cases/${id}/report.html`), `${links}`);
  await clickCell(browser, 1);
  assert.match((await texts(browser, "#chosen"))[0], /0 of 2 cases solved.*not_run✗ not proved/s);

  await browser.run("document.querySelector('#map svg').focus()");
  await browser.key("\uE013");
  assert.match((await texts(browser, "#map .hint"))[0], /footsteps.0.x \[m\] 0.32, half_step.duration \[s\] 2:/, "arrow up");

  await browser.set("what", "speedup");
  assert.match((await texts(browser, "#map h2"))[0], /speed-up over raw \[×\]/);
  await browser.set("y", "0");
  assert.equal(await browser.run("return document.getElementById('x').selectedOptions[0].label"),
               "half_step.duration [s]", "the axes change places");
  const address = await browser.run("return location.hash");
  assert.match(address, /what=speedup&method=dichotomy&x=half_step.duration_s&y=footsteps.0.x_m/);
  await browser.run("const s = document.querySelector('#others select'); s.value = '1'; s.dispatchEvent(new Event('change'))");
  assert.match(await browser.run("return location.hash"), /%3Dsmoothing.margins.zmp_m=0.012/);
  await clickCell(browser, 0);
  assert.equal((await texts(browser, "#chosen h2"))[0], "The chosen case");
  await browser.run("const s = document.querySelector('#lines select'); s.value = '0'; s.dispatchEvent(new Event('change'))");
  assert.deepEqual((await texts(browser, "#lines .key")), ["0.2", "0.32"], "a line a value");

  assert.ok((await texts(browser, "#boxes text")).includes("dichotomy: 4 of 8 (4 failed)"));
  assert.equal((await texts(browser, "#profile option")).length, 2);
  await browser.run("const s = document.querySelector('#profile select'); s.value = '1'; s.dispatchEvent(new Event('change'))");
  assert.match((await texts(browser, "#profile svg"))[0], /factor of the least effort/);
  assert.equal((await texts(browser, "#counts tbody tr")).length, 6);

  const svg = await browser.run(`const made = [];
    URL.createObjectURL = (blob) => { made.push(blob); return "data:,"; };
    HTMLAnchorElement.prototype.click = function () {};
    document.querySelector("#map .save").click();
    return made[0].text();`);
  assert.ok(await browser.run(`const read = new DOMParser().parseFromString(arguments[0], "image/svg+xml");
    return read.querySelectorAll("rect").length > 4 && !read.querySelector("parsererror")`, svg));
  assert.deepEqual(await browser.console(), [], "the console is empty");
  assert.deepEqual((await browser.requests()).filter((asked) => asked.startsWith("http")), []);
}

async function testScreens(browser) {
  for (const [width, height] of [[390, 844], [1366, 768], [1920, 1080]]) {
    await screen(browser, width, height);
    await browser.load("about:blank");
    await browser.load(url);
    const wide = await browser.run("return document.documentElement.scrollWidth");
    assert.ok(wide <= width, `no wider than the screen: ${wide} px of ${width}`);
    const cut = await browser.run(`return [...document.querySelectorAll(".chart text")].filter((text) => {
      const [a, b] = [text.getBoundingClientRect(), text.closest("svg").getBoundingClientRect()];
      return a.left < b.left - 1 || a.right > b.right + 1 || a.top < b.top - 2 || a.bottom > b.bottom + 1;
    }).map((text) => text.textContent)`);
    assert.deepEqual(cut, [], `texts that are cut at ${width} px`);
  }
  for (const [scheme, colour] of [["dark", "rgb(18, 23, 29)"], ["light", "rgb(255, 255, 255)"]]) {
    await cdp(browser, "Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
    await pause(100);
    assert.equal(await browser.run("return getComputedStyle(document.body).backgroundColor"), colour);
  }
  assert.deepEqual(await browser.console(), []);
}

async function testLarge(browser) {
  await browser.load(`file://${place}/large/report.html`);
  const said = await browser.run("return document.getElementById('thinned').textContent");
  assert.match(said, /Drawn are [\d,]+ cases of 100,000, .*every \d+(nd|th) value of seed/);
  assert.match((await texts(browser, "#counts"))[0], /dichotomyconverged90000/, "all are counted");
  assert.ok((await texts(browser, "#map .cell")).length <= 100 * 100);
  assert.deepEqual(await browser.console(), []);
}

async function testComparison(browser) {
  const runs = readdirSync(join(place, "swept/cases")).filter((id) => /^000[1-4]/.test(id)).map((id) => `swept/cases/${id}`);
  execFileSync(halfstep, ["compare", ...runs, "--out", "comparison", "--quiet"], { cwd: place });
  await browser.load(`file://${place}/comparison/report.html`);
  assert.match((await texts(browser, "#profile h2"))[0], /Performance profile/);
  assert.equal((await texts(browser, "#profile option")).length, 6, "three targets by two efforts");
  assert.ok((await texts(browser, "#boxes text")).includes("dichotomy/published: 4 of 4"));
  assert.deepEqual(await browser.console(), [], "the console is empty");
}

if (!hasBrowser()) {
  console.log("Skipped: there is no chromium and chromedriver (packages chromium, chromium-driver)");
  process.exit(77);
}
try {
  makeSweep();
  if (!existsSync(join(place, "swept/report.html"))) {
    console.log("Skipped: this build of halfstep has no report");
    process.exitCode = 77;
  } else {
    testBytes();
    makeLargeSweep();
    const browser = await Browser.open(1366, 768, flat); // nothing of it is 3D
    try {
      for (const test of [testCharts, testScreens, testLarge, testComparison]) await test(browser);
    } finally {
      await browser.close();
    }
  }
} finally {
  rmSync(place, { recursive: true, force: true });
}
