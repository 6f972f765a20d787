// What a person does to a running episode: drag, add, remove, pause, stop.

const sendPeriod = 150; // while something is dragged [ms]
const boxAhead = 0.9; // where a box appears: ahead of the robot, and beside the way [m]
const boxBeside = 0.55;

const byId = (id) => document.getElementById(id);

export class LiveControls {
  /** `send(message)`; `view()`: the LiveView, or null; `record`. */
  constructor(send, view, record) {
    this.send = send;
    this.view = view;
    this.record = record;
    this.sent = 0;
    this.selected = null;
    byId("controls").hidden = false;
    byId("hold").addEventListener("click", () => this.send({ type: this.held() ? "release" : "hold" }));
    byId("add").addEventListener("click", () => this.addBox());
    byId("remove").addEventListener("click", () => this.send({ type: "remove", obstacle: this.selected }));
    byId("stop").addEventListener("click", () => this.send({ type: "end" }));
    byId("again").addEventListener("click", () => this.send({ type: "again" }));
  }

  held() { return this.record.state?.held ?? false; }

  /** A drag: `name` is to go to [x, y]; the last time when `done`. */
  move(name, [x, y], done) {
    const now = performance.now();
    if (!done && now - this.sent < sendPeriod) return;
    this.sent = now;
    if (name === "goal") this.send({ type: "goal", x_m: x, y_m: y });
    else this.send({ type: "carry", obstacle: name, xyz_m: [x, y, this.height(name)] });
  }

  // What lies on the floor stays there, whatever the noise of its measurement.
  height(name) {
    const { mesh, box } = this.view().obstacles.get(name);
    const z = mesh.position.z;
    return Math.abs(z + box.min.z) < 0.03 ? -box.min.z : z;
  }

  spare() {
    const there = new Set(this.record.worlds.at(-1)?.obstacles.map(({ name }) => name));
    return (this.record.hello?.spare ?? []).filter((name) => !there.has(name));
  }

  addBox() {
    const [name] = this.spare();
    const view = this.view();
    const { x, y } = view.waist ?? { x: 0, y: 0 };
    const goal = view.goal.position;
    const way = Math.atan2(goal.y - y, goal.x - x);
    const [c, s] = [Math.cos(way), Math.sin(way)];
    this.send({ type: "add", xyz_m: [
      x + boxAhead * c - boxBeside * s, y + boxAhead * s + boxBeside * c, -view.obstacles.get(name).box.min.z,
    ] });
  }

  /** Whether the episode was asked for the swept volumes of the plan. */
  askForVolumes() { return this.send({ type: "volumes" }); }

  select(name) { this.selected = name; }

  /** What can be done now, as the buttons say it. */
  draw(isOpen) {
    const running = isOpen && !this.record.end;
    const standIn = this.record.hello?.source !== "client";
    const spare = this.spare().length;
    const removable = this.selected !== null && this.selected !== "goal" &&
      (this.record.worlds.at(-1)?.obstacles.some(({ name }) => name === this.selected) ?? false);
    for (const id of ["hold", "stop", "again"]) byId(id).disabled = !running;
    byId("hold").textContent = this.held() ? "Walk on" : "Pause robot";
    byId("hold").setAttribute("aria-pressed", this.held());
    byId("add").disabled = !running || !standIn || spare === 0 || !this.view();
    byId("add").textContent = `Add box (${spare} left)`;
    byId("remove").disabled = !running || !standIn || !removable;
    byId("selected").textContent = removable ? this.selected : "";
    if (!standIn) byId("hint").textContent = "obstacles are measured by a client: nothing can be dragged here";
  }
}
