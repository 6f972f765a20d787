// The section that lists the least margins of A; each row leads to its instant.
import { leastMargins, marginText } from "./least_margins.js";
import { element, table } from "./elements.js";

function footstepOf(half) {
  return half ? `footstep ${Math.ceil(half.half_step / 2)}, ${half.kind}` : "";
}

/** `onGo(instant)` is called for a row that is chosen. */
export function leastTable(parent, walk, families, onGo) {
  const rows = leastMargins(walk, families).map((least) => {
    const go = element("button", { text: `${least.t.toFixed(2)} s`, className: "go" });
    go.addEventListener("click", () => onGo(least));
    const half = walk.halfStepAt(walk.locate(least.t));
    const missed = least.slack < 0;
    return [
      go,
      least.label,
      element("span", { text: marginText(least.value, least.unit), className: missed ? "no" : "" }),
      marginText(least.demanded, least.unit),
      missed ? element("span", { className: "no", text: "✗ missed" }) : "kept",
      footstepOf(half),
      least.pair ? least.pair.between.join(" – ") : "",
    ];
  });
  parent.replaceChildren(
    element("h2", { text: `Least margins of A, ${walk.label}` }),
    table(["go to", "margin", "least", "demanded", "", "in", "between"], rows),
    element("p", { className: "small", text: "Of the rows that are drawn, the worst first " +
      "(by margin less what is demanded, over its scale). What holds at every instant is below." }),
  );
}
