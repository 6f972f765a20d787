// The section that lists the least margins of A; each row leads to its instant.
import { leastMargins, marginText, provedText } from "./least_margins.js";
import { element, table } from "./elements.js";

function footstepOf(half) {
  return half ? `footstep ${Math.ceil(half.half_step / 2)}, ${half.kind}` : "";
}

/** `onGo(instant)` is called for a row that is chosen. */
export function leastTable(parent, walk, families, onGo) {
  const all = leastMargins(walk, families);
  const rows = all.map((least) => {
    const go = element("button", { text: `${least.t.toFixed(2)} s`, className: "go" });
    go.addEventListener("click", () => onGo(least));
    const half = walk.halfStepAt(walk.locate(least.t));
    const missed = least.slack < 0;
    return [
      go,
      least.label,
      element("span", { text: marginText(least.value, least.unit), className: missed ? "no" : "" }),
      provedText(least.proved, least.unit),
      marginText(least.demanded, least.unit),
      element("span", { text: least.slack.toFixed(2), title: `1 is ${marginText(least.scale, least.unit)}` }),
      missed ? element("span", { className: "no", text: "✗ missed" }) : "kept",
      footstepOf(half),
      least.pair ? least.pair.between.join(" – ") : "",
    ];
  });
  const scales = all.map(({ label, scale, unit }) => `${label} ${marginText(scale, unit)}`);
  parent.replaceChildren(
    element("h2", { text: `Least margins of A, ${walk.label}` }),
    table(["go to", "margin", "sampled", "proved for all t", "demanded", "slack", "", "in", "between"], rows),
    element("p", { className: "small" }, "Sampled: the least of the rows that are drawn. Proved: it is " +
      "nowhere less, at no instant; bounds are coarser than samples. ",
      element("b", { text: "Slack" }), " is what is left of a margin, (margin − demanded) / scale. It has " +
      "no unit: at 0 a margin is just what is demanded, below 0 less, and at 1 larger by its scale: " +
      `${scales.join(", ")}.`),
  );
}
