// A convex polygon less a strip along its edges.

/** What of a polygon of [x, y], counter-clockwise, is at least `by` inside each edge; [] if nothing. */
export function inset(polygon, by) {
  let kept = polygon;
  polygon.forEach(([ax, ay], i) => {
    const [bx, cy] = polygon[(i + 1) % polygon.length];
    const length = Math.hypot(bx - ax, cy - ay);
    if (length < 1e-9) return;
    const [nx, ny] = [(ay - cy) / length, (bx - ax) / length]; // inwards
    const depth = ([x, y]) => nx * (x - ax) + ny * (y - ay) - by;
    kept = kept.flatMap((p, k) => {
      const q = kept[(k + 1) % kept.length];
      const [dp, dq] = [depth(p), depth(q)];
      const cut = dp * dq < 0 ? [p.map((value, j) => value + (dp / (dp - dq)) * (q[j] - value))] : [];
      return dp >= 0 ? [p, ...cut] : cut;
    });
  });
  return kept;
}
