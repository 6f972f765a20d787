// Which walks a report shows first.

/** Whether nothing of what is drawn is proved. */
export const isInfeasible = (drawn) => drawn.length > 0 && drawn.every((walk) => !walk.certified);

/** A: the fastest proved walk, or the planned motion where none is proved. */
export function firstChoice(drawn) {
  const raw = drawn.find((walk) => walk.method === "raw");
  if (isInfeasible(drawn) && raw) return raw;
  const smoothed = drawn.filter((walk) => walk.method !== "raw");
  const proved = smoothed.filter((walk) => walk.certified && walk.summary.own);
  const list = proved.length ? proved : smoothed.length ? smoothed : drawn;
  return list.reduce((best, walk) => (walk.duration < best.duration ? walk : best), list[0]);
}

/** B: the dichotomy where there is one, else the planned motion; none beside what is not feasible. */
export function secondChoice(drawn, first) {
  if (isInfeasible(drawn)) return undefined;
  return ["dichotomy", "raw"].map((method) => drawn.find((walk) => walk.method === method))
    .find((walk) => walk && walk !== first);
}
