// Labels of obstacles and goal, by which they are dragged along the floor; so are their bodies.
import * as THREE from "three";

const farthest = 15; // from the camera's target: a pointer near the horizon says nothing [m]
const keySteps = { ArrowUp: [0.05, 0], ArrowDown: [-0.05, 0], ArrowLeft: [0, 0.05], ArrowRight: [0, -0.05] };

export class Dragging {
  /**
   * `onMove(name, [x, y], done)`: where a thing is to go [m]. Without it labels are labels only.
   * `onSelect(name)` when one is chosen.
   */
  constructor(stage, view, parent, onMove, onSelect) {
    this.stage = stage;
    this.parent = parent;
    this.onMove = onMove;
    this.onSelect = onSelect;
    this.items = new Map(); // by name: {mesh or null, anchor, label}
    this.ray = new THREE.Raycaster();
    this.held = null;
    if (!onMove) return;
    view.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    window.addEventListener("pointermove", (event) => this.move(event, false));
    window.addEventListener("pointerup", (event) => this.move(event, true));
    window.addEventListener("pointercancel", (event) => this.move(event, true));
  }

  /** Things that can be dragged: [{name, mesh, anchor}], anchor: the point below the label, in W. */
  show(things) {
    const names = new Set(things.map(({ name }) => name));
    for (const [name, item] of this.items) {
      if (names.has(name)) continue;
      item.label.remove();
      this.items.delete(name);
    }
    for (const { name, mesh, anchor } of things) {
      if (!this.items.has(name)) this.items.set(name, { label: this.label(name) });
      Object.assign(this.items.get(name), { mesh, anchor });
    }
  }

  label(name) {
    const label = document.createElement(this.onMove ? "button" : "span");
    label.className = "tag-of";
    label.textContent = name;
    label.dataset.name = name;
    label.addEventListener("focus", () => this.select(name));
    label.addEventListener("keydown", (event) => this.key(event, name));
    this.parent.append(label);
    return label;
  }

  select(name) {
    this.selected = name;
    for (const [other, { label }] of this.items) label.classList.toggle("selected", other === name);
    this.onSelect?.(name);
  }

  key(event, name) {
    const step = keySteps[event.key];
    if (!step || !this.onMove) return;
    event.preventDefault();
    event.stopPropagation();
    const { anchor } = this.items.get(name);
    this.onMove(name, [anchor.x + step[0], anchor.y + step[1]], true);
  }

  aim(event) {
    const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
    this.stage.camera.layers.enableAll();
    this.ray.layers.enableAll();
    this.ray.setFromCamera(new THREE.Vector2(
      (2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), this.stage.camera);
  }

  // What is under the pointer: a label, else the nearest body.
  pick(event) {
    const name = event.target.dataset?.name;
    if (name !== undefined) return name;
    if (event.target !== this.stage.canvas) return null;
    this.aim(event);
    let nearest = null;
    let least = Infinity;
    for (const [other, { mesh }] of this.items) {
      const hit = mesh.visible ? this.ray.intersectObject(mesh, true)[0] : null;
      if (hit && hit.distance < least) [nearest, least] = [other, hit.distance];
    }
    return nearest;
  }

  // Where the pointer is at a height, as far from the label's anchor as it was when it was pressed.
  place(event, height) {
    this.aim(event);
    const plane = new THREE.Plane(new THREE.Vector3(0, 0, 1), -height);
    const hit = this.ray.ray.intersectPlane(plane, new THREE.Vector3());
    return hit && hit.distanceTo(this.stage.controls.target) < farthest ? hit : null;
  }

  press(event) {
    if (event.button !== 0 || this.held) return;
    const name = this.pick(event);
    if (name === null) return;
    const { anchor, label } = this.items.get(name);
    const hit = this.place(event, anchor.z);
    if (!hit) return;
    event.preventDefault();
    event.stopPropagation();
    label.focus({ preventScroll: true });
    this.select(name);
    this.held = { name, pointer: event.pointerId, height: anchor.z, dx: anchor.x - hit.x, dy: anchor.y - hit.y,
                  moved: false };
  }

  move(event, done) {
    const { held } = this;
    if (!held || event.pointerId !== held.pointer) return;
    if (done) this.held = null;
    const hit = event.type === "pointercancel" ? null : this.place(event, held.height);
    if (hit && !done) held.moved = true;
    if (hit) held.to = [hit.x + held.dx, hit.y + held.dy];
    if (held.moved) this.onMove(held.name, held.to, done);
  }

  /** Puts the labels where the camera sees what they name. */
  draw() {
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    const point = new THREE.Vector3();
    for (const { anchor, label } of this.items.values()) {
      point.copy(anchor).project(this.stage.camera);
      const x = (0.5 + 0.5 * point.x) * width;
      const y = (0.5 - 0.5 * point.y) * height;
      label.hidden = point.z > 1 || x < 0 || y < 0 || x > width || y > height;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -100%)`;
    }
  }
}
