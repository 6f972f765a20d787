// The pair of bodies that is nearest at an instant, as a line between its points with a ring.
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

/** The middle of a pair of a walk's data [m]. */
export function middleOf({ points: [p, q] }) {
  return p.map((value, k) => (value + q[k]) / 2);
}

export class PairLines {
  /** Of the pairs in `walk.nearest`, if it has them. */
  constructor(walk, layer) {
    this.group = new THREE.Group();
    this.pairs = (walk.nearest ?? []).map((pair) => {
      const [from, to] = pair.points.map((p) => new THREE.Vector3(...p));
      const drawn = new THREE.Group();
      const mark = ring();
      mark.position.copy(from).add(to).multiplyScalar(0.5);
      drawn.add(tube(from, to), mark);
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
