// A walk on the stage: the robot, and what belongs to it on the floor.
import * as THREE from "three";
import * as palette from "./palette.js";
import {
  convexHull, mark, numberMark, polygonGeometry, ribbonGeometry, soleCorners,
} from "./floor_marks.js";
import { RobotFigure, ghostMaterial } from "./robot.js";
import { PairLines } from "./pair_line.js";
import { onLayer } from "./stage.js";
import { paths, soleTraces, strobe } from "./traces.js";

/** Where the footsteps of a case are, with their numbers. */
export function footprints(footsteps, sole) {
  const group = new THREE.Group();
  for (const step of footsteps) {
    const place = { x: step.x_m, y: step.y_m, z: step.z_m, yaw: step.yaw_rad };
    const colour = palette.feet[step.foot === "left" ? 0 : 1];
    const corners = soleCorners(place, sole);
    group.add(mark(polygonGeometry(corners, 0.002), colour, 0.16, 2));
    group.add(mark(ribbonGeometry(corners, 0.005, 0.002, true), colour, 0.75, 2));
    if (step.footstep > 0) group.add(numberMark(step.footstep, place, palette.theme.ink, 0.1, 4));
  }
  return group;
}

// Seen through the feet that stand on it.
function dot(radius, colour, order) {
  const group = new THREE.Group();
  group.add(mark(new THREE.CircleGeometry(radius * 1.45, 32), "#ffffff", 1, order));
  group.add(mark(new THREE.CircleGeometry(radius, 32), colour, 1, order + 1));
  for (const part of group.children) part.material.depthTest = false;
  return group;
}

export class Actor {
  /** `ghost`: in one colour, half transparent. */
  constructor(walk, shapes, layer, ghost) {
    this.walk = walk;
    this.shapes = shapes;
    this.layer = layer;
    this.group = new THREE.Group();
    const material = ghost ? ghostMaterial(palette.second, 0.45) : null;
    this.figure = new RobotFigure(shapes, material);
    this.polygon = new THREE.Group();
    this.zmp = dot(0.013, palette.zmp, 12);
    this.com = dot(0.011, palette.com, 10);
    const line = new THREE.BufferGeometry().setFromPoints([
      new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, 1),
    ]);
    this.plumb = new THREE.Line(line, new THREE.LineBasicMaterial({ color: palette.com }));
    this.balance = new THREE.Group(); // ZMP, support polygon, CoM
    this.balance.add(this.polygon, this.zmp, this.com, this.plumb);
    this.extras = {};
    this.pairs = new PairLines(walk, layer);
    this.group.add(this.figure.group, this.balance, this.pairs.group);
    onLayer(this.group, layer);
  }

  /** Shows or hides "balance", "bodies", "paths", "soles" or "strobe"; made when first shown. */
  show(what, visible) {
    if (what === "bodies") {
      this.figure.showBodies(visible);
      return;
    }
    if (what === "balance") {
      this.balance.visible = visible;
      return;
    }
    if (visible && !this.extras[what]) {
      const made = {
        paths: () => paths(this.walk),
        soles: () => soleTraces(this.walk, this.shapes.json.sole),
        strobe: () => strobe(this.walk, this.shapes),
      }[what]();
      this.extras[what] = onLayer(made, this.layer);
      this.group.add(made);
    }
    if (this.extras[what]) this.extras[what].visible = visible;
  }

  /** Frees what the graphics card holds; shapes that others share come back when they are drawn. */
  dispose() {
    this.group.traverse((part) => {
      part.geometry?.dispose();
      part.material?.dispose();
    });
  }

  /** At a time [s]; after its end the walk stands. */
  pose(t) {
    const at = this.walk.locate(t);
    const of = (name) => this.walk.value(name, at);
    this.pairs.showTime(t);
    this.figure.pose(this.walk, at);
    const ground = this.walk.groundAt(at);
    this.zmp.position.set(of("zmp_x_m"), of("zmp_y_m"), ground + 0.007);
    this.com.position.set(of("com_x_m"), of("com_y_m"), ground + 0.006);
    this.plumb.position.set(of("com_x_m"), of("com_y_m"), ground + 0.006);
    this.plumb.scale.z = of("com_z_m") - ground;
    const support = this.walk.supportAt(at);
    const sides = support === "both" ? ["left", "right"] : [support];
    const soles = sides.map((side) => this.walk.sole(side, at));
    const key = JSON.stringify(soles);
    if (key === this.polygonKey) return;
    this.polygonKey = key;
    const hull = convexHull(soles.flatMap((sole) => soleCorners(sole, this.shapes.json.sole)));
    for (const old of this.polygon.children) old.geometry.dispose();
    this.polygon.clear();
    this.polygon.add(mark(polygonGeometry(hull, 0.003), palette.com, 0.2, 7));
    const outline = mark(ribbonGeometry(hull, 0.007, 0.003, true), palette.com, 0.95, 8);
    outline.material.depthTest = false;
    this.polygon.add(outline);
    onLayer(this.polygon, this.layer);
  }
}
