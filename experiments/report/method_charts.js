// Methods beside each other: anytime curves of one scenario, and performance profiles and box plots
// of several.
import { anytimePlot } from "./anytime.js";
import { Boxes } from "./boxes.js";
import { Profile } from "./profiles.js";
import { methodLabel } from "./walk.js";

const targets = ["to within 1 % of the best", "to within 5 % of the best", "to the method's end"];

const byId = (id) => document.getElementById(id);
let made = null; // charts, which redraw themselves

// As in the anytime curves, where raw is none.
const colourOfMethod = (methods, label) =>
  (label === "raw" ? 6 : methods.filter((method) => method !== "raw").indexOf(label));

function kindsOf(objective, profiles, methods) {
  const kinds = [];
  for (const [target, words] of targets.entries()) {
    for (const byWall of [true, false]) {
      const curves = profiles.filter((curve) => curve.objective === objective &&
        curve.target === target && curve.by_wall === byWall);
      if (curves.length < 2) continue;
      kinds.push({
        label: `${byWall ? "run time" : "effort"} ${words}`,
        note: "A scenario is solved by a proved walk of the method's own.",
        curves: curves.map(({ method, variables, points }) => {
          const name = methodLabel(method, variables);
          return { name, colour: colourOfMethod(methods, name), points };
        }),
      });
    }
  }
  return kinds;
}

/**
 * For the case that is shown, among all cases: the durations found over run time, and where several
 * scenarios have its objective the profiles and the speed-ups.
 */
export function methodCharts(current, cases, profiles) {
  made ??= { profile: new Profile(byId("profile")), boxes: new Boxes(byId("boxes")) };
  anytimePlot(byId("anytime"), current.walks);
  const compared = cases.filter((one) => one.objective === current.objective);
  const methods = [...new Set(compared.flatMap((one) => one.walks.map((walk) => walk.label)))];
  const several = profiles.length > 0 && compared.length > 1;
  made.profile.show(several ? kindsOf(current.objective, profiles, methods) : []);
  byId("boxes").hidden = !several;
  if (!several) return;
  made.boxes.show("speed-up over raw [×]", methods.map((label) => ({
    label, colour: colourOfMethod(methods, label), all: compared.length,
    values: compared.flatMap(({ walks }) => walks.filter((walk) =>
      walk.label === label && walk.certified && walk.summary.own).map((walk) => walk.summary.speedup)),
  })), "scenarios");
}
