// Brings a report's data and the page together.
import { Actor, footprints } from "./actor.js";
import { connectActions } from "./actions.js";
import { readAddress } from "./address.js";
import { firstChoice, isInfeasible, secondChoice } from "./choices.js";
import { filmByCommand } from "./film.js";
import { filmedPage } from "./filmed.js";
import { extentOf } from "./floor_marks.js";
import { handWalk } from "./hand_walk.js";
import { addLayerBoxes, layers, offerLayer } from "./layers.js";
import { firstSentence, gravestInstant, infeasibleList, infeasibleOf } from "./infeasible.js";
import { tellingInstant, worstInstant } from "./least_margins.js";
import { leastTable } from "./least_table.js";
import { methodCharts } from "./method_charts.js";
import { middleOf } from "./pair_line.js";
import * as palette from "./palette.js";
import { paretoPlots } from "./pareto.js";
import { Plots } from "./plots.js";
import { RobotShapes } from "./robot.js";
import { plotList } from "./series.js";
import { Sliders } from "./sliders.js";
import { stageOfPage } from "./stage.js";
import { volumesInPlaceOf } from "./swept_volumes.js";
import { guarantee, junctionTable, scenarioTable, summaryTable } from "./tables.js";
import { Timeline } from "./timeline.js";
import { Walk } from "./walk.js";
import { tellInstant, tellOutcome } from "./words.js";
import { ZmpMap } from "./zmp_map.js";

const byId = (id) => document.getElementById(id);
const report = JSON.parse(byId("data").textContent);
const cases = report.cases.map((one) => ({ ...one, walks: one.walks.map((walk) => new Walk(walk)) }));

const darkness = window.matchMedia("(prefers-color-scheme: dark)");
palette.useTheme(darkness.matches);

const stage = stageOfPage(() => redraw());

const shapes = report.robots.map((robot) => (stage ? new RobotShapes(robot) : null));
const plots = new Plots(byId("plots"), (t) => timeline.seek(t));
const zmpMap = new ZmpMap(byId("zmps"));
const timeline = new Timeline(() => showTime());
const sliders = new Sliders(byId("by-hand"), (parameters) => moveByHand(parameters));
let current = null; // the case
let volumes = null; // the plan's, where they are known
let hand = null; // the walk by hand
let walks = []; // A, and B when there is one
let actors = [];
let pending = false;
let filming = false; // frames of a film are drawn at once, and not again

// What the camera follows: the waist, or the middle between the feet; and the ground's height there.
function centreNow(walk) {
  const at = walk.locate(timeline.t);
  const of = (name) => walk.value(name, at);
  const ground = walk.groundAt(at);
  if (byId("camera").value !== "feet") return [of("waist_x_m"), of("waist_y_m"), ground];
  return [...["x_m", "y_m"].map((axis) => (of(`left_foot_${axis}`) + of(`right_foot_${axis}`)) / 2), ground];
}

function draw() {
  const beside = actors.length === 2 && byId("layout").value === "beside";
  if (!beside) return stage.draw([{ layers: [1, 2], shift: [0, 0] }]);
  // Each view follows its own robot.
  const [a, b] = walks.map(centreNow);
  const shift = byId("follow").checked ? b.map((to, k) => to - a[k]) : [0, 0];
  stage.draw([{ layers: [1], shift: [0, 0] }, { layers: [2], shift }]);
}

function redraw() {
  if (!stage || pending || filming || actors.length === 0) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    draw();
  });
}

function showTime() {
  const t = timeline.t;
  for (const actor of actors) actor.pose(t);
  stage?.showTime(t);
  volumes?.showHalfSteps(walks.map((walk) => (walk.halfStepAt(walk.locate(t))?.half_step ?? 0) - 1));
  if (actors.length > 0 && byId("follow").checked) {
    stage.followTo(...centreNow(walks[0]));
  }
  tellInstant(walks, t);
  plots.showTime(t);
  zmpMap.showTime(t);
  redraw();
}

// Shows the instant of a margin; the camera goes where a pair of bodies is nearest.
function goTo({ t, pair }) {
  timeline.toggle(false);
  timeline.seek(t);
  if (!pair || !stage) return;
  const [x, y, z] = middleOf(pair);
  byId("camera").value = "feet";
  byId("follow").checked = false;
  stage.look("feet", [x, y, z], 1.15, 0);
  redraw();
}

const goToWorst = () => {
  const worst = walks[0] && (gravestInstant(current, walks[0]) ?? worstInstant(walks[0], report.families));
  if (worst) goTo(worst);
};

function look() {
  if (!stage || walks.length === 0 || !walks[0].drawn) return;
  const { middle, extent } = extentOf(current.footsteps);
  if (byId("camera").value === "feet") {
    stage.look("feet", centreNow(walks[0]), 1.6, 0.15);
  } else if (byId("follow").checked) {
    stage.look(byId("camera").value, centreNow(walks[0]), 2.75);
  } else {
    stage.look(byId("camera").value, middle, 2.3, 0.68, 0.62 * extent);
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
    } else if (name === "volumes") {
      volumes?.show(visible);
      byId("volumes-note").hidden = !visible;
    } else {
      for (const actor of actors) actor.show(name, visible);
    }
  }
  if (volumes && walks[0]) showTime();
  redraw();
}

// The walk by hand as A, beside the one that it was made of; null: no longer.
function moveByHand(parameters) {
  const base = sliders.walk;
  hand = parameters && handWalk(base, current.closed_form, report.robots[current.robot], parameters);
  if (hand) sliders.tell(hand);
  chooseWalks();
}

function chooseWalks() {
  const drawn = current.walks.filter((walk) => walk.drawn);
  const chosen = drawn[byId("method-a").selectedIndex];
  if (sliders.walk !== chosen) hand = null;
  sliders.show(chosen, current.closed_form);
  const a = hand ?? chosen;
  const b = hand ? chosen : drawn[byId("method-b").selectedIndex - 1];
  walks = !a ? [] : b && b !== a ? [a, b] : [a];
  byId("layout-choice").hidden = byId("pace-choice").hidden = walks.length < 2;
  const shortest = Math.min(...walks.map((walk) => walk.duration));
  const squeezed = byId("pace").value === "squeezed" && walks.length === 2;
  if (squeezed) {
    walks = walks.map((walk) => (walk.duration > shortest ? walk.stretchedTo(shortest) : walk));
  }
  byId("tag-b").hidden = walks.length < 2;
  if (!a) return;
  stageWalks();
  plots.show(plotList(report.robots[current.robot], a, report.families), walks,
             squeezed ? "time [s], of the longer walk squeezed" : "time [s]");
  infeasibleList(byId("infeasible"), current, walks[0], goTo);
  leastTable(byId("least"), walks[0], report.families, goTo);
  zmpMap.show(walks[0], current.footsteps, report.robots[current.robot].sole);
  timeline.setDuration(Math.max(...walks.map((walk) => walk.duration)));
  timeline.showPhases(walks);
  junctionTable(byId("junctions"), walks);
  tellOutcome(a, firstSentence(infeasibleOf(current, a)));
}

// What an address asks for, of a case that is chosen.
function applyAddress(asked = readAddress()) {
  const drawn = current.walks.filter((walk) => walk.drawn);
  const index = (name) => drawn.findIndex((walk) => walk.label === name);
  if (index(asked.a) >= 0) byId("method-a").selectedIndex = index(asked.a);
  if (asked.b === "none" || index(asked.b) >= 0) byId("method-b").selectedIndex = index(asked.b) + 1;
  if (index(asked.a) >= 0 || asked.b !== undefined) chooseWalks();
  if ([...byId("camera").options].some((option) => option.value === asked.camera)) {
    byId("camera").value = asked.camera;
    look();
  }
  const t = Number.parseFloat(asked.t);
  if (Number.isFinite(t)) timeline.seek(t);
  return Number.isFinite(t);
}

function addressNow() {
  const [a, b] = walks;
  const shown = { t: String(Number(timeline.t.toFixed(3))), a: a?.label ?? "", b: b?.label ?? "none" };
  return cases.length > 1 ? { ...shown, scenario: current.scenario } : shown;
}

function chooseCase(index) {
  current = cases[index];
  const drawn = current.walks.filter((walk) => walk.drawn);
  const options = () => drawn.map((walk, i) => new Option(walk.label, i));
  byId("method-a").replaceChildren(...options());
  byId("method-b").replaceChildren(new Option("none", -1), ...options());
  const first = firstChoice(drawn);
  byId("method-a").selectedIndex = drawn.indexOf(first);
  byId("method-b").selectedIndex = drawn.indexOf(secondChoice(drawn, first)) + 1;
  summaryTable(byId("summary"), current.walks, report.families, report.endings);
  if (cases.length > 1) byId("summary").append(...scenarioTable(cases));
  methodCharts(current, cases, report.profiles ?? []);
  paretoPlots(byId("pareto"), current.walks, report.families);
  guarantee(byId("guarantee"), report.statement, current.walks);
  byId("stage").hidden = byId("plots").hidden = byId("least").hidden = drawn.length === 0;
  const halfSteps = drawn[0]?.halfSteps.length;
  byId("subtitle").textContent = current.not_drawn
    ? `not drawn: ${current.not_drawn}`
    : `${report.robots[current.robot].name}, scene ${report.scenes[current.scene].name}, ` +
      `${halfSteps} half-steps, objective ${current.objective ?? report.objective}`;
  byId("infeasible").hidden = true;
  if (drawn.length === 0) return;
  if (stage) {
    stage.setScene(report.scenes[current.scene]);
    stage.scale = shapes[current.robot].scale;
    stage.prints = footprints(current.footsteps, report.robots[current.robot].sole);
    stage.place.add(stage.prints);
  }
  volumes = stage && volumesInPlaceOf(volumes, stage, current.swept_volumes, byId("volumes-note"));
  offerLayer("volumes", Boolean(volumes));
  const feet = current.footsteps;
  byId("follow").checked =
    feet.some((p) => Math.hypot(p.x_m - feet[0].x_m, p.y_m - feet[0].y_m) > 1.6);
  timeline.t = 0;
  chooseWalks();
  look();
  if (applyAddress()) return;
  if (isInfeasible(drawn)) goToWorst();
  else timeline.seek(tellingInstant(walks[0], report.families)?.t ?? 0);
}

// The colours of what is drawn change with the system's.
function changeTheme() {
  palette.useTheme(darkness.matches);
  stage?.useTheme();
  const shown = addressNow();
  const index = byId("scenario").selectedIndex;
  const [a, b] = ["method-a", "method-b"].map((id) => byId(id).selectedIndex);
  chooseCase(Math.max(0, index));
  byId("method-a").selectedIndex = a;
  byId("method-b").selectedIndex = b;
  chooseWalks();
  timeline.seek(Number(shown.t));
}

const filmed = filmedPage({
  hasView: () => stage !== null && actors.length > 0,
  walks: () => walks,
  timeline, applyAddress,
  draw(t) {
    filming = true;
    timeline.seek(t);
    filming = false;
    draw();
  },
  drawnWalks: () => current.walks.filter((walk) => walk.drawn),
});

function start() {
  const title = report.name ??
    (cases.length === 1 ? `${cases[0].scenario}, compared` : `Comparison of ${cases.length} scenarios`);
  document.title = `${title} – halfstep`;
  byId("title").textContent = title;
  addLayerBoxes(byId("shown"), applyLayers);
  cases.forEach((one, i) => byId("scenario").add(new Option(`${one.scenario}, ${one.objective ?? ""}`, i)));
  byId("scenario-choice").hidden = cases.length < 2;
  byId("scenario").addEventListener("change", () => chooseCase(byId("scenario").selectedIndex));
  byId("method-a").addEventListener("change", chooseWalks);
  byId("method-b").addEventListener("change", chooseWalks);
  byId("pace").addEventListener("change", chooseWalks);
  byId("layout").addEventListener("change", () => { stageWalks(); showTime(); });
  byId("camera").addEventListener("change", look);
  byId("follow").addEventListener("change", look);
  new ResizeObserver(redraw).observe(byId("view"));
  const toggleVolumes = () => { if (volumes) byId("show-volumes").click(); };
  connectActions({ stage, timeline, draw, goToWorst, addressNow, toggleVolumes, film: filmed });
  window.halfstepFilm = filmByCommand(filmed);
  window.halfstepByHand = { rows: (times) => sliders.rowsAt(times, report.robots[current.robot]) };
  window.addEventListener("hashchange", () => applyAddress());
  darkness.addEventListener("change", changeTheme);
  const asked = cases.findIndex((one) => one.scenario === readAddress().scenario);
  if (asked > 0) byId("scenario").selectedIndex = asked;
  if (cases.length > 0) chooseCase(Math.max(0, asked));
}

start();
