// The proven swept volumes of the half-steps that are still to come, as translucent cells.
import * as THREE from "three";
import { material, meshOf, place, surfaceOf } from "./swept_volumes.js";

export class VolumesToCome {
  constructor() {
    this.group = new THREE.Group();
    this.shapes = new Map(); // by volume, null where the cells do not add up
    this.faint = material(0.05);
    this.strong = material(0.18);
  }

  shapeOf(volume, cells) {
    if (!this.shapes.has(volume)) this.shapes.set(volume, surfaceOf(cells, cells.cell_m));
    return this.shapes.get(volume);
  }

  /**
   * Draws those of a message `volumes` after the latest half-step that has begun, the next one stronger.
   * `cells`: messages `volume` by their numbers. Returns how many there are.
   */
  show(message, cells, begun) {
    if (message !== this.message || begun !== this.begun) {
      this.message = message;
      this.begun = begun;
      this.group.clear(); // shapes are kept for the next plan
      message.half_steps.forEach((half, k) => {
        const i = message.first_half_step - 1 + k;
        if (half === null || i < begun || !cells.has(half.volume)) return;
        const shape = this.shapeOf(half.volume, cells.get(half.volume));
        if (!shape) return;
        const mesh = meshOf(shape, i === begun ? this.strong : this.faint, 30);
        place(mesh, half);
        this.group.add(mesh);
      });
    }
    return this.group.children.length;
  }
}
