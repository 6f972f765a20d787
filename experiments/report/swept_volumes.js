// The swept volumes by which a planner called the half-steps of its plan free, as translucent cells.
import * as THREE from "three";
import * as palette from "./palette.js";
import { onLayer } from "./stage.js";

// Cells, z fastest, from runs of free and occupied ones in turn; null where they do not add up.
function cellsOf({ size, runs }) {
  const full = new Uint8Array(size[0] * size[1] * size[2]);
  let at = 0;
  runs.forEach((length, i) => {
    if (i % 2 === 1) full.fill(1, at, at + length);
    at += length;
  });
  return at === full.length ? full : null;
}

/** The faces of the surface, those in a row along z (or x, of level ones) as one rectangle. */
export function surfaceOf(volume, cell) {
  const full = cellsOf(volume);
  if (!full) return null;
  const { size, lower } = volume;
  const strides = [size[1] * size[2], size[2], 1];
  const corners = [];
  const faces = [];
  // A face of `axis` between two cells, from `begin` to `end` along `along`.
  const add = (axis, along, place, end, side) => {
    const across = 3 - axis - along;
    const from = place.map((c, k) => (k === axis ? c + (side > 0 ? 1 : 0) : c));
    const first = corners.length / 3;
    for (const [a, b] of [[0, 0], [1, 0], [1, 1], [0, 1]]) {
      const corner = [...from];
      if (a) corner[along] = end;
      corner[across] += b;
      corners.push(...corner.map((c, k) => lower[k] + cell * c));
    }
    const turns = (along - axis + 3) % 3 === 1 ? side > 0 : side < 0;
    const [p, q] = turns ? [1, 3] : [3, 1];
    faces.push(first, first + p, first + 2, first, first + 2, first + q);
  };
  for (let axis = 0; axis < 3; ++axis) {
    const along = axis === 2 ? 0 : 2;
    const across = 3 - axis - along;
    for (const side of [-1, 1]) {
      const isFace = (place) => {
        const index = place[0] * strides[0] + place[1] * strides[1] + place[2];
        if (!full[index]) return false;
        const next = place[axis] + side;
        return next < 0 || next >= size[axis] || !full[index + side * strides[axis]];
      };
      const place = [0, 0, 0];
      for (place[axis] = 0; place[axis] < size[axis]; ++place[axis]) {
        for (place[across] = 0; place[across] < size[across]; ++place[across]) {
          for (place[along] = 0; place[along] < size[along]; ++place[along]) {
            if (!isFace(place)) continue;
            const begin = [...place];
            while (place[along] < size[along] && isFace(place)) ++place[along];
            add(axis, along, begin, place[along], side);
          }
        }
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
  geometry.setIndex(faces);
  return geometry;
}

export const material = (opacity) => new THREE.MeshBasicMaterial({
  color: palette.second, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide,
});

/** One of a half-step; the frame of its support sole is that of a left one. */
export function meshOf(shape, look, order) {
  const mesh = new THREE.Mesh(shape, look);
  mesh.renderOrder = order;
  return mesh;
}

/** Puts it where the half-step is. */
export function place(mesh, { X_WS: [x, y, yaw], z_m: z = 0, mirrored }) {
  mesh.position.set(x, y, z);
  mesh.rotation.z = yaw;
  mesh.scale.y = mirrored ? -1 : 1;
}

// All volumes of a half-step: on levels the feet have their own.
const volumesOf = ({ volume, feet = [] }) => [volume, ...feet];
const mostVolumes = 3;

class SweptVolumes {
  /** Of a case's data; shapes are made when it is first shown. */
  constructor(json) {
    this.json = json;
    this.group = new THREE.Group();
    this.group.visible = false;
    this.faint = material(0.035);
    this.strong = material(0.14);
  }

  show(visible) {
    if (visible && !this.shapes) this.make();
    this.group.visible = visible;
  }

  make() {
    this.shapes = this.json.volumes.map((volume) => surfaceOf(volume, this.json.cell_m));
    for (const half of this.json.half_steps) {
      for (const shape of half ? volumesOf(half).map((i) => this.shapes[i]) : []) {
        if (!shape) continue;
        const mesh = meshOf(shape, this.faint, 30);
        place(mesh, half);
        this.group.add(mesh);
      }
    }
    this.present = [1, 2].map((layer) => Array.from({ length: mostVolumes }, () => {
      const mesh = onLayer(meshOf(new THREE.BufferGeometry(), this.strong, 31), layer);
      this.group.add(mesh);
      return mesh;
    }));
  }

  /** Draws those of A's and of B's present half-step, from 0, more strongly; −1: none. */
  showHalfSteps(indices) {
    this.present?.forEach((meshes, i) => {
      const half = this.json.half_steps[indices[i] ?? -1];
      meshes.forEach((mesh, k) => {
        const shape = half && this.shapes[volumesOf(half)[k]];
        mesh.visible = Boolean(shape);
        if (!shape) return;
        mesh.geometry = shape;
        place(mesh, half);
      });
    });
  }

  dispose() {
    for (const shape of this.shapes ?? []) shape?.dispose();
    this.faint.dispose();
    this.strong.dispose();
  }
}

// What the page says of them.
function volumesNote({ baked_cell_m: baked, cell_m: cell, half_steps: halfSteps }) {
  const centimetres = (metres) => `${Number((100 * metres).toPrecision(2))} cm`;
  const drawn = cell > baked
    ? `drawn by cells of ${centimetres(cell)} around those of ${centimetres(baked)} that it asked`
    : `by its cells of ${centimetres(cell)}`;
  return `Swept volumes: all that the robot sweeps in each half-step of the plan, as the planner proved ` +
    `before it searched, ${drawn}; that of the present half-step stronger. ` +
    (halfSteps[0] === null ? "The first one, from the start, has none: it was proved by itself. " : "") +
    "A smoothed walk leaves them: its own proof is below.";
}

/** Those of a case's data on the stage, told in `note`; null where it has none. Frees the old ones. */
export function volumesInPlaceOf(old, stage, json, note) {
  if (old) {
    stage.scene.remove(old.group);
    old.dispose();
  }
  if (!json) return null;
  note.textContent = volumesNote(json);
  const volumes = new SweptVolumes(json);
  stage.scene.add(volumes.group);
  return volumes;
}
