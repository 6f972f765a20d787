// What of the walks is drawn: a box each, with its name in the data, its words, and whether at first.
import { instants } from "./traces.js";

export const layers = [
  ["footprints", "footprints", true],
  ["balance", "ZMP, CoM, support polygon", true],
  ["paths", "paths", false],
  ["soles", "sole traces (sampled)", false],
  ["strobe", `body at ${instants} instants`, false],
  ["bodies", "bodies that proofs use", false],
  ["volumes", "swept volumes", false],
];

/** Puts the boxes, show-NAME, into `parent`. */
export function addLayerBoxes(parent, onChange) {
  for (const [name, label, checked] of layers) {
    const box = document.createElement("input");
    box.type = "checkbox";
    box.id = `show-${name}`;
    box.checked = checked;
    box.addEventListener("change", onChange);
    const choice = document.createElement("label");
    choice.append(box, label);
    parent.append(choice);
  }
}

/** Offers a layer or not; one that is not offered is not shown. */
export function offerLayer(name, offered) {
  const box = document.getElementById(`show-${name}`);
  if (!offered) box.checked = false;
  box.parentElement.hidden = !offered;
}
