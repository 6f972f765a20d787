// Where a walk has been, drawn from its rows: samples, not the proven swept volumes.
import * as THREE from "three";
import * as palette from "./palette.js";
import { flatMaterial, ribbonGeometry, mark } from "./floor_marks.js";
import { RobotFigure, ghostMaterial } from "./robot.js";

/** Paths of CoM and ZMP on the ground. */
export function paths(walk) {
  const group = new THREE.Group();
  for (const [name, colour, order] of [["com", palette.com, 5], ["zmp", palette.zmp, 6]]) {
    const x = walk.column(`${name}_x_m`);
    const y = walk.column(`${name}_y_m`);
    const points = Array.from(x, (value, i) => [value, y[i], walk.groundAt({ row: i, part: 0 })]);
    const distinct = points.some(([px, py]) => Math.hypot(px - points[0][0], py - points[0][1]) > 1e-4);
    if (distinct) group.add(mark(ribbonGeometry(points, 0.006, 0.005), colour, 0.75, order));
  }
  return group;
}

/** What the middle line of each sole, across the foot, passes over while the foot is in the air. */
export function soleTraces(walk, [, width]) {
  const group = new THREE.Group();
  ["left", "right"].forEach((side, index) => {
    const of = (what) => walk.column(`${side}_foot_${what}`);
    const [x, y, z, yaw] = [of("x_m"), of("y_m"), of("z_m"), of("yaw_rad")];
    const positions = [];
    const triangles = [];
    let joined = false;
    for (let i = 0; i < x.length; ++i) {
      const alone = walk.supportAt({ row: i });
      const inAir = alone !== "both" && alone !== side;
      if (inAir) {
        const dx = (-Math.sin(yaw[i]) * width) / 2;
        const dy = (Math.cos(yaw[i]) * width) / 2;
        const first = positions.length / 3;
        positions.push(x[i] - dx, y[i] - dy, z[i], x[i] + dx, y[i] + dy, z[i]);
        if (joined) triangles.push(first - 2, first - 1, first, first, first - 1, first + 1);
      }
      joined = inAir;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
    geometry.setIndex(triangles);
    group.add(new THREE.Mesh(geometry, flatMaterial(palette.feet[index], 0.3)));
  });
  return group;
}

export const instants = 40;

/** The whole robot at so many equally spaced instants. */
export function strobe(walk, shapes) {
  const group = new THREE.Group();
  const material = ghostMaterial(palette.sky, 0.12);
  for (let i = 0; i < instants; ++i) {
    const figure = new RobotFigure(shapes, material);
    figure.pose(walk, walk.locate((walk.duration * i) / (instants - 1)));
    group.add(figure.group);
  }
  return group;
}
