// Opens the page of an episode in Chromium, as it goes on and as it was recorded:
// node live_page_test.mjs HALFSTEP SOURCE_FOLDER CACHE_OF_SWEPT_VOLUMES PACKAGES [across]
// `across`, which ctest leaves out since it takes minutes: HRP-2's whole set of half-steps, and the
// bar is dragged across all of a corridor, so that the robot has to step over it.
// Exit status 77, which ctest counts as skipped, when there is no Chromium, no page or no server.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { faultsOf } from "./axe.mjs";
import { Browser, hasBrowser, pause } from "./browser.mjs";
import { countColours, partThatDiffers, readPng } from "./png.mjs";

const [halfstep, source, cache, packages, variant] = process.argv.slice(2);
const across = variant === "across";
const place = mkdtempSync(join(tmpdir(), "halfstep_live_page_"));
const children = [];
const patience = 180_000; // for whatever has to come [ms]

// Few half-steps, so that they are baked soon; they are too few to step over a bar wherever it may
// be dropped: over it or around its end is for the planner to choose.
const few = `
step_set: {x_min_m: 0, x_max_m: 0.35, y_min_m: -0.26, y_max_m: -0.21, spacing_m: 0.05, yaws_rad: [0]}
swept_volumes: {cell_m: 0.02, displacement_m: 0.01, cache: ${JSON.stringify(cache)}}
planner: {unimproved_nodes: 100, max_nodes: 2000}`;
const whole = `
swept_volumes: {cache: ${JSON.stringify(cache)}}
planner: {unimproved_nodes: 200, max_nodes: 3000, workspace_m: [-0.5, -0.8, 3.5, 0.8]}`;
const [barTo, goalTo] = across ? [[2.1, 0], [2.8, 0]] : [[1.4, 1.2], [2, 0]];
writeFileSync(join(place, "bar.yaml"), `name: bar
obstacles:
  - name: bar
    box: {size_m: [0.03, 3.0, 0.03]}
    pose: {xyz: [${barTo[0]}, 2.6, 0.015]}
    motion: {speed_m_s: 0.3}
`);
writeFileSync(join(place, "small.yaml"), `name: small
robot: hrp2
scene: bar.yaml
goal: {x_m: 0.35, y_m: 0, radius_m: 0.15}
half_step: {duration_s: 1.5, zmp_shift_s: 0.075}
smoothing: {margins: {double_support_s: 0.075}}${across ? whole : few}
live: {smooth_ahead: 4, tolerance_s: 0.1, longest_s: 600, sensing: {rests_after_s: 0.5}}
`);

// `halfstep live --view` in the folder; resolves when its address is known, or it has ended.
async function serve(out, ...more) {
  const child = spawn(halfstep, ["live", "small.yaml", "--view", "--out", out, ...more], { cwd: place });
  const episode = { child, text: "", ended: null };
  episode.done = new Promise((resolve) => child.on("exit", (status) => {
    episode.ended = status;
    resolve(status);
  }));
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (part) => { episode.text += part; });
  await until(() => /http:\S+/.test(episode.text) || episode.ended !== null, "an address");
  episode.address = /http:\S+/.exec(episode.text)?.[0];
  return episode;
}

let words = async () => ""; // of the page, for what failed
async function until(condition, what) {
  const deadline = Date.now() + patience;
  for (;;) {
    const found = await condition();
    if (found) return found;
    if (Date.now() > deadline) assert.fail(`waited in vain for ${what}: ${await words()}`);
    await pause(100);
  }
}

// Whether the view satisfies `condition`; a machine that is slow at drawing is asked again.
async function isDrawn(browser, condition) {
  try {
    return condition(readPng(await browser.picture("#canvas")));
  } catch (error) {
    if (/imed out/.test(error.message)) return false;
    throw error;
  }
}
const isPicture = (picture) => countColours(picture) > 100;
// The part of a picture that is pink, as swept volumes are.
function pinkPart({ width, height, pixel }) {
  let pink = 0;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const colour = pixel(x, y);
      const [red, green, blue] = [colour >> 16, (colour >> 8) & 255, colour & 255];
      if (red > green + 8 && blue > green + 3) ++pink;
    }
  }
  return pink / (width * height);
}
const textOf = (browser, id) => browser.run("return document.getElementById(arguments[0]).textContent", id);
const stateIs = (browser, pattern) =>
  until(async () => pattern.test(await textOf(browser, "state")), `the state ${pattern}`);
const volumesAre = (browser, pattern) =>
  until(async () => pattern.test(await textOf(browser, "volumes-note")), `the volumes ${pattern}`);
const click = (browser, id) => browser.run("document.getElementById(arguments[0]).click()", id);
const labels = (browser) =>
  browser.run("return [...document.querySelectorAll('.tag-of')].map((label) => label.textContent)");

// The number of a walk after walk `before` that took over with other footsteps, when the log has one.
async function walkWithOtherFootsteps(browser, before) {
  const lines = await browser.run("return [...document.querySelectorAll('#log li')].map((line) => line.title)");
  const numbers = lines.map((line) => /walk (\d+) taken over.*: another way/.exec(line)?.[1]).filter(Boolean);
  return numbers.map(Number).find((number) => number > before);
}

// Addresses that the page asked for since the last call.
const fetched = async (browser) =>
  (await browser.requests()).filter((asked) => !asked.startsWith("chrome"));

// What does not fit where it stands.
const overflows = (browser) => browser.run(`
  const rows = [document.documentElement, ...document.querySelectorAll("header, .bar, .card")];
  return rows.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.id || e.textContent);`);

const pointer = (browser, ...actions) => browser.send("POST", "/actions", { actions: [{
  type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions,
}] });
const moveTo = (browser, x, y) => pointer(browser, { type: "pointerMove", x, y, duration: 50 });

// Presses a label and resolves to where: [x, y] in pixels. A label follows the camera, so on a slow machine
// it may have gone from where it was seen; then it is tried again.
function press(browser, name) {
  return until(async () => {
    const middle = await browser.run(`
      const label = document.querySelector('[data-name="' + arguments[0] + '"]');
      const { left, top, width, height } = label.getBoundingClientRect();
      return label.checkVisibility() ? [Math.round(left + width / 2), Math.round(top + height / 2)] : null;`, name);
    if (!middle) return null;
    const [x, y] = middle;
    await pointer(browser, { type: "pointerMove", x, y }, { type: "pointerDown", button: 0 });
    await moveTo(browser, x, y);
    const isHeld = await browser.run(`
      const readout = document.getElementById("readout");
      return !readout.hidden && readout.textContent.startsWith(arguments[0]);`, name);
    if (isHeld) return middle;
    await pointer(browser, { type: "pointerUp", button: 0 });
    return null;
  }, `${name} to be pressed`);
}

// Drags a label along the floor until the page says that what it names is to go to [x, y] [m].
async function drag(browser, name, [x, y]) {
  let at = await press(browser, name);
  const dragTo = async ([px, py]) => {
    await moveTo(browser, Math.round(px), Math.round(py));
    const said = await textOf(browser, "readout");
    const found = /x (-?[\d.]+) m, y (-?[\d.]+) m/.exec(said);
    assert.ok(found, `while it is dragged the page says where to: ${said}`);
    return found.slice(1).map(Number);
  };
  // What a pixel is on the floor is found by trying.
  let there = await dragTo(at);
  for (let i = 0; i < 12 && Math.hypot(x - there[0], y - there[1]) > 0.03; ++i) {
    const [ax, ay] = await dragTo([at[0] + 12, at[1]]);
    const [bx, by] = await dragTo([at[0], at[1] + 12]);
    const [a, b, c, d] = [ax - there[0], bx - there[0], ay - there[1], by - there[1]].map((v) => v / 12);
    const det = a * d - b * c;
    const [ex, ey] = [x - there[0], y - there[1]];
    const [dx, dy] = [(d * ex - b * ey) / det, (a * ey - c * ex) / det];
    const part = Math.min(1, 150 / Math.hypot(dx, dy));
    at = [at[0] + part * dx, at[1] + part * dy];
    there = await dragTo(at);
  }
  await pointer(browser, { type: "pointerUp", button: 0 });
  assert.ok(Math.hypot(x - there[0], y - there[1]) < 0.07, `dragged to ${there}`);
}

function rowsOf(file) {
  const [header, ...rows] = readFileSync(join(place, file), "utf8").trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(row.map((cell, i) => [header[i], cell])));
}

async function testLive(browser, episode) {
  await browser.load(episode.address);
  words = () => browser.run("return document.body.innerText");
  await stateIs(browser, /half-step \d+ of \d+/);
  assert.match(await textOf(browser, "connection"), /^connected$/);
  assert.deepEqual(await overflows(browser), [], "everything fits at 1366 x 768");
  const policy = await browser.run("return document.querySelector('meta[http-equiv]').content");
  assert.match(policy, /connect-src ws:\/\/127\.0\.0\.1:\d+\/[^ ;]+\/socket$/);
  await until(async () => (await labels(browser)).includes("bar"), "the bar");
  await until(() => isDrawn(browser, isPicture), "a picture");

  // From above and from farther away, so that the whole way is seen.
  await browser.set("follow", false);
  await browser.set("camera", "top");
  await browser.send("POST", "/actions", { actions: [{ type: "wheel", id: "wheel", actions: [
    { type: "scroll", x: 400, y: 400, deltaX: 0, deltaY: 400 },
    { type: "scroll", x: 400, y: 400, deltaX: 0, deltaY: 400 },
  ] }] });
  await until(async () => (await browser.run(
    "return document.querySelector('[data-name=bar]').checkVisibility()")), "the bar to be in view");
  // The goal goes on, and while the robot waits a bar comes into its way. It is told to wait at once, so
  // that what a slow machine draws takes none of its walk.
  await drag(browser, "goal", goalTo);
  const before = await until(() => walkWithOtherFootsteps(browser, 0), "a walk to the goal");
  await click(browser, "hold");
  await stateIs(browser, /paused/);
  await browser.set("show-volumes", true);
  await volumesAre(browser, /of 0 half-steps/);
  assert.equal(await textOf(browser, "hold"), "Walk on");
  await drag(browser, "bar", barTo);

  await click(browser, "add");
  await until(async () => (await labels(browser)).includes("spare_1"), "the box");
  await browser.run(`document.querySelector('[data-name="spare_1"]').focus()`);
  await until(async () => /spare_1/.test(await textOf(browser, "remove")), "the box to be selected");
  await click(browser, "remove");
  await until(async () => !(await labels(browser)).includes("spare_1"), "the box to vanish");

  await click(browser, "hold");
  await until(async () => !/paused/.test(await textOf(browser, "state")), "the robot to walk on");
  await volumesAre(browser, /of [1-9]\d* half-steps? still to come, by cells of 2 cm/);
  await until(() => isDrawn(browser, (picture) => pinkPart(picture) > 0.01), "the volumes to be drawn");
  assert.deepEqual(await overflows(browser), []);
  await browser.set("show-volumes", false);
  await until(async () => !(await browser.run(
    "return document.getElementById('volumes-note').checkVisibility()")), "the volumes to be hidden");
  // What was is seen again, and then what is.
  await click(browser, "restart");
  await stateIs(browser, /, as it was$/);
  await click(browser, "now");
  await until(async () => !/as it was/.test(await textOf(browser, "state")), "what is");
  const handedOver = await browser.run(`
    return [...document.querySelectorAll("#hand-overs tr")].slice(1).map((row) => row.textContent)`);
  assert.ok(handedOver.length > 0 && handedOver.length <= 10, `hand-overs: ${handedOver}`);
  assert.match(handedOver[0], /s\d+(another|a faster|a shorter|the way|it walks).* ms$/);
  await stateIs(browser, /half-step (\d+) of \1, at rest/);
  await click(browser, "stop");
  await stateIs(browser, /^(arrived|stuck|too long|no plan|interrupted)/);
  assert.match(await textOf(browser, "state"), /^arrived/);
  assert.equal(await episode.done, 0, episode.text);
  const later = rowsOf("one/plans.csv").filter((walk) => walk.kind === "changed" && Number(walk.walk) > before);
  assert.ok(later.length > 0, "a walk with other footsteps took over for the bar");
  assert.deepEqual(await browser.console(), [], "the console is empty");
  assert.deepEqual(await fetched(browser), [episode.address], "nothing else is fetched");
}

// In the end the bar lies across what was the way, and the robot is beyond it: where it lies across
// all of the corridor, the robot stepped over it.
function testIsBeyond() {
  const bar = rowsOf("one/obstacles.csv").filter((row) => row.obstacle === "bar").at(-1);
  assert.ok(Math.abs(bar.x_m - barTo[0]) < 0.1 && Math.abs(bar.y_m - barTo[1]) < 0.1, `the bar: ${bar.x_m}, ${bar.y_m}`);
  const motion = rowsOf("one/trajectory.csv");
  for (const foot of ["left", "right"]) {
    assert.ok(motion[0][`${foot}_foot_x_m`] < bar.x_m && motion.at(-1)[`${foot}_foot_x_m`] > bar.x_m);
  }
  execFileSync(halfstep, ["verify", "one"], { cwd: place });
}

async function testAgainAndStop(browser) {
  const episode = await serve("two");
  children.push(episode.child);
  await browser.load(episode.address);
  await stateIs(browser, /half-step \d+ of \d+/);
  await browser.run("document.body.dataset.first = 'yes'");
  await click(browser, "again");
  const isFirst = () => browser.run("return document.body.dataset.first ?? 'no'").catch(() => "yes");
  await until(async () => (await isFirst()) === "no", "the page anew");
  await stateIs(browser, /half-step \d+ of \d+/);
  assert.equal(await textOf(browser, "connection"), "connected");
  await click(browser, "stop");
  await stateIs(browser, /^(ended|interrupted|arrived)/);
  await until(() => episode.ended !== null, "the end");
  assert.equal(await browser.run("return document.getElementById('stop').disabled"), true);
  assert.deepEqual(await browser.console(), []);
  assert.deepEqual(await fetched(browser), [episode.address, episode.address]);
  for (const folder of ["two", "two_2"]) {
    execFileSync(halfstep, ["verify", folder], { cwd: place });
    assert.ok(existsSync(join(place, folder, "report.html")));
  }
}

async function testRecording(browser) {
  const url = `file://${place}/one/report.html`;
  await browser.load(url);
  let standing = null;
  await until(() => isDrawn(browser, (picture) => isPicture(standing = picture)), "a picture");
  assert.deepEqual(await overflows(browser), []);
  assert.equal(await browser.run("return document.getElementById('controls').hidden"), true);
  assert.match(await textOf(browser, "outcome"), /arrived after [\d.]+ s/);
  assert.equal(await browser.run("return document.getElementById('show-volumes').checkVisibility()"), false);
  const clock = async () => Number.parseFloat(await textOf(browser, "clock"));
  await click(browser, "play");
  await until(async () => (await clock()) > 0.2, "it to play");
  await browser.key(" ");
  const paused = await clock();
  await pause(200);
  assert.equal(await clock(), paused, "space pauses");

  await click(browser, "restart");
  await until(async () => (await clock()) < paused, "it to begin again");
  await browser.key(" ");
  await browser.set("scrub", "6");
  assert.equal(await clock(), 6);
  await stateIs(browser, /^6\.00 s, half-step \d+ of \d+/);
  await until(() => isDrawn(browser, (picture) => partThatDiffers(standing, picture) > 0.01),
              "the robot to be elsewhere");
  await browser.set("scrub", "1e9");
  await stateIs(browser, /^arrived/);
  assert.match(await textOf(browser, "log"), /taken over/);
  assert.ok((await browser.run("return document.querySelectorAll('#latency rect').length")) > 0);
  for (const [id, value] of [["camera", "top"], ["show-strobe", true], ["show-balance", true],
                             ["show-shells", false], ["follow", false], ["scrub", "3"]]) {
    await browser.set(id, value);
  }
  await stateIs(browser, /^3\.00 s/);
  assert.deepEqual(await browser.console(), [], "the console is empty");
  assert.deepEqual(await fetched(browser), [url]);
}

if (!hasBrowser()) {
  console.log("Skipped: there is no chromium and chromedriver (packages chromium, chromium-driver)");
  process.exit(77);
}
try {
  const episode = await serve("one");
  children.push(episode.child);
  if (!episode.address) {
    assert.match(episode.text, /--view/, "only a build without page or server has no address");
    console.log(`Skipped: ${episode.text}`);
    process.exitCode = 77;
  } else {
    const browser = await Browser.open(1366, 768);
    try {
      await testLive(browser, episode);
      testIsBeyond();
      await testAgainAndStop(browser);
      await testRecording(browser);
    } finally {
      await browser.close();
    }
    const narrow = await Browser.open(390, 844);
    try {
      await narrow.load(`file://${place}/one/report.html`);
      assert.deepEqual(await overflows(narrow), [], "everything fits at 390 x 844");
      assert.deepEqual(await faultsOf(narrow, packages) ?? [], [], "serious and critical faults");
    } finally {
      await narrow.close();
    }
  }
} finally {
  for (const child of children) child.kill("SIGKILL");
  rmSync(place, { recursive: true, force: true });
}
