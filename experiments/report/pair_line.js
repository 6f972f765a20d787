// The pair of bodies that is nearest at an instant: a ring, and a line between its points.
import * as THREE from "three";
import { onLayer } from "./stage.js";

const colour = "#e5004f"; // of nothing else in the scene
const seen = 0.011; // [s] around its instant

function ring() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const pen = canvas.getContext("2d");
  pen.strokeStyle = colour;
  pen.lineWidth = 9;
  pen.beginPath();
  pen.arc(64, 64, 54, 0, 2 * Math.PI);
  pen.stroke();
  const material = new THREE.SpriteMaterial({
    map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false,
  });
  const sprite = new THREE.Sprite(material);
  sprite.scale.setScalar(0.06);
  sprite.renderOrder = 40;
  return sprite;
}

function tube(from, to) {
  const length = Math.max(from.distanceTo(to), 1e-4);
  const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const mesh = new THREE.Mesh(new THREE.CylinderGeometry(0.002, 0.002, length, 12), material);
  mesh.position.copy(from).add(to).multiplyScalar(0.5);
  const along = to.clone().sub(from).normalize();
  if (along.lengthSq() > 0) mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along);
  mesh.renderOrder = 41;
  return mesh;
}

// Where faces or edges are parallel inside each other, the points of a pair may be anywhere on them;
// then they do not face each other.
function facing({ points: [p, q], margin_m: margin }) {
  return margin > 0 || Math.hypot(...p.map((value, k) => value - q[k])) <= 0.01 - margin;
}

/** Where a pair of a walk's data is: between its points, or else at the robot's own [m]. */
export function middleOf(pair) {
  const [p, q] = pair.points;
  return facing(pair) ? p.map((value, k) => (value + q[k]) / 2) : p;
}

export class PairLines {
  /** Of the pairs in `walk.nearest`, if it has them. */
  constructor(walk, layer) {
    this.group = new THREE.Group();
    this.pairs = (walk.nearest ?? []).map((pair) => {
      const [from, to] = pair.points.map((p) => new THREE.Vector3(...p));
      const drawn = new THREE.Group();
      const mark = ring();
      mark.position.set(...middleOf(pair));
      drawn.add(mark);
      if (facing(pair)) drawn.add(tube(from, to));
      drawn.visible = false;
      this.group.add(drawn);
      return { t: pair.t_s, drawn };
    });
    onLayer(this.group, layer);
  }

  showTime(t) {
    for (const pair of this.pairs) pair.drawn.visible = Math.abs(pair.t - t) < seen;
  }
}
