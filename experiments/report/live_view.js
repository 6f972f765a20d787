// Robot, world and plan of an episode on the stage, at one time.
import * as THREE from "three";
import { Actor } from "./actor.js";
import { mark, numberMark, polygonGeometry, ribbonGeometry, soleCorners } from "./floor_marks.js";
import { stageOf } from "./episode_record.js";
import * as palette from "./palette.js";
import { RobotFigure, RobotShapes, ghostMaterial } from "./robot.js";
import { areaMark, obstacleMesh } from "./stage.js";
import { soleTraces } from "./traces.js";
import { UncertaintyShell, uncertainty } from "./uncertainty.js";
import { VolumesToCome } from "./volumes_to_come.js";

const ghostSeconds = 4; // replaced plans fade for so long [s]
const strobeInstants = 6;

export const layers = [
  ["shells", "may be (shell)", true],
  ["footsteps", "footsteps", true],
  ["ghosts", "replaced plans", true],
  ["soles", "sole traces (sampled)", true],
  ["strobe", "body (sampled)", false],
  ["balance", "ZMP, CoM", false],
  ["bodies", "bodies that proofs use", false],
  ["volumes", "swept volumes", false],
];

function emptied(group) {
  group.traverse((part) => {
    if (part !== group && !part.userData.shared) {
      part.geometry?.dispose();
      part.material?.map?.dispose();
    }
  });
  group.clear();
  return group;
}

// The outline of a sole: whole, or in dashes.
function outline(corners, width, z, colour, opacity, order, dashed) {
  if (!dashed) return mark(ribbonGeometry(corners, width, z, true), colour, opacity, order);
  const group = new THREE.Group();
  corners.forEach((p, i) => {
    const q = corners[(i + 1) % 4];
    const count = Math.max(2, Math.round(Math.hypot(q[0] - p[0], q[1] - p[1]) / 0.035));
    for (let k = 0; k < count; ++k) {
      const at = (s) => [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])];
      group.add(mark(ribbonGeometry([at(k / count), at((k + 0.55) / count)], width, z), colour, opacity, order));
    }
  });
  return group;
}

const looks = {
  begun: { fill: 0.3, width: 0.003, dashed: false },
  granted: { fill: 0.1, width: 0.008, dashed: false },
  "to come": { fill: 0, width: 0.004, dashed: true },
};

const placeOf = (step) => ({ x: step.x_m, y: step.y_m, z: step.z_m, yaw: step.yaw_rad });

export class LiveView {
  /** `drawn`: the message `draw`, whose obstacles are about their own origins. */
  constructor(stage, drawn, hello) {
    this.stage = stage;
    this.shapes = new RobotShapes(drawn.robot);
    this.sole = drawn.robot.sole;
    this.groups = Object.fromEntries(
      ["shells", "footsteps", "ghosts", "soles", "strobe"].map((name) => [name, new THREE.Group()]));
    this.ofRobot = {}; // layers that the robot itself has, by their names
    this.volumes = new VolumesToCome();
    this.groups.volumes = this.volumes.group;
    this.obstacles = new Map(drawn.scene.obstacles.map((json) => {
      const mesh = obstacleMesh(json);
      const shell = new UncertaintyShell(json);
      mesh.geometry.computeBoundingBox();
      this.groups.shells.add(shell.mesh);
      stage.scene.add(mesh);
      return [json.name, { name: json.name, mesh, shell, box: mesh.geometry.boundingBox }];
    }));
    stage.scale = this.shapes.scale;
    stage.setGround(drawn.scene);
    this.areas = drawn.scene.no_step.map(areaMark);
    this.goal = new THREE.Group();
    const radius = hello.goal_radius_m;
    this.goal.add(mark(new THREE.CircleGeometry(radius, 48), palette.com, 0.16, 1),
                  mark(new THREE.RingGeometry(radius - 0.012, radius, 48), palette.com, 0.9, 1));
    for (const part of this.goal.children) part.position.z = 0.0015;
    stage.scene.add(this.goal, ...this.areas, ...Object.values(this.groups));
    this.strobeMaterial = ghostMaterial(palette.sky, 0.1);
  }

  /** Draws the plan anew at the next time, in the colours of the theme. */
  useTheme() { this.planKey = null; }

  show(layer, visible) {
    if (layer in this.groups) this.groups[layer].visible = visible;
    else this.ofRobot[layer] = visible;
    this.dressRobot();
  }

  dressRobot() {
    for (const layer of ["balance", "bodies"]) this.actor?.show(layer, this.ofRobot[layer] ?? false);
  }

  /** The robot as an instant has it: a Walk, or the Past of a live one. */
  showRobot(walk, t) {
    if (!this.actor) {
      this.actor = new Actor(walk, this.shapes, 1, false);
      this.dressRobot();
      this.stage.scene.add(this.actor.group);
    }
    this.actor.pose(t);
    this.waist = this.actor.figure.group.position;
    this.ground = walk.groundAt(walk.locate(t));
  }

  /** What was known of the world at t. */
  showWorld(world, t) {
    const known = new Map(world.obstacles.map((obstacle) => [obstacle.name, obstacle]));
    for (const { name, mesh, shell } of this.obstacles.values()) {
      const measured = known.get(name);
      mesh.visible = shell.mesh.visible = measured !== undefined;
      if (!measured) continue;
      const [w, x, y, z] = measured.quaternion_wxyz;
      for (const part of [mesh, shell.mesh]) {
        part.position.set(...measured.xyz_m);
        part.quaternion.set(x, y, z, w);
      }
      shell.grow(uncertainty(measured, t - world.measured_s));
    }
    this.goal.position.set(world.goal.x_m, world.goal.y_m, world.goal.z_m ?? 0);
    this.areas.forEach((area, i) => { area.visible = world.areas.includes(i + 1); });
  }

  /** The footsteps of a walk: begun, granted and to come told apart. */
  showPlan(walk, begun, through) {
    const key = `${walk.walk} ${begun} ${through}`;
    if (key === this.planKey) return;
    this.planKey = key;
    const group = emptied(this.groups.footsteps);
    walk.footsteps.forEach((step, i) => {
      const place = placeOf(step);
      const { fill, width, dashed } = looks[i < 2 ? "begun" : stageOf(i, begun, through)];
      const colour = palette.feet[step.foot === "left" ? 0 : 1];
      const corners = soleCorners(place, this.sole);
      if (fill > 0) group.add(mark(polygonGeometry(corners, 0.002), colour, fill, 2));
      group.add(outline(corners, width, 0.002, colour, 0.9, 3, dashed));
      if (i >= 2) group.add(numberMark(i - 1, place, palette.theme.ink, 0.1, 4));
    });
  }

  /** The proven swept volumes of half-steps after the latest that has begun; returns how many. */
  showVolumes(record, begun) {
    if (!this.groups.volumes.visible || !record.volumes) return 0;
    return this.volumes.show(record.volumes, record.cells, begun);
  }

  /** Footsteps of plans that were replaced, fading: [walk, successor, age [s]]. */
  showReplaced(pairs) {
    const fresh = pairs.filter(([, , age]) => age < ghostSeconds);
    const key = fresh.map(([walk]) => walk.walk).join(" ");
    if (key !== this.ghostKey) {
      this.ghostKey = key;
      emptied(this.groups.ghosts);
      for (const [walk, next] of fresh) this.groups.ghosts.add(this.ghost(walk, next));
    }
    fresh.forEach(([, , age], i) => this.groups.ghosts.children[i].traverse((part) => {
      if (part.material) part.material.opacity = 0.75 * (1 - age / ghostSeconds);
    }));
  }

  // The soles of a walk that its successor does not have.
  ghost(walk, next) {
    const same = (a, b) => b && a.foot === b.foot &&
      Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m) < 1e-6 && Math.abs(a.yaw_rad - b.yaw_rad) < 1e-6;
    const group = new THREE.Group();
    walk.footsteps.forEach((step, i) => {
      if (same(step, next.footsteps[i])) return;
      const corners = soleCorners(placeOf(step), this.sole);
      group.add(outline(corners, 0.005, 0.003, palette.second, 0.75, 5, true));
    });
    return group;
  }

  /** Traces of the motion to come, from its rows. */
  showMotion(rows) {
    for (const name of ["soles", "strobe"]) emptied(this.groups[name]);
    if (!rows || rows.length < 2) return;
    this.groups.soles.add(soleTraces(rows, this.sole));
    if (!this.groups.strobe.visible) return;
    for (let i = 1; i <= strobeInstants; ++i) {
      const figure = new RobotFigure(this.shapes, this.strobeMaterial);
      figure.group.traverse((part) => { part.userData.shared = true; });
      figure.pose(rows, Math.round((i * (rows.length - 1)) / strobeInstants));
      this.groups.strobe.add(figure.group);
    }
  }
}
