// What is drawn on the floor: soles, polygons, paths. All lies flat, sorted by height.
import * as THREE from "three";

/** Not lit, never hides what is above it. */
export function flatMaterial(colour, opacity = 1) {
  return new THREE.MeshBasicMaterial({
    color: colour, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide,
  });
}

/** Corners of a sole rectangle, counter-clockwise: [x, y] in W. */
export function soleCorners({ x, y, yaw }, [length, width]) {
  const c = Math.cos(yaw);
  const s = Math.sin(yaw);
  return [[1, -1], [1, 1], [-1, 1], [-1, -1]].map(([i, j]) => {
    const a = (i * length) / 2;
    const b = (j * width) / 2;
    return [x + c * a - s * b, y + s * a + c * b];
  });
}

/** Convex hull of points in the plane, counter-clockwise. */
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

/** A filled polygon (convex, or simple) at a height. */
export function polygonGeometry(points, z) {
  const shape = new THREE.Shape(points.map(([x, y]) => new THREE.Vector2(x, y)));
  return new THREE.ShapeGeometry(shape).translate(0, 0, z);
}

/** A strip of constant width along a path of [x, y] at a height; `closed` joins its ends. */
export function ribbonGeometry(path, width, z, closed = false) {
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
    positions.push(p[0] - tx - ty, p[1] - ty + tx, z, p[0] - tx + ty, p[1] - ty - tx, z);
    positions.push(q[0] + tx - ty, q[1] + ty + tx, z, q[0] + tx + ty, q[1] + ty - tx, z);
    index.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(index);
  return geometry;
}

/** A mesh on the floor; those with a higher order lie above. */
export function mark(geometry, colour, opacity, order) {
  const mesh = new THREE.Mesh(geometry, flatMaterial(colour, opacity));
  mesh.renderOrder = order;
  return mesh;
}

/** A number, flat on the floor, that is read along the direction `yaw`. */
export function numberMark(number, { x, y, yaw }, colour, size, order) {
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
  mesh.position.set(x, y, 0.004);
  mesh.rotation.z = yaw - Math.PI / 2;
  mesh.renderOrder = order;
  return mesh;
}

/** The middle of footsteps on the floor [x, y], and the diagonal of the rectangle around them [m]. */
export function extentOf(footsteps) {
  const [x, y] = ["x_m", "y_m"].map((key) => {
    const values = footsteps.map((step) => step[key]);
    return [Math.min(...values), Math.max(...values)];
  });
  return { middle: [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2], extent: Math.hypot(x[1] - x[0], y[1] - y[0]) };
}
