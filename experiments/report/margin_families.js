// Families of margins, as `families` of a report has them.
import * as palette from "./palette.js";

const zmps = { zmp: "ZMP of the point mass", zmp_robot: "ZMP of the whole robot" };
const shortZmps = { zmp: "ZMP", zmp_robot: "robot's ZMP" };

/** A family in words. */
export const marginWords = (name) => zmps[name] ?? name.replaceAll("_", " ");

/** Those with a column in trajectory.csv, each with its words, those for a narrow place, and a colour. */
export function drawnFamilies(families) {
  const colours = palette.margins();
  return families.filter(({ column }) => column !== undefined).map((family, i) => ({
    ...family,
    label: marginWords(family.name),
    short: shortZmps[family.name] ?? marginWords(family.name),
    colour: colours[i % colours.length],
  }));
}
