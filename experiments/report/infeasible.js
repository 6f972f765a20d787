// What is told of a walk that is not feasible: infeasible.json of its run.
import { element } from "./elements.js";

/** What the run tells of a walk of a case, or undefined. */
export const infeasibleOf = (oneCase, walk) => walk && oneCase.infeasible?.[walk.method];

/** {t, pair} of the demand that is missed most, or null. `pair` is where its bodies are nearest. */
export function gravestInstant(oneCase, walk) {
  const worst = infeasibleOf(oneCase, walk)?.missed[0];
  if (!worst) return null;
  const near = walk.nearest.find((pair) => pair.between.join(" - ") === worst.subject);
  return { t: worst.t_s, pair: near };
}

/** Its first sentence: what the inputs have wrong, or the demand that is missed most. */
export const firstSentence = (told) => told?.inputs[0] ?? told?.missed[0]?.sentence;

/** The section that lists it; `onGo(instant)` is called for a demand that is chosen. */
export function infeasibleList(parent, oneCase, walk, onGo) {
  const told = infeasibleOf(oneCase, walk);
  parent.hidden = !told;
  if (!told) return;
  const demands = told.missed.map(({ t_s: t, sentence }) => {
    const go = element("button", { text: `${t.toFixed(2)} s`, className: "go" });
    go.addEventListener("click", () => onGo({ t }));
    return element("li", {}, go, ` ${sentence}`);
  });
  const lines = (texts) => element("ul", {}, ...texts.map((text) => element("li", { text })));
  parent.replaceChildren(
    element("h2", { text: `Why A, ${walk.label}, is not feasible` }),
    ...(told.inputs.length ? [element("p", { text: "Looks like a mistake in the config:" }), lines(told.inputs)] : []),
    element("p", { text: "Missed, the worst first:" }), element("ul", {}, ...demands),
    ...(told.help.length ? [element("p", { text: "What would help:" }), lines(told.help)] : []),
  );
}
