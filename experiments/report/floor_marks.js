// What is drawn on the floor: soles, polygons, paths. All lies flat, sorted by height.
import * as THREE from "three";

/** Not lit, never hides what is above it. */
export function flatMaterial(colour, opacity = 1) {
  return new THREE.MeshBasicMaterial({
    color: colour, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide,
  });
}

/** Corners of a sole rectangle, counter-clockwise: [x, y, z] in W. */
export function soleCorners({ x, y, z = 0, yaw }, [length, width]) {
  const c = Math.cos(yaw);
  const s = Math.sin(yaw);
  return [[1, -1], [1, 1], [-1, 1], [-1, -1]].map(([i, j]) => {
    const a = (i * length) / 2;
    const b = (j * width) / 2;
    return [x + c * a - s * b, y + s * a + c * b, z];
  });
}

/** Convex hull of points seen from above, counter-clockwise. */
export function convexHull(points) {
  const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
  const turnsRight = (a, b, c) =>
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0;
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1 && turnsRight(chain.at(-2), chain.at(-1), p)) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** A filled polygon (convex, or simple) of [x, y], or [x, y, z], so far above itself. */
export function polygonGeometry(points, above) {
  const shape = new THREE.Shape(points.map(([x, y]) => new THREE.Vector2(x, y)));
  const geometry = new THREE.ShapeGeometry(shape).translate(0, 0, above);
  if (points.some(([, , z = 0]) => z !== 0)) raise(geometry.attributes.position, points);
  return geometry;
}

// Raises each vertex by the z of the point that it is, for their order may have changed.
function raise(position, points) {
  for (let i = 0; i < position.count; ++i) {
    const far = ([x, y]) => Math.hypot(x - position.getX(i), y - position.getY(i));
    const own = points.reduce((best, point) => (far(point) < far(best) ? point : best));
    position.setZ(i, position.getZ(i) + own[2]);
  }
}

/** A strip of constant width along a path of [x, y], or [x, y, z]; `closed` joins its ends. */
export function ribbonGeometry(path, width, above, closed = false) {
  const points = path.filter(
    (p, i) => i === 0 || Math.hypot(p[0] - path[i - 1][0], p[1] - path[i - 1][1]) > 1e-5,
  );
  if (closed) points.push(points[0], points[1]);
  const positions = [];
  const index = [];
  points.slice(0, -1).forEach((p, i) => {
    const q = points[i + 1];
    const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
    const tx = ((q[0] - p[0]) / length) * 0.5 * width;
    const ty = ((q[1] - p[1]) / length) * 0.5 * width;
    const first = positions.length / 3;
    const [zp, zq] = [above + (p[2] ?? 0), above + (q[2] ?? 0)];
    positions.push(p[0] - tx - ty, p[1] - ty + tx, zp, p[0] - tx + ty, p[1] - ty - tx, zp);
    positions.push(q[0] + tx - ty, q[1] + ty + tx, zq, q[0] + tx + ty, q[1] + ty - tx, zq);
    index.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(index);
  return geometry;
}

/** A mesh on the ground; those with a higher order lie above. */
export function mark(geometry, colour, opacity, order) {
  const mesh = new THREE.Mesh(geometry, flatMaterial(colour, opacity));
  mesh.renderOrder = order;
  return mesh;
}

/** A number, flat on the ground, that is read along the direction `yaw`. */
export function numberMark(number, { x, y, z = 0, yaw }, colour, size, order) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d");
  pen.font = "bold 40px sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = colour;
  pen.fillText(String(number), 32, 34);
  const material = flatMaterial("#ffffff");
  material.map = new THREE.CanvasTexture(canvas);
  material.map.anisotropy = 4;
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(size, size), material);
  mesh.position.set(x, y, z + 0.004);
  mesh.rotation.z = yaw - Math.PI / 2;
  mesh.renderOrder = order;
  return mesh;
}

/** The middle of footsteps [x, y, z], and the diagonal of the box around them [m]. */
export function extentOf(footsteps) {
  const ranges = ["x_m", "y_m", "z_m"].map((key) => {
    const values = footsteps.map((step) => step[key] ?? 0);
    return [Math.min(...values), Math.max(...values)];
  });
  return {
    middle: ranges.map(([least, most]) => (least + most) / 2),
    extent: Math.hypot(...ranges.map(([least, most]) => most - least)),
  };
}
