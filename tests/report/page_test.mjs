// Opens report.html in Chromium: node page_test.mjs HALFSTEP SOURCE_FOLDER PACKAGES CACHE_OF_SWEPT_VOLUMES
// PACKAGES: where axe-core is fetched to; without it faults of access are not looked for.
// Exit status 77, which ctest counts as skipped, when there is no Chromium or no report.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { all, faultsOf, once } from "./axe.mjs";
import { Browser, flat, hasBrowser, pause } from "./browser.mjs";
import { testByHand } from "./page_by_hand.mjs";
import { testControls, testInfeasible, testPhoneInTheDark, testSaving } from "./page_controls.mjs";
import { testVideo } from "./page_video.mjs";
import { testVolumes } from "./page_volumes.mjs";
import { countColours, partThatDiffers, readPng } from "./png.mjs";

const [halfstep, source, packages = "", cache = ""] = process.argv.slice(2);
const hostile = "<img src=x onerror=alert(1)> \"&'";
const place = mkdtempSync(join(tmpdir(), "halfstep_page_"));

// A run whose name, obstacle and a joint have names that are HTML.
function makeRun() {
  const read = (name) => readFileSync(join(source, name), "utf8");
  const scene = read("experiments/scenes/box.yaml");
  writeFileSync(join(place, "box.yaml"), scene.replace("- name: box", `- name: ${JSON.stringify(hostile)}`));
  const robots = join(source, "wpg/robots");
  const joint = "<b>KNEE";
  writeFileSync(join(place, "robot.yaml"), read("wpg/robots/hrp2.yaml")
    .replaceAll("RLEG_JOINT3", `"${joint}"`)
    .replaceAll(/urdf: (\S+)/g, "urdf: robot.urdf").replaceAll("./hrp2}", `${robots}/hrp2}`));
  writeFileSync(join(place, "robot.urdf"),
                read("wpg/robots/hrp2.urdf").replaceAll("RLEG_JOINT3", joint.replace("<", "&lt;")));
  execFileSync(halfstep, [
    "run", join(source, "experiments/configs/fig5_box.yaml"), "--out", "run", "--quiet",
    "--set", `scene=${place}/box.yaml`, "--set", `robot=${place}/robot.yaml`,
    "--set", `name=${JSON.stringify(hostile)}`,
  ], { cwd: place });
  spawnSync(halfstep, [
    "run", join(source, "experiments/configs/fig5_box.yaml"), "--out", "low", "--quiet",
    "--set", "half_step.via_height_m=0.14", "--set", "smoothing.methods=[dichotomy]",
  ], { cwd: place });
  execFileSync(halfstep, [
    "run", join(source, "experiments/configs/fig3_two_half_steps.yaml"), "--out", "pareto", "--quiet",
    "--set", "smoothing.methods=[halfstep/sqp]", "--set", "smoothing.optimizer.program=pareto",
    "--set", "smoothing.optimizer.durations=true", "--set", "smoothing.optimizer.pareto_points=3",
    "--set", "smoothing.optimizer.rounds=2",
  ], { cwd: place });
  execFileSync(halfstep, ["compare", "run", "--out", "comparison", "--quiet"], { cwd: place });
}

// The view once it satisfies `condition`, or as it is after a while: a slow machine draws late.
async function view(browser, condition) {
  const deadline = Date.now() + 60000;
  for (;;) {
    const late = Date.now() > deadline;
    const bytes = await browser.picture("#canvas").catch((error) => {
      if (late || !/imed out/.test(error.message)) throw error;
    });
    const picture = bytes && readPng(bytes);
    if (picture && (condition(picture) || late)) return picture;
    await pause(100);
  }
}
const isDrawn = (picture) => countColours(picture) > 100;
const clock = async (browser) =>
  Number.parseFloat(await browser.run("return document.getElementById('clock').textContent"));

// What does not fit where it stands: rows that would run over their end.
const overflows = (browser) => browser.run(`
  const rows = [document.documentElement, ...document.querySelectorAll("header, .bar, .plot-head")];
  const wide = rows.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent);
  const bottom = document.querySelector("main").getBoundingClientRect().bottom;
  return bottom <= window.innerHeight ? wide : [...wide, "main: " + bottom];`);

async function testRun(browser) {
  const url = `file://${place}/run/report.html`;
  await browser.load(url);
  assert.deepEqual(await overflows(browser), [], "everything fits at 1366 x 768");
  const texts = await browser.run(`return {
    title: document.getElementById("title").textContent,
    held: document.getElementById("junctions").textContent,
    elements: document.querySelectorAll("img, b *, script:not([type])").length,
    plots: document.querySelectorAll(".uplot").length,
    zmps: [...document.querySelectorAll(".zmp-map polyline")].map((line) =>
      line.getAttribute("points").split(" ").length),
    verdicts: document.querySelectorAll("#guarantee .yes").length,
    left: document.querySelector("#guarantee .not-covered").textContent,
    pair: document.getElementById("pair").textContent,
    opened: Number.parseFloat(document.getElementById("clock").textContent),
    insets: [...document.querySelectorAll(".zmp-map polygon[stroke-dasharray]")].map((inset) =>
      inset.getAttribute("points").split(" ").length),
    names: [...document.querySelectorAll(".zmp-map text")].map((text) => text.textContent),
    least: [...document.querySelectorAll("#least tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent)),
    policy: document.querySelector("meta[http-equiv]").content };`);
  assert.equal(texts.title, hostile);
  assert.ok(texts.held.includes(hostile), texts.held);
  assert.doesNotMatch(texts.held, /tau = |\(demanded/, "margins are told with the digits that mean something");
  assert.equal(texts.elements, 1, "no element comes from a name");
  assert.equal(texts.plots, 5);
  assert.equal(texts.zmps.length, 4, "two ZMPs, whole and lately");
  assert.ok(texts.zmps[0] > 100 && texts.zmps[1] === texts.zmps[0], `drawn: ${texts.zmps}`);
  assert.equal(texts.verdicts, 3);
  assert.match(texts.left, /^Not covered: \d+ things.*torque: nothing is demanded: the URDF has no effort.*Not watched: /s);
  assert.match(texts.policy, /^default-src 'none'; script-src 'sha256-/);

  const nearest = texts.least.find(([, margin]) => margin === "clearance");
  assert.ok(Math.abs(texts.opened - Number.parseFloat(nearest[0])) < 0.011, "opens where an obstacle is nearest");
  assert.match(texts.pair, /^A is nearest: .* – .* cm at/);
  assert.ok(texts.insets.every((corners) => corners >= 4), `what is demanded of both ZMPs: ${texts.insets}`);
  for (const name of ["x [m]", "y [m]", "left, at the start", "right, at the start", "1 right"]) {
    assert.ok(texts.names.includes(name), `${name}: ${texts.names}`);
  }
  for (const [, margin, sampled, proved] of texts.least) {
    assert.match(proved, /^≥ -?[\d.e-]+/, `${margin}: sampled ${sampled}`);
    assert.ok(sampled === "–" || Number.parseFloat(proved.slice(2)) <= Number.parseFloat(sampled), `${margin}: ${sampled}, ${proved}`);
  }
  await testDressed(browser);
  await browser.key("\uE011"); // Home

  const standing = await view(browser, isDrawn);
  assert.ok(isDrawn(standing), `the view is drawn: ${countColours(standing)} colours`);

  await browser.run("document.getElementById('play').click()");
  const deadline = Date.now() + 20000;
  while ((await clock(browser)) < 0.2 && Date.now() < deadline) await pause(50);
  await browser.key(" ");
  const paused = await clock(browser);
  assert.ok(paused >= 0.2, `it plays: ${paused} s`);
  await pause(200);
  assert.equal(await clock(browser), paused, "space pauses");

  await browser.set("scrub", "1.5");
  assert.equal(await clock(browser), 1.5);
  await browser.key("\uE014");
  assert.equal(await clock(browser), 1.55, "an arrow moves");
  const cursors = await browser.run(
    "return [...document.querySelectorAll('.cursor')].map((c) => c.style.transform)");
  assert.equal(new Set(cursors).size, 1, "one time in all plots");
  const hasMoved = (picture) => partThatDiffers(standing, picture) > 0.01;
  assert.ok(hasMoved(await view(browser, hasMoved)), "the robot has moved");

  for (const [id, value] of [
    ["layout", "ghost"], ["camera", "top"], ["show-paths", true], ["show-soles", true],
    ["show-strobe", true], ["show-footprints", false], ["follow", true], ["method-b", "-1"],
    ["method-a", "0"], ["camera", "front"],
  ]) await browser.set(id, value);
  assert.ok(isDrawn(await view(browser, isDrawn)));
  assert.deepEqual(await browser.console(), [], "the console is empty");
  assert.deepEqual((await browser.requests()).filter((asked) => !asked.startsWith("chrome")), [url],
                   "nothing else is fetched");
  assert.deepEqual(await faultsOf(browser, packages, once) ?? [], [], "serious and critical faults");
  await testSaving(browser);
  assert.deepEqual(await browser.console(), [], "the console is empty");
}

// What looks like a robot is drawn, and the bodies that proofs use in its place.
async function testDressed(browser) {
  await browser.set("camera", "feet");
  const dressed = await view(browser, isDrawn);
  await browser.set("show-bodies", true);
  const differs = (picture) => partThatDiffers(dressed, picture) > 0.003;
  assert.ok(differs(await view(browser, differs)), "feet are drawn otherwise than their bodies");
  await browser.set("show-bodies", false);
  await browser.set("camera", "corner");
}

async function testComparison(browser) {
  await browser.load(`file://${place}/comparison/report.html`);
  const rows = await browser.run("return document.querySelectorAll('#summary tbody tr').length");
  assert.equal(rows, 3, "three methods");
  const plots = await browser.run("return document.querySelectorAll('.uplot').length");
  assert.equal(plots, 6, "with the durations over run time");
  assert.deepEqual(await overflows(browser), []);
  assert.deepEqual(await browser.console(), []);
}

async function testEveryControl(browser) {
  const url = `file://${place}/run/report.html`;
  await browser.load("about:blank"); // an address that differs after # only loads nothing
  await testControls(browser, url);
  await browser.load("about:blank");
  await testPhoneInTheDark(browser, url);
  assert.deepEqual(await browser.console(), [], "the console is empty");
  await testInfeasible(browser, `file://${place}/low/report.html`);
}

async function testAccess(browser) {
  for (const folder of ["low", "run", "comparison", "pareto"]) {
    await browser.load("about:blank");
    await browser.load(`file://${place}/${folder}/report.html`);
    const faults = await faultsOf(browser, packages, ...(folder === "run" ? [all] : []));
    if (faults === null) return console.log("Without axe-core: faults of access are not looked for.");
    assert.deepEqual(faults, [], `${folder}: serious and critical faults`);
  }
  return undefined;
}

const testSliders = (browser) => testByHand(browser, halfstep, source, place);
const testVolumesOfPlan = (browser) => testVolumes(browser, halfstep, place, cache);
const testVideoOfRun = (browser) => testVideo(browser, halfstep, place);

async function testWithoutWebGl(browser) {
  await browser.load(`file://${place}/run/report.html`);
  const page = await browser.run(`return { view: document.getElementById("view").innerText,
    plots: document.querySelectorAll(".uplot").length }`);
  assert.match(page.view, /no WebGL/);
  assert.equal(page.plots, 5);
  await browser.set("scrub", "1.5");
  assert.equal(await clock(browser), 1.5);
}

if (!hasBrowser()) {
  console.log("Skipped: there is no chromium and chromedriver (packages chromium, chromium-driver)");
  process.exit(77);
}
try {
  makeRun();
  if (!existsSync(join(place, "run/report.html"))) {
    console.log("Skipped: this build of halfstep has no report");
    process.exitCode = 77;
  } else {
    for (const [flags, tests] of [[[], [testRun, testVolumesOfPlan]],
                                  [flat, [testWithoutWebGl, testComparison, testEveryControl, testSliders, testAccess, testVideoOfRun]]]) {
      const browser = await Browser.open(1366, 768, flags);
      try {
        for (const test of tests) await test(browser);
      } finally {
        await browser.close();
      }
    }
  }
} finally {
  rmSync(place, { recursive: true, force: true });
}
