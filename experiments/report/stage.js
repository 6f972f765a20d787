// The stage: floor, obstacles, lights, cameras; draws one view, or two side by side.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import * as palette from "./palette.js";
import { mark, polygonGeometry, ribbonGeometry } from "./floor_marks.js";
import { meshGeometry } from "./robot.js";

/** Objects of layer 0 are seen in every view, of layer 1 and 2 in A's and in B's. */
export function onLayer(object, layer) {
  object.traverse((part) => part.layers.set(layer));
  return object;
}

// Shadows and a grid; else the floor has the colour of the sky.
function floor() {
  const group = new THREE.Group();
  const shadows = new THREE.ShadowMaterial({ color: "#2b3a4d", opacity: 0.2 });
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), shadows);
  plane.receiveShadow = true;
  plane.position.z = -0.002;
  plane.renderOrder = -2;
  group.add(plane);
  for (const [size, count, opacity] of [[16, 160, 0.16], [60, 60, 0.42]]) {
    const grid = new THREE.GridHelper(size, count, palette.theme.grid, palette.theme.grid);
    Object.assign(grid.material, { transparent: true, opacity, depthWrite: false });
    grid.rotation.x = Math.PI / 2;
    grid.renderOrder = -1;
    group.add(grid);
  }
  return group;
}

const solid = new THREE.MeshStandardMaterial({
  color: "#b7a58c", roughness: 0.85, transparent: true, opacity: 0.84,
});
const edges = new THREE.LineBasicMaterial({ color: "#6d5f4b", transparent: true, opacity: 0.7 });
const bearing = new THREE.MeshStandardMaterial({ color: "#c9ced6", roughness: 0.95 });
const risers = new THREE.LineBasicMaterial({ color: "#6b7480", transparent: true, opacity: 0.8 });

function solidMesh(json, look, lineLook, order) {
  const geometry = meshGeometry(json);
  const mesh = new THREE.Mesh(geometry, look);
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.renderOrder = order;
  const lines = new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 32), lineLook);
  lines.renderOrder = order + 1;
  mesh.add(lines);
  return mesh;
}

/**
 * An obstacle of a scene's data. Drawn last, so that it hides what is seen through the feet; robots
 * show faintly through it.
 */
export const obstacleMesh = (json) => solidMesh(json, solid, edges, 20);

/** A no-step area, a polygon of [x, y] in W. */
export function areaMark(polygon) {
  const group = new THREE.Group();
  group.add(mark(polygonGeometry(polygon, 0.001), palette.limit, 0.22, 1));
  group.add(mark(ribbonGeometry(polygon, 0.008, 0.001, true), palette.limit, 0.8, 1));
  return group;
}

// Obstacles that move are added to `moving`, with their places.
function sceneGroup(json, moving) {
  const group = new THREE.Group();
  for (const obstacle of json.obstacles) {
    const mesh = obstacleMesh(obstacle);
    if (obstacle.places) moving.push([mesh, obstacle.places]);
    group.add(mesh);
  }
  for (const polygon of json.no_step) group.add(areaMark(polygon));
  group.add(groundGroup(json));
  return group;
}

/** What stands out of the floor; marks lie on it. */
function groundGroup(json) {
  const group = new THREE.Group();
  for (const one of json.ground?.solids ?? []) group.add(solidMesh(one, bearing, risers, -4));
  return group;
}

// Directions from which the cameras look, in units of the distance.
const directions = {
  corner: [0.72, -0.92, 0.42],
  behind: [-0.66, -0.8, 0.62],
  side: [0.02, -1.25, 0.12],
  front: [1.25, 0.01, 0.12],
  top: [-0.001, 0, 1.3],
  feet: [0.72, -0.92, 0.34],
};

// Where a film is drawn without a graphics card, its edges and shadows would take most of the time.
const isFilm = location.search === "?film";
const lowView = 320; // [px]

export class Stage {
  constructor(canvas, onChange) {
    this.canvas = canvas;
    this.scale = 1; // of the robot: its height over that of HRP-2
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !isFilm });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.setScissorTest(true);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#b3bac4", 2.1));
    this.sun = new THREE.DirectionalLight("#fffaf2", 1.7);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(isFilm ? 1024 : 2048);
    this.sun.shadow.radius = 3;
    this.sun.shadow.bias = -0.0005;
    this.sun.shadow.normalBias = 0.01;
    Object.assign(this.sun.shadow.camera, {
      left: -2.5, right: 2.5, top: 2.5, bottom: -2.5, near: 0.5, far: 12,
    });
    this.scene.add(this.sun, this.sun.target);
    this.useTheme();
    this.place = new THREE.Group();
    this.scene.add(this.place);
    this.camera = new THREE.PerspectiveCamera(36, 1, 0.05, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.zoomToCursor = false;
    this.controls.addEventListener("change", onChange);
  }

  /** Takes the colours of palette.theme for floor and sky. */
  useTheme() {
    if (this.floor) this.scene.remove(this.floor);
    this.floor = floor();
    this.floor.visible = this.hasFloor ?? true;
    this.scene.add(this.floor);
    this.scene.background = new THREE.Color(palette.theme.sky);
    this.scene.fog = new THREE.Fog(palette.theme.sky, 9, 22);
  }

  setScene(json) {
    this.place.clear();
    this.moving = [];
    this.place.add(sceneGroup(json, this.moving));
    this.showFloor(json);
    this.showTime(0);
  }

  /** Without obstacles and areas. */
  setGround(json) {
    this.place.add(groundGroup(json));
    this.showFloor(json);
  }

  showFloor(json) {
    this.hasFloor = json.ground?.floor ?? true;
    this.floor.visible = this.hasFloor;
  }

  /** Puts the obstacles that move where they are at `t` [s]. */
  showTime(t) {
    for (const [mesh, places] of this.moving ?? []) {
      const next = Math.max(1, places.findIndex(([time]) => time > t));
      const past = t >= places.at(-1)[0];
      const [from, to] = past ? [places.at(-1), places.at(-1)] : [places[next - 1], places[next]];
      const s = past ? 0 : Math.max(0, (t - from[0]) / (to[0] - from[0]));
      const [x, y, z, yaw] = [1, 2, 3, 4].map((k) => from[k] + s * (to[k] - from[k]));
      mesh.position.set(x, y, z);
      mesh.rotation.z = yaw;
    }
  }

  /**
   * A direction of `directions`, at `height` above a point of the ground, `distance` [m] away, both of
   * a robot of HRP-2's size; `more` [m] farther for a robot of any size.
   */
  look(name, [x, y, ground = 0], distance, height = 0.68, more = 0) {
    const direction = new THREE.Vector3(...directions[name]);
    const far = this.canvas.clientHeight < lowView ? 1.15 : 1; // names lie over the view
    this.ground = ground;
    this.controls.target.set(x, y, name === "top" ? ground : ground + this.scale * height);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, far * (this.scale * distance + more));
    this.controls.update();
  }

  /** Moves what the camera looks at to another point; its height by how much the ground rose. */
  followTo(x, y, ground = 0) {
    const { target } = this.controls;
    const move = new THREE.Vector3(x - target.x, y - target.y, ground - (this.ground ?? 0));
    this.ground = ground;
    target.add(move);
    this.camera.position.add(move);
  }

  light({ x, y }) {
    const z = this.ground ?? 0;
    this.sun.target.position.set(x, y, z + 0.4);
    this.sun.position.set(x + 2.6, y - 2.0, z + 5);
  }

  /**
   * Draws views side by side: each has its layers, and may be moved by [x, y, z] from where the
   * camera is.
   */
  draw(views) {
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    const part = width / views.length;
    this.camera.aspect = part / height;
    this.camera.updateProjectionMatrix();
    const home = this.camera.position.clone();
    views.forEach(({ layers, shift: [x, y, z = 0] }, i) => {
      this.camera.position.set(home.x + x, home.y + y, home.z + z);
      this.camera.updateMatrixWorld();
      this.light({ x: this.controls.target.x + x, y: this.controls.target.y + y });
      this.camera.layers.set(0);
      for (const layer of layers) this.camera.layers.enable(layer);
      this.renderer.setViewport(i * part, 0, part, height);
      this.renderer.setScissor(i * part, 0, part, height);
      this.renderer.render(this.scene, this.camera);
    });
    this.camera.position.copy(home);
    this.camera.updateMatrixWorld();
  }
}

/** The stage on the page's canvas; null without WebGL, which the page says in its place. */
export function stageOfPage(redraw) {
  const byId = (id) => document.getElementById(id);
  try {
    return new Stage(byId("canvas"), redraw);
  } catch {
    byId("canvas").hidden = byId("scale").hidden = true;
    byId("no-webgl").hidden = false;
    return null;
  }
}
