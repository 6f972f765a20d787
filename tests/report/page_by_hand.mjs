// Overlaps, durations and heights moved by hand, and what is saved of them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { rowsOf } from "./csv.mjs";

// The page evaluates the walk of a run's method as the run did.
async function sameClosedForm(browser, place, folder, method) {
  await browser.load("about:blank");
  await browser.load(`file://${place}/${folder}/report.html#a=${method}&b=none`);
  const table = join(place, folder, method.replace("/", "_"), "trajectory.csv");
  const rows = rowsOf(table).filter((_, i) => i % 7 === 0);
  const ours = await browser.run("return halfstepByHand.rows(arguments[0])", rows.map((row) => Number(row.t_s)));
  const columns = Object.keys(rows[0]).filter((name) => /^(com_[xyz]|zmp|waist|left_foot|right_foot)_.*(m|rad)$|^q_/
    .test(name) && !name.includes("margin"));
  assert.ok(columns.length >= 28, `${columns}`);
  let most = 0;
  rows.forEach((row, i) => {
    for (const name of columns) most = Math.max(most, Math.abs(ours[i][name] - Number(row[name])));
    assert.equal(ours[i].support, row.support);
  });
  assert.ok(most < 1e-6, `the closed form is that of the run: ${most}`);
}

// Three stairs by a robot that crouches: levels are drawn, and the closed form has them.
async function testLevels(browser, halfstep, source, place) {
  execFileSync(halfstep, ["run", join(source, "experiments/configs/stairs_10cm.yaml"), "--out", "stairs", "--quiet",
    "--set", "smoothing.methods=[dichotomy]", "--set", "half_step.crouch_m=0.01"], { cwd: place });
  await sameClosedForm(browser, place, "stairs", "dichotomy");
  const told = await browser.run(`return {
    solids: JSON.parse(document.getElementById("data").textContent).scenes[0].ground.solids.length,
    map: document.getElementById("zmps").textContent }`);
  assert.equal(told.solids, 3);
  assert.match(told.map, /hull of their shadows/);
}

/** The sliders of a run in `place`/run: A is its dichotomy. `halfstep` is the program. */
export async function testByHand(browser, halfstep, source, place) {
  await testLevels(browser, halfstep, source, place);
  execFileSync(halfstep, ["smooth", "run", "--method", "halfstep/sqp", "--out", "forms", "--quiet",
    ...["durations", "via_laterals", "foot_ramps", "foot_delays", "lift_shares", "via_alongs", "zmp_shifts",
     "zmp_bump_ramps", "footsteps"].flatMap(
      (family) => ["--set", `smoothing.optimizer.${family}=true`]),
    "--set", "smoothing.optimizer.rounds=2"], { cwd: place });
  await sameClosedForm(browser, place, "forms", "halfstep/sqp");
  await sameClosedForm(browser, place, "run", "dichotomy");

  await browser.run(`document.querySelector("#by-hand summary").click();
    window.files = {};
    URL.createObjectURL = (blob) => { window.blob = blob; return "data:,"; };
    HTMLAnchorElement.prototype.click = function () { window.files[this.download] = window.blob; };`);
  const saved = async (folder) => {
    await browser.run(`document.querySelector("#by-hand button").click()`);
    mkdirSync(join(place, folder));
    for (const name of ["overlaps.csv", "half_steps.csv"]) {
      writeFileSync(join(place, folder, name), await browser.run("return window.files[arguments[0]].text()", name));
    }
    const given = ["overlaps.csv", "half_steps.csv"].flatMap((name) => ["--given", join(folder, name)]);
    execFileSync(halfstep, ["smooth", "run", ...given, "--out", `${folder}/run`, "--quiet"], { cwd: place });
    return rowsOf(join(place, folder, "run/summary.csv")).find((row) => row.method === "given");
  };
  const same = await saved("untouched");
  assert.equal(same.certified, "true", "what was saved untouched is certified");
  assert.equal(readFileSync(join(place, "untouched/run/given/trajectory.csv"), "utf8"),
               readFileSync(join(place, "run/dichotomy/trajectory.csv"), "utf8"));

  // Less overlap: slower, and certified as well.
  await browser.run(`const slider = document.querySelector("#by-hand input[aria-label^='Overlap']");
    slider.value = 0.9 * slider.value; slider.dispatchEvent(new Event("input", { bubbles: true }));`);
  const words = await browser.run(`return { a: document.getElementById("tag-a").textContent,
    outcome: document.getElementById("outcome").textContent, told: document.getElementById("by-hand").textContent }`);
  assert.match(words.a, /^A by hand: /);
  assert.match(words.outcome, /sampled, not certified/);
  assert.match(words.told, /joint speed.*kept at the samples/);
  const moved = await saved("moved");
  assert.equal(moved.certified, "true");
  const shown = Number.parseFloat(words.outcome.slice(3));
  assert.ok(Math.abs(Number(moved.duration_s) - shown) < 6e-4, `${moved.duration_s}, ${shown}`);
  await browser.run(`document.querySelectorAll("#by-hand button")[1].click()`);
  assert.match(await browser.run("return document.getElementById('tag-a').textContent"), /^A dichotomy/);
  assert.deepEqual(await browser.console(), [], "the console is empty");
}
