// The shell around an obstacle: all places where it may be when it was measured some time ago.
import * as THREE from "three";
import { ConvexHull } from "three/addons/math/ConvexHull.js";
import * as palette from "./palette.js";

const material = new THREE.MeshBasicMaterial({
  color: palette.second, transparent: true, opacity: 0.13, depthWrite: false, side: THREE.DoubleSide,
});

// Directions whose hull contains the unit ball.
const directions = (() => {
  const ball = new THREE.IcosahedronGeometry(1, 1).attributes.position;
  const all = Array.from({ length: ball.count }, (_, i) => new THREE.Vector3().fromBufferAttribute(ball, i));
  const distinct = all.filter((p, i) => all.findIndex((q) => q.distanceTo(p) < 1e-6) === i);
  return distinct.map((p) => p.multiplyScalar(1.08));
})();

// Corners of the convex hull of a body's vertices [m].
function corners({ vertices }) {
  const points = [];
  for (let i = 0; i < vertices.length; i += 3) {
    points.push(new THREE.Vector3(vertices[i], vertices[i + 1], vertices[i + 2]).multiplyScalar(1e-4));
  }
  const found = new Set();
  for (const face of new ConvexHull().setFromPoints(points).faces) {
    for (let edge = face.edge, first = true; first || edge !== face.edge; edge = edge.next, first = false) {
      found.add(edge.head().point);
    }
  }
  return [...found];
}

/**
 * Every point is a corner of the hull plus a direction times the radius, so that a change of the
 * radius moves the points and leaves the faces. It contains what it stands for.
 */
export class UncertaintyShell {
  constructor(json) {
    this.points = [];
    const faces = [];
    const origin = new Map();
    const sums = corners(json).flatMap((corner) => directions.map((direction) => {
      const sum = direction.clone().multiplyScalar(0.1).add(corner);
      origin.set(sum, { corner, direction });
      return sum;
    }));
    const index = new Map();
    const indexOf = (point) => {
      if (!index.has(point)) index.set(point, this.points.push(origin.get(point)) - 1);
      return index.get(point);
    };
    for (const face of new ConvexHull().setFromPoints(sums).faces) {
      const { edge } = face;
      const first = indexOf(edge.head().point);
      for (let e = edge.next; e.next !== edge; e = e.next) {
        faces.push(first, indexOf(e.head().point), indexOf(e.next.head().point));
      }
    }
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * this.points.length), 3));
    this.geometry.setIndex(faces);
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.renderOrder = 30;
    this.mesh.frustumCulled = false;
  }

  /** `radius` [m]. */
  grow(radius) {
    if (this.radius === radius) return;
    this.radius = radius;
    const position = this.geometry.attributes.position;
    this.points.forEach(({ corner, direction }, i) => position.setXYZ(i,
      corner.x + radius * direction.x, corner.y + radius * direction.y, corner.z + radius * direction.z));
    position.needsUpdate = true;
  }
}

/** r + v·(t − t_m), no longer than the horizon [m]. */
export function uncertainty({ error_m: r, speed_m_s: v, horizon_s: horizon }, age) {
  return r + v * Math.min(Math.abs(age), horizon ?? Infinity);
}
