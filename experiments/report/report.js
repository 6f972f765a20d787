// Brings a report's data and the page together.
import { Actor, footprints } from "./actor.js";
import { anytimePlot } from "./anytime.js";
import { Plots } from "./plots.js";
import { RobotShapes } from "./robot.js";
import { plotList } from "./series.js";
import { Stage } from "./stage.js";
import { guarantee, junctionTable, scenarioTable, summaryTable } from "./tables.js";
import { Timeline } from "./timeline.js";
import { instants } from "./traces.js";
import { Walk } from "./walk.js";
import { ZmpMap } from "./zmp_map.js";

const byId = (id) => document.getElementById(id);
const report = JSON.parse(byId("data").textContent);
const cases = report.cases.map((one) => ({ ...one, walks: one.walks.map((walk) => new Walk(walk)) }));

const layers = [
  ["footprints", "footprints", true],
  ["balance", "ZMP, CoM, support polygon", true],
  ["paths", "paths", false],
  ["soles", "sole traces (sampled)", false],
  ["strobe", `body at ${instants} instants`, false],
];

let stage = null;
try {
  stage = new Stage(byId("canvas"), () => redraw());
} catch {
  byId("canvas").hidden = byId("scale").hidden = true;
  byId("no-webgl").hidden = false;
}

const shapes = report.robots.map((robot) => (stage ? new RobotShapes(robot) : null));
const plots = new Plots(byId("plots"), (t) => timeline.seek(t));
const zmpMap = new ZmpMap(byId("zmps"));
const timeline = new Timeline(() => showTime());
let current = null; // the case
let walks = []; // A, and B when there is one
let actors = [];
let pending = false;

function waistNow(walk) {
  const at = walk.locate(timeline.t);
  return [walk.value("waist_x_m", at), walk.value("waist_y_m", at)];
}

function redraw() {
  if (!stage || pending || actors.length === 0) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    const beside = actors.length === 2 && byId("layout").value === "beside";
    if (!beside) return stage.draw([{ layers: [1, 2], shift: [0, 0] }]);
    // Each view follows its own robot.
    const [a, b] = walks.map(waistNow);
    const shift = byId("follow").checked ? [b[0] - a[0], b[1] - a[1]] : [0, 0];
    stage.draw([{ layers: [1], shift: [0, 0] }, { layers: [2], shift }]);
  });
}

function showTime() {
  const t = timeline.t;
  for (const actor of actors) actor.pose(t);
  stage?.showTime(t);
  if (actors.length > 0 && byId("follow").checked) {
    stage.followTo(...waistNow(walks[0]));
  }
  ["a", "b"].forEach((name, i) => {
    const walk = walks[i];
    if (!walk) return;
    const half = walk.halfStepAt(walk.locate(t));
    const state = t >= walk.duration ? `at its end, ${walk.duration.toFixed(2)} s`
      : half ? `half-step ${half.half_step} of ${walk.halfSteps.length}, ${half.kind}` : "";
    byId(`tag-${name}`).textContent = `${name.toUpperCase()} ${walk.label}: ${state}`;
  });
  plots.showTime(t);
  zmpMap.showTime(t);
  redraw();
}

function look() {
  if (!stage || walks.length === 0 || !walks[0].drawn) return;
  const feet = current.footsteps;
  const xs = feet.map((step) => step.x_m);
  const ys = feet.map((step) => step.y_m);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const extent = Math.hypot(x1 - x0, y1 - y0);
  if (byId("follow").checked) {
    stage.look(byId("camera").value, waistNow(walks[0]), 2.75);
  } else {
    stage.look(byId("camera").value, [(x0 + x1) / 2, (y0 + y1) / 2], 2.3 + 0.62 * extent);
  }
  redraw();
}

function stageWalks() {
  if (!stage) return;
  for (const actor of actors) {
    stage.scene.remove(actor.group);
    actor.dispose();
  }
  const ghost = byId("layout").value === "ghost";
  actors = walks.map((walk, i) =>
    new Actor(walk, shapes[current.robot], i + 1, ghost && i === 1));
  for (const actor of actors) stage.scene.add(actor.group);
  byId("view").classList.toggle("beside", walks.length === 2 && !ghost);
  applyLayers();
}

function applyLayers() {
  for (const [name] of layers) {
    const visible = byId(`show-${name}`).checked;
    if (name === "footprints") {
      if (stage?.prints) stage.prints.visible = visible;
    } else {
      for (const actor of actors) actor.show(name, visible);
    }
  }
  redraw();
}

function chooseWalks() {
  const drawn = current.walks.filter((walk) => walk.drawn);
  const a = drawn[byId("method-a").selectedIndex];
  const b = drawn[byId("method-b").selectedIndex - 1];
  walks = !a ? [] : b && b !== a ? [a, b] : [a];
  byId("layout-choice").hidden = walks.length < 2;
  byId("tag-b").hidden = walks.length < 2;
  if (!a) return;
  stageWalks();
  plots.show(plotList(report.robots[current.robot], a.certificate, report.families), walks);
  zmpMap.show(a, current.footsteps, report.robots[current.robot].sole);
  timeline.setDuration(Math.max(...walks.map((walk) => walk.duration)));
  timeline.showPhases(walks);
  junctionTable(byId("junctions"), walks);
  const { duration_s: duration, speedup } = a.summary;
  byId("outcome").textContent = `A: ${duration.toFixed(3)} s` +
    (a.method === "raw" ? "" : `, ${speedup.toFixed(2)} × as fast as raw`) +
    (a.certified ? ", proved for all t" : ", not proved");
}

// The fastest proved walk beside the planned motion.
function firstChoice(drawn) {
  const smoothed = drawn.filter((walk) => walk.method !== "raw");
  const proved = smoothed.filter((walk) => walk.certified && walk.summary.own);
  const list = proved.length ? proved : smoothed.length ? smoothed : drawn;
  return list.reduce((best, walk) => (walk.duration < best.duration ? walk : best), list[0]);
}

function chooseCase(index) {
  current = cases[index];
  const drawn = current.walks.filter((walk) => walk.drawn);
  const options = () => drawn.map((walk, i) => new Option(walk.label, i));
  byId("method-a").replaceChildren(...options());
  byId("method-b").replaceChildren(new Option("none", -1), ...options());
  const first = drawn.indexOf(firstChoice(drawn));
  byId("method-a").selectedIndex = first;
  const raw = drawn.findIndex((walk) => walk.method === "raw");
  byId("method-b").selectedIndex = raw === first ? 0 : raw + 1;
  summaryTable(byId("summary"), current.walks, report.families, report.endings);
  if (cases.length > 1) byId("summary").append(...scenarioTable(cases));
  anytimePlot(byId("anytime"), current.walks);
  guarantee(byId("guarantee"), report.statement, current.walks);
  byId("stage").hidden = byId("plots").hidden = drawn.length === 0;
  const halfSteps = drawn[0]?.halfSteps.length;
  byId("subtitle").textContent = current.not_drawn
    ? `not drawn: ${current.not_drawn}`
    : `${report.robots[current.robot].name}, scene ${report.scenes[current.scene].name}, ` +
      `${halfSteps} half-steps, objective ${current.objective ?? report.objective}`;
  if (drawn.length === 0) return;
  if (stage) {
    stage.setScene(report.scenes[current.scene]);
    stage.prints = footprints(current.footsteps, report.robots[current.robot].sole);
    stage.place.add(stage.prints);
  }
  const feet = current.footsteps;
  byId("follow").checked =
    feet.some((p) => Math.hypot(p.x_m - feet[0].x_m, p.y_m - feet[0].y_m) > 1.6);
  timeline.t = 0;
  chooseWalks();
  look();
}

function start() {
  const title = report.name ??
    (cases.length === 1 ? `${cases[0].scenario}, compared` : `Comparison of ${cases.length} scenarios`);
  document.title = `${title} – halfstep`;
  byId("title").textContent = title;
  for (const [name, label, checked] of layers) {
    const box = document.createElement("input");
    box.type = "checkbox";
    box.id = `show-${name}`;
    box.checked = checked;
    box.addEventListener("change", applyLayers);
    const choice = document.createElement("label");
    choice.append(box, label);
    byId("shown").append(choice);
  }
  cases.forEach((one, i) => byId("scenario").add(new Option(`${one.scenario}, ${one.objective ?? ""}`, i)));
  byId("scenario-choice").hidden = cases.length < 2;
  byId("scenario").addEventListener("change", () => chooseCase(byId("scenario").selectedIndex));
  byId("method-a").addEventListener("change", chooseWalks);
  byId("method-b").addEventListener("change", chooseWalks);
  byId("layout").addEventListener("change", () => { stageWalks(); showTime(); });
  byId("camera").addEventListener("change", look);
  byId("follow").addEventListener("change", look);
  new ResizeObserver(redraw).observe(byId("view"));
  if (cases.length > 0) chooseCase(0);
}

start();
