// Brings an episode and the page together: as it goes on, over a WebSocket, or as it was recorded.
import { Dragging } from "./dragging.js";
import { EpisodeRecord, inWords, numHalfSteps } from "./episode_record.js";
import { Past, Rows, rowsOf } from "./instants.js";
import { Latency } from "./latency.js";
import { LiveControls } from "./live_controls.js";
import { LiveView, layers } from "./live_view.js";
import { handOverRows, legend, planRows, shortened, volumesNote } from "./live_words.js";
import * as palette from "./palette.js";
import * as THREE from "three";
import { SocketSource } from "./socket_source.js";
import { stageOfPage } from "./stage.js";
import { Timeline } from "./timeline.js";
import { Walk } from "./walk.js";

const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);
const recorded = data.messages !== undefined;
const shownEvents = 200;
const mostLetters = 150; // of an event; the pointer over it shows all
const slowFrame = 40; // [ms]
const longestRest = 300;
const motionSpan = 3; // of a recording's traces [s]
const ghostSpan = 4; // [s]

const darkness = window.matchMedia("(prefers-color-scheme: dark)");
palette.useTheme(darkness.matches);
darkness.addEventListener("change", () => {
  palette.useTheme(darkness.matches);
  stage?.useTheme();
  view?.useTheme();
  redraw();
});

const record = new EpisodeRecord();
const stage = stageOfPage(() => redraw());
let view = null; // once it is known what to draw
let past = null; // of the live robot
let following = true; // what is shown is the robot as it is, not as it was
let walk = null; // the recorded motion
let timeline = null;
let controls = null;
let dragging = null;
let isOpen = false;
let pending = false; // a picture is being made
let again = false; // and another one is wanted

const latency = new Latency(byId("latency"), byId("latency-words"), data.clock);

function now() {
  return timeline ? timeline.t : record.worlds.at(-1)?.known_s ?? 0;
}

// A machine that draws slowly, as one without a graphics card, rests as long as it drew, or 0.3 s: a live
// robot thinks on the same machine.
function redraw() {
  again = pending;
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    const begin = performance.now();
    show();
    requestAnimationFrame(() => {
      const drew = performance.now() - begin;
      const next = () => {
        pending = false;
        if (again) redraw();
        again = false;
      };
      if (drew > slowFrame) setTimeout(next, Math.min(drew, longestRest));
      else next();
    });
  });
}

// What the live robot told of an instant; undefined before it began to walk.
const stateAt = (t) => (past?.states.length ? past.stateAt(t) : undefined);

// The latest half-step that has begun.
function begunAt(t) {
  if (!walk) return stateAt(t)?.half_step ?? 0;
  return Math.round(walk.column("half_step")[walk.locate(t).row]);
}

function show() {
  const t = now();
  const world = record.worldAt(t);
  const plan = record.walkAt(t);
  const begun = begunAt(t);
  const grant = record.grantAt(t);
  if (view) drawView(t, world, plan, begun, grant);
  controls?.draw(isOpen);
  byId("state").textContent = stateText(t, plan, begun);
  planRows(byId("plan"), { t, plan, grant, world, begun });
  const handedOver = record.walks.filter((one) => one.handed_over_s <= t);
  latency.show(handedOver);
  handOverRows(byId("hand-overs"), handedOver);
  showEvents(record.eventsUntil(t));
}

function showEvents(events) {
  const log = byId("log");
  const count = `${events.length} ${events.at(-1)?.t_s}`;
  if (log.dataset.count === count) return;
  log.dataset.count = count;
  const lines = events.map((event, i) => inWords(event, events.slice(Math.max(0, i - 20), i)))
    .filter(Boolean).slice(-shownEvents).reverse();
  if (log.dataset.key === lines.join("\n")) return;
  log.dataset.key = lines.join("\n");
  log.replaceChildren(...lines.map((line) => {
    const textContent = shortened(line, mostLetters);
    return Object.assign(document.createElement("li"), { textContent, title: line });
  }));
}

function drawView(t, world, plan, begun, grant) {
  const robot = walk ?? (past?.states.length ? past : null);
  if (robot) {
    view.showRobot(robot, t);
    if (byId("follow").checked && !dragging.held) stage.followTo(...ahead());
  }
  if (world) view.showWorld(world, t);
  if (plan) {
    const through = grant && grant.walk === plan.walk ? grant.through : begun;
    view.showPlan(plan, begun, Math.max(through, begun));
  }
  view.showReplaced(record.replaced(t, ghostSpan));
  showMotion(t);
  showVolumes(begun);
  dragging.show(world ? thingsIn(world) : []);
  stage.draw([{ layers: [1, 2], shift: [0, 0] }]);
  dragging.draw();
}

// Traces of what is to come; a recording has what was executed.
let motionKey = null;
function showMotion(t) {
  const key = walk || !following ? Math.floor(t / 0.2) : record.motion;
  const full = `${byId("show-strobe").checked}`;
  if (key === motionKey?.[0] && full === motionKey[1]) return;
  motionKey = [key, full];
  if (walk) view.showMotion(rowsOf(walk, t, motionSpan));
  else if (!following) view.showMotion(new Rows(record.hello.columns, past.rowsFrom(t, motionSpan)));
  else if (record.motion) view.showMotion(new Rows(record.hello.columns, record.motion.rows));
}

// Volumes are asked for when they are first wanted.
let askedForVolumes = false;
function showVolumes(begun) {
  const wanted = byId("show-volumes").checked;
  if (wanted && !askedForVolumes) askedForVolumes = controls?.askForVolumes() ?? false;
  volumesNote(byId("volumes-note"), wanted && record.volumes, record.cells, view.showVolumes(record, begun));
}

function thingsIn(world) {
  const things = world.obstacles.filter(({ name }) => view.obstacles.has(name)).map(({ name }) => {
    const { mesh } = view.obstacles.get(name);
    const box = new THREE.Box3().setFromObject(mesh);
    return { name, mesh, anchor: new THREE.Vector3(mesh.position.x, mesh.position.y, box.max.z) };
  });
  const { x_m: x, y_m: y, z_m: z = 0 } = world.goal;
  return [...things, { name: "goal", mesh: view.goal, anchor: new THREE.Vector3(x, y, z + 0.01) }];
}

function stateText(t, plan, begun) {
  if (record.end && (!timeline || t >= timeline.duration)) {
    const { ending, message, promise, promise_status: status } = record.end;
    const but = status && status !== "kept" ? `; ${promise}` : "";
    return `${ending.replaceAll("_", " ")}${message ? `: ${message}` : ""} at ${t.toFixed(2)} s${but}`;
  }
  if (record.waiting !== null && !plan) return `waits for a walk: ${record.waiting}`;
  if (!plan) return "nothing is known yet";
  const state = stateAt(t);
  const rests = t >= plan.duration_s ? ", at rest" : state?.stopped ? ", nothing more begins" : "";
  const held = state?.held ? ", paused" : "";
  const was = !recorded && !following ? ", as it was" : "";
  return `${t.toFixed(2)} s, half-step ${begun} of ${numHalfSteps(plan)}${rests}${held}${was}`;
}

function makeView(drawn) {
  if (!stage) return;
  view = new LiveView(stage, drawn, record.hello);
  for (const [name] of layers) view.show(name, byId(`show-${name}`).checked);
  dragging = new Dragging(stage, byId("view"), byId("tags"), recorded ? null : moveThing, (name) => {
    controls?.select(name);
    redraw();
  });
  look();
}

function moveThing(name, to, done) {
  if (!following) return; // what was cannot be moved
  controls.move(name, to, done);
  const readout = byId("readout");
  readout.hidden = done;
  readout.textContent = `${name} to x ${to[0].toFixed(2)} m, y ${to[1].toFixed(2)} m`;
  redraw();
}

// A point of the floor between the robot and the goal, at most so far ahead of it [m].
function ahead() {
  const { x, y } = view.waist ?? { x: 0, y: 0 };
  const goal = record.worldAt(now())?.goal ?? { x_m: x, y_m: y };
  const [dx, dy] = [goal.x_m - x, goal.y_m - y];
  const part = Math.min(0.5, 0.8 / Math.max(1e-6, Math.hypot(dx, dy)));
  return [x + part * dx, y + part * dy, view.ground ?? 0];
}

function look() {
  if (!stage || !view) return;
  const { clientWidth: width, clientHeight: height } = stage.canvas;
  stage.look(byId("camera").value, ahead(), width < height ? 5 : 3.6, 0.35);
  redraw();
}

function take(message) {
  record.take(message);
  if (message.type === "hello") {
    document.title = `${message.name} – halfstep live`;
    byId("title").textContent = message.name;
    past = recorded ? null : new Past(message.columns);
  }
  if (message.type === "draw" && !view) makeView(message);
  if (message.type === "state") takeState(message);
  if (message.type === "error") {
    record.events.push({ t_s: now(), event: "error", text: message.text });
  }
}

// The time of a live robot goes on; who looks at what was stays there.
let extending = false;
function takeState(state) {
  past.add(state);
  if (!timeline) {
    timeline = new Timeline(() => {
      if (!extending) following = timeline.t >= timeline.duration - 1e-6;
      byId("now").hidden = following;
      redraw();
    });
    showTimeline();
  }
  extending = true;
  timeline.extend(past.duration, following);
  extending = false;
}

function showTimeline() {
  byId("timeline").hidden = false;
  byId("keys").textContent = "Keys: space plays, ← → move by 0.05 s, with shift by 0.5 s, Home and End. " +
    byId("keys").textContent;
  byId("restart").addEventListener("click", () => {
    timeline.seek(past?.begin ?? 0);
    timeline.toggle(true);
  });
  byId("now").addEventListener("click", () => {
    timeline.toggle(false);
    timeline.seek(timeline.duration);
  });
}

function play() {
  for (const message of data.messages) take(message);
  byId("connection").textContent = "recording";
  byId("outcome").hidden = false;
  byId("outcome").querySelector("p").textContent = data.outcome;
  if (!data.motion) return;
  walk = new Walk({ summary: { method: "executed" }, ...data.motion });
  timeline = new Timeline(redraw);
  showTimeline();
  timeline.setDuration(walk.duration);
  timeline.showPhases([walk]);
}

function connect() {
  const source = new SocketSource((message) => {
    take(message);
    redraw();
  }, (text, open) => {
    isOpen = open;
    byId("connection").textContent = text;
    byId("connection").className = open ? "yes" : "no";
    redraw();
  });
  controls = new LiveControls((message) => source.send(message), () => view, record);
}

function start() {
  for (const [name, label, checked] of layers) {
    const box = Object.assign(document.createElement("input"), { type: "checkbox", id: `show-${name}`, checked });
    box.addEventListener("change", () => {
      view?.show(name, box.checked);
      redraw();
    });
    const choice = document.createElement("label");
    choice.append(box, label);
    byId("choices").append(choice);
  }
  byId("show-volumes").parentElement.hidden = recorded;
  legend(byId("legend"), recorded);
  byId("camera").addEventListener("change", look);
  byId("follow").addEventListener("change", look);
  new ResizeObserver(redraw).observe(byId("view"));
  new ResizeObserver(redraw).observe(byId("side"));
  if (recorded) play();
  else connect();
  redraw();
}

start();
