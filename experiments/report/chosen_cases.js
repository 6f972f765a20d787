// The cases of a cell or a point: what they set, and what each method came to.
import { figure } from "./charts.js";
import { element, table } from "./elements.js";

const mostRows = 40;
const text = (value, digits = 4) => (value === null ? "–" : figure(value, digits));

function verdict(cases, m, i) {
  const proved = cases.tables[m].solved[i];
  return element("span", { className: proved ? "yes" : "no", text: proved ? "✓ proved" : "✗ not proved" });
}

function caseCell(cases, i) {
  const link = (file, words) => {
    const made = element("a", { text: words });
    made.href = `${cases.folder(i)}/${file}`;
    made.target = "_blank";
    made.rel = "noopener";
    return made;
  };
  const cell = element("span", {}, `${cases.ids[i]} `, link("config.yaml", "config"));
  if (cases.reports.has(i)) cell.append(" ", link("report.html", "report"));
  return cell;
}

function rowsOf(cases, i) {
  return cases.methods.map((_, m) => m).filter((m) => cases.has(m, i)).map((m, k) => {
    const of = cases.tables[m];
    const status = cases.statuses[of.status[i]];
    const words = cases.notRepeatable[status];
    const margin = of.margin[i] === null ? "–" : `${cases.families[of.margin_of[i]]} ${text(of.margin[i], 3)}`;
    return [k === 0 ? caseCell(cases, i) : "", ...cases.axes.map((axis) => (k === 0 ? axis.texts[axis.at[i]] : "")),
      cases.methods[m], element("span", { text: words ? `${status} (${words})` : status, title: cases.meanings[status] }), verdict(cases, m, i),
      text(of.duration[i], 5), margin.replaceAll("_", " "), text(of.effort[i], 4),
      of.message[i] === null ? "" : cases.messages[of.message[i]]];
  });
}

/** `list`: cases; `words`: what was chosen. */
export function showCases(parent, cases, list, words) {
  const title = element("h2", { text: list.length === 1 ? "The chosen case" : `The ${list.length} chosen cases` });
  const rows = [];
  let shown = 0;
  for (const i of list) {
    if (rows.length >= mostRows) break;
    rows.push(...rowsOf(cases, i));
    ++shown;
  }
  parent.hidden = false;
  parent.replaceChildren(title, element("p", { className: "hint", text: words }));
  if (list.length) {
    parent.append(table(["case", ...cases.axes.map((axis) => axis.label), "method", "status", "for all t",
      "duration [s]", "worst margin [m, rad, s]", "effort", "message"], rows));
  }
  if (shown < list.length) {
    parent.append(element("p", { className: "small", text: `and ${list.length - shown} more, in runs.csv` }));
  }
}
