// Brings a sweep's data and its page together.
import { readAddress } from "./address.js";
import { Boxes } from "./boxes.js";
import { showCases } from "./chosen_cases.js";
import { element, table } from "./elements.js";
import { HeatMap } from "./heat_map.js";
import * as palette from "./palette.js";
import { Profile, profileOf } from "./profiles.js";
import { Cases, keyLabel } from "./sweep_cases.js";
import { Lines } from "./sweep_lines.js";

const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);
const cases = new Cases(data);
const darkness = window.matchMedia("(prefers-color-scheme: dark)");
const choose = (list, words) => showCases(byId("chosen"), cases, list, words);
const heatMap = new HeatMap(byId("map"), choose);
const lines = new Lines(byId("lines"), choose);
const boxes = new Boxes(byId("boxes"));
const profile = new Profile(byId("profile"));
const fixed = cases.axes.map(() => undefined); // index of a value, or undefined: all

const count = (n, word) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;

function showWords() {
  document.title = `${data.name} – halfstep`;
  byId("title").textContent = data.name;
  const varied = cases.axes.map((axis) => `${axis.label} (${axis.of})`).join(" × ");
  const same = data.constants.map(([key, value]) => `${keyLabel(key)} ${value}`).join(", ");
  byId("subtitle").textContent = `Sweep of ${count(data.cases, "case")}` +
    (varied ? `: ${varied}` : "") + (same ? `; the same in every case: ${same}` : "");
  const thinned = cases.axes.filter((axis) => axis.size < axis.of);
  byId("thinned").hidden = thinned.length === 0;
  byId("thinned").textContent = `Drawn are ${count(cases.ids.length, "case")} of ${data.cases.toLocaleString("en")}, so ` +
    `that the page stays small: ${thinned.map((axis) => `every ${axis.stride}${axis.stride % 10 === 2 ? "nd" : "th"} value of ${axis.label}`).join(", ")}. ` +
    "The table of endings counts all of them, and runs.csv has them.";
  byId("made").textContent = `halfstep ${data.version}, ${data.commit}. What is shown stands in runs.csv; run times are ` +
    "in timings.csv and not here, so that the same sweep makes the same page.";
}

// Of all rows, also of those that are not drawn.
function showCounts() {
  const rows = Object.entries(data.counts).flatMap(([method, statuses]) =>
    Object.entries(statuses).map(([status, [all, solved]]) => [
      method === "none" ? "case without a walk" : method,
      status, String(all), String(solved), data.meanings[status] ?? ""]));
  byId("counts").replaceChildren(element("h2", { text: "How the cases ended" }),
    table(["method", "status", "cases", "with a proved walk of its own", "meaning"], rows));
}

function kindsOfProfile() {
  const kind = (label, name, methods, note) => {
    const values = methods.map((m) => cases.ids.map((_, i) =>
      (cases.has(m, i) && cases.tables[m].solved[i] ? cases.tables[m][name][i] : null)));
    return { label, note, curves: profileOf(values, cases.ids.length)
      .map((points, k) => ({ name: cases.methods[methods[k]], colour: methods[k], points })) };
  };
  const all = cases.methods.map((_, m) => m);
  const searching = all.filter((m) => m !== cases.raw);
  return [
    ...(all.length > 1 ? [kind("duration of the walk", "duration", all, "A case is solved by a proved walk of the method's own.")] : []),
    ...(searching.length > 1 ? [kind("effort", "effort", searching, "Work until the method's end; 1 is about a second of one core of 2026.")] : []),
  ];
}

function boxGroups(what) {
  return cases.methods.map((label, m) => ({
    label, colour: m, all: cases.ids.filter((_, i) => cases.has(m, i)).length,
    values: cases.ids.map((_, i) => cases.value(what, m, i)).filter((value) => value !== null),
  }));
}

// One selection for each key that is neither across nor up.
function makeOthers(used) {
  byId("others").replaceChildren(...cases.axes.flatMap((axis, k) => {
    if (used.includes(k)) return [];
    const select = element("select", {}, new Option(`all ${axis.size}: median`, ""),
      ...axis.texts.map((words, i) => new Option(words, i)));
    select.value = fixed[k] === undefined ? "" : String(fixed[k]);
    select.addEventListener("change", () => {
      fixed[k] = select.value === "" ? undefined : Number(select.value);
      showCharts();
      writeAddress();
    });
    return [element("label", { text: `${axis.label} ` }, select)];
  }));
}

const chosenAxes = () => [Number(byId("x").value), Number(byId("y").value)];

function showCharts() {
  const what = cases.quantities[byId("what").selectedIndex];
  const m = byId("method").selectedIndex;
  const [x, y] = chosenAxes();
  byId("map").hidden = cases.axes.length < 2;
  byId("lines").hidden = cases.axes.length < 1;
  if (cases.axes.length >= 2) heatMap.show(cases, what, m, x, y, fixed);
  if (cases.axes.length >= 1) lines.show(cases, what, m, x, fixed.map((k, axis) => (axis === y ? undefined : k)));
  boxes.show(what.label, boxGroups(what), "cases");
}

function chooseAxes(changed) {
  const [x, y] = chosenAxes();
  if (x === y && cases.axes.length > 1) { // the other one takes the place that became free
    byId(changed === "x" ? "y" : "x").value = String(before[changed]);
  }
  [before.x, before.y] = chosenAxes();
  heatMap.at = null;
  makeOthers(cases.axes.length > 1 ? chosenAxes() : [0]);
  showCharts();
  writeAddress();
}
const before = { x: 0, y: 1 };

function writeAddress() {
  const shown = { what: byId("what").value, method: byId("method").value };
  if (cases.axes.length > 0) shown.x = cases.axes[chosenAxes()[0]].keys[0];
  if (cases.axes.length > 1) shown.y = cases.axes[chosenAxes()[1]].keys[0];
  fixed.forEach((k, axis) => { if (k !== undefined) shown[`=${cases.axes[axis].keys[0]}`] = cases.axes[axis].texts[k]; });
  history.replaceState(null, "", `#${new URLSearchParams(shown)}`);
}

// What the page's address asks for.
function applyAddress() {
  const asked = readAddress();
  const axisOf = (key) => cases.axes.findIndex((axis) => axis.keys.includes(key));
  for (const id of ["what", "method"]) {
    if ([...byId(id).options].some((option) => option.value === asked[id])) byId(id).value = asked[id];
  }
  const [x, y] = [axisOf(asked.x), axisOf(asked.y)];
  if (x >= 0 && x !== y) {
    byId("x").value = String(x);
    if (cases.axes.length > 1) byId("y").value = String(y >= 0 ? y : (x + 1) % cases.axes.length);
  }
  cases.axes.forEach((axis, k) => {
    const at = axis.texts.indexOf(asked[`=${axis.keys[0]}`]);
    if (at >= 0) fixed[k] = at;
  });
}

function start() {
  palette.useTheme(darkness.matches);
  showWords();
  showCounts();
  byId("what").replaceChildren(...cases.quantities.map(({ name, label }) => new Option(label, name)));
  byId("method").replaceChildren(...cases.methods.map((method) => new Option(method, method)));
  byId("method").selectedIndex = cases.methods.length > 1 && cases.raw === 0 ? 1 : 0;
  byId("method-choice").hidden = cases.methods.length < 2;
  const options = () => cases.axes.map((axis, k) => new Option(axis.label, k));
  byId("x").replaceChildren(...options());
  byId("y").replaceChildren(...options());
  byId("x-choice").hidden = byId("y-choice").hidden = cases.axes.length < 2;
  if (cases.axes.length > 1) byId("y").value = "1";
  applyAddress();
  [before.x, before.y] = chosenAxes();
  makeOthers(cases.axes.length > 1 ? chosenAxes() : [0]);
  for (const id of ["what", "method"]) {
    byId(id).addEventListener("change", () => { showCharts(); writeAddress(); });
  }
  for (const id of ["x", "y"]) byId(id).addEventListener("change", () => chooseAxes(id));
  darkness.addEventListener("change", () => {
    palette.useTheme(darkness.matches);
    showCharts();
    profile.show(kindsOfProfile());
  });
  showCharts();
  profile.show(kindsOfProfile());
  byId("chosen").hidden = cases.ids.length !== 1;
  if (cases.ids.length === 1) choose([0], "");
}

start();
