// What of a robot is drawn for the eye alone, about its bodies: nothing that is proved knows it. All
// geometry is in the waist frame at q = 0 [m], as that of the bodies.
import * as THREE from "three";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";

const cornerSteps = 5; // of a quarter of a round corner

/** A rod with round ends, of a robot's `rods`. */
export function rodGeometry({ from, to, radius }) {
  const [a, b] = [new THREE.Vector3(...from), new THREE.Vector3(...to)];
  const along = b.clone().sub(a);
  const geometry = new THREE.CapsuleGeometry(radius, along.length(), 6, 20);
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.normalize());
  return geometry.applyQuaternion(turn).translate(...a.add(b).multiplyScalar(0.5).toArray());
}

// A rectangle with round corners about [x, y], so high: points in a row.
function ring({ x, y, z, length, width, round }) {
  const points = [];
  const radius = Math.min(round, 0.49 * length, 0.49 * width);
  for (const [i, [sx, sy]] of [[1, 1], [-1, 1], [-1, -1], [1, -1]].entries()) {
    for (let k = 0; k <= cornerSteps; ++k) {
      const angle = (Math.PI / 2) * (i + k / cornerSteps);
      points.push([x + sx * (length / 2 - radius) + radius * Math.cos(angle),
                   y + sy * (width / 2 - radius) + radius * Math.sin(angle), z]);
    }
  }
  return points;
}

// The closed surface through rings of as many points each, from below.
function lofted(rings) {
  const count = rings[0].length;
  const index = [];
  for (let k = 0; k + 1 < rings.length; ++k) {
    for (let i = 0; i < count; ++i) {
      const [a, b] = [k * count + i, k * count + ((i + 1) % count)];
      index.push(a, b, a + count, b, b + count, a + count);
    }
  }
  const top = (rings.length - 1) * count;
  for (let i = 1; i + 1 < count; ++i) index.push(0, i + 1, i, top, top + i, top + i + 1);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(rings.flat(2), 3));
  geometry.setIndex(index);
  return toCreasedNormals(geometry, 0.6);
}

function boundsOf(geometry, X) {
  return new THREE.Box3().setFromBufferAttribute(geometry.clone().applyMatrix4(X).attributes.position);
}

/**
 * A foot that stands on its whole sole as a shoe: {shoe, tread}, inside the box of its body. Null for a
 * foot of another form, which is drawn as its body is.
 */
export function shoeOf(body, leg, [length, width]) {
  const X = new THREE.Matrix4().set(...leg.sole, 0, 0, 0, 1); // of the sole, in the waist frame
  const box = boundsOf(body.geometry, X.clone().invert());
  const size = box.getSize(new THREE.Vector3());
  const middle = box.getCenter(new THREE.Vector3());
  const ankle = new THREE.Vector3(...leg.joints[5].point).applyMatrix4(X.clone().invert());
  const like = (a, b) => a > 0.7 * b && a < 1.4 * b;
  if (!like(size.x, length) || !like(size.y, width) || Math.abs(box.min.z) > 0.01 || ankle.z < 0.03) return null;
  const round = 0.3 * Math.min(size.x, size.y);
  const at = (z, ahead, long, wide) => ring({
    x: middle.x + ahead, y: middle.y, z, length: long * size.x, width: wide * size.y, round,
  });
  const heel = ankle.x - middle.x;
  const high = Math.min(box.max.z, 1.25 * ankle.z);
  const tread = lofted([at(0, 0, 0.99, 0.99), at(0.16 * high, 0, 1, 1)]);
  const shoe = lofted([
    at(0.16 * high, 0, 0.99, 0.98), at(0.34 * high, 0, 0.97, 0.95), at(0.5 * high, 0.12 * heel, 0.86, 0.86),
    at(0.64 * high, 0.55 * heel, 0.62, 0.74), at(0.85 * high, 0.95 * heel, 0.44, 0.6), at(high, heel, 0.38, 0.5),
  ]);
  return { shoe: shoe.applyMatrix4(X), tread: tread.applyMatrix4(X) };
}

// What of a polygon lies where `depth` of a point is positive.
function cut(polygon, depth) {
  return polygon.flatMap((p, i) => {
    const q = polygon[(i + 1) % polygon.length];
    const [dp, dq] = [depth(p), depth(q)];
    const edge = dp * dq < 0 ? [p.clone().lerp(q, dp / (dp - dq))] : [];
    return dp > 0 ? [p, ...edge] : edge;
  });
}

/** The dark part of a head's front: of its surface a band, a little before it. */
export function visorOf({ geometry }) {
  const box = boundsOf(geometry, new THREE.Matrix4());
  const size = box.getSize(new THREE.Vector3());
  const middle = box.getCenter(new THREE.Vector3());
  const [low, high] = [box.min.z + 0.42 * size.z, box.min.z + 0.68 * size.z];
  const planes = [(p) => p.z - low, (p) => high - p.z, (p) => p.x - middle.x - 0.12 * size.x];
  const vertex = geometry.attributes.position;
  const positions = [];
  for (let i = 0; i < vertex.count; i += 3) {
    const triangle = [0, 1, 2].map((k) => new THREE.Vector3().fromBufferAttribute(vertex, i + k));
    const kept = planes.reduce(cut, triangle);
    for (let k = 1; k + 1 < kept.length; ++k) {
      for (const p of [kept[0], kept[k], kept[k + 1]]) {
        positions.push(...p.clone().sub(middle).multiplyScalar(1.012).add(middle).toArray());
      }
    }
  }
  const made = new THREE.BufferGeometry();
  made.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  made.computeVertexNormals();
  return made;
}
