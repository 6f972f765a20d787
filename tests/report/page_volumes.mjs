// The swept volumes of a planned run in its report.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pause } from "./browser.mjs";
import { rowsOf } from "./csv.mjs";
import { partThatDiffers, readPng } from "./png.mjs";

// As few half-steps as live_page_test bakes, and so its cache.
const config = (cache) => `
name: planned
robot: hrp2
scene: none
goal: {x_m: 0.6, y_m: 0, radius_m: 0.2}
half_step: {duration_s: 1.5, zmp_shift_s: 0.075}
step_set: {x_min_m: 0, x_max_m: 0.35, y_min_m: -0.26, y_max_m: -0.21, spacing_m: 0.05, yaws_rad: [0]}
swept_volumes: {cell_m: 0.02, displacement_m: 0.01, cache: ${JSON.stringify(cache)}}
planner: {unimproved_nodes: 100, max_nodes: 2000}
smoothing: {methods: [dichotomy], margins: {double_support_s: 0.075}}
`;

// Whether the volume of a half-step contains a point of W.
function contains(volumes, half, point) {
  const { lower, size, runs } = volumes.volumes[half.volume];
  const [x, y, yaw] = half.X_WS;
  const [dx, dy] = [point[0] - x, point[1] - y];
  const inS = [Math.cos(yaw) * dx + Math.sin(yaw) * dy, Math.cos(yaw) * dy - Math.sin(yaw) * dx, point[2]];
  if (half.mirrored) inS[1] = -inS[1];
  const cell = inS.map((value, k) => Math.floor((value - lower[k]) / volumes.cell_m));
  if (cell.some((c, k) => c < 0 || c >= size[k])) return false;
  const index = (cell[0] * size[1] + cell[1]) * size[2] + cell[2];
  let end = 0;
  return runs.findIndex((length) => (end += length) > index) % 2 === 1;
}

/** Makes a run in `place` with `halfstep`, by the baked volumes of `cache`. */
export async function testVolumes(browser, halfstep, place, cache) {
  writeFileSync(join(place, "planned.yaml"), config(cache || place));
  execFileSync(halfstep, ["run", "planned.yaml", "--out", "planned", "--quiet"], { cwd: place });
  const volumes = JSON.parse(readFileSync(join(place, "planned/swept_volumes.json"), "utf8"));
  const plan = rowsOf(join(place, "planned/raw/trajectory.csv"));
  assert.equal(volumes.half_steps[0], null, "the first half-step is in no set");
  let asked = 0;
  for (const row of plan) {
    const half = volumes.half_steps[Number(row.half_step) - 1];
    if (!half) continue;
    for (const foot of ["left", "right"]) {
      const sole = ["x_m", "y_m", "z_m"].map((axis) => Number(row[`${foot}_foot_${axis}`]));
      assert.ok(contains(volumes, half, [sole[0], sole[1], sole[2] + 0.03]), `${foot} foot at ${row.t_s} s`);
      ++asked;
    }
  }
  assert.ok(asked > 500, `${asked} points of feet`);
  assert.ok(!contains(volumes, volumes.half_steps[1], [3, 0, 0.5]));
  const size = statSync(join(place, "planned/report.html")).size;
  assert.ok(size < 5e6, `${size} bytes`);

  await browser.load("about:blank");
  await browser.load(`file://${place}/planned/report.html#t=2&b=none`);
  const picture = async () => readPng(await browser.picture("#canvas"));
  await pause(500);
  const without = await picture();
  await browser.key("v");
  assert.ok(await browser.run("return document.getElementById('show-volumes').checked"), "v shows them");
  assert.match(await browser.run("return document.getElementById('volumes-note').innerText"), /cells of 2 cm/);
  const deadline = Date.now() + 20000;
  let part = 0;
  while ((part = partThatDiffers(without, await picture())) < 0.02 && Date.now() < deadline) await pause(100);
  assert.ok(part >= 0.02, `the volumes are drawn: ${part}`);
  assert.deepEqual(await browser.console(), [], "the console is empty");
  await browser.load("about:blank");
  await browser.load(`file://${place}/run/report.html`);
  assert.ok(!(await browser.run("return document.getElementById('show-volumes').checkVisibility()")),
            "a run that did not plan has none");
}
