// The tables below the stage.
import { element, table } from "./elements.js";
import { marginWords } from "./margin_families.js";
import { readable } from "./words.js";

const seconds = (value) => value.toFixed(3);
const number = (value, digits = 4) =>
  typeof value === "number" ? String(Number(value.toPrecision(digits))) : value ?? "–";

function bar(fraction, className) {
  const fill = element("i", { className });
  fill.style.width = `${Math.max(0, Math.min(1, fraction)) * 100}%`;
  return element("span", { className: "meter" }, fill);
}

const verdict = (walk) =>
  walk.certified ? element("span", { className: "yes", text: "✓ proved" })
    : element("span", { className: "no", text: "✗ not proved" });

/** One row a method. */
export function summaryTable(parent, walks, families, endings) {
  const longest = Math.max(...walks.map((walk) => walk.summary.duration_s));
  const unit = Object.fromEntries(families.map((family) => [family.name, family.unit]));
  const compared = walks.some((walk) => walk.gap !== undefined);
  const bounded = walks.some((walk) => Number.isFinite(walk.summary.gap_lipm));
  const replayed = walks.some((walk) => walk.summary.stands !== undefined);
  const degrees = (rad) => (Number.isFinite(rad) ? `, ${number(rad * 180 / Math.PI, 2)}°` : "");
  const rows = walks.map((walk) => {
    const s = walk.summary;
    const above = Number.isFinite(s.gap_lipm) ? `${number(100 * s.gap_lipm, 3)} %` : "–";
    const last = compared
      ? [walk.gap === null || walk.gap === undefined ? "–" : `${number(100 * walk.gap, 3)} %`]
      : [`${marginWords(s.worst_margin_name)} ${number(s.worst_margin, 3)} ${unit[s.worst_margin_name] ?? ""}`,
         number(s.iterations)];
    const status = { text: s.not_repeatable ? `${s.status} (${s.not_repeatable})` : s.status,
                     title: endings[s.status], className: s.own ? "" : "no" };
    return [walk.label, element("span", status), verdict(walk),
            seconds(s.duration_s), bar(s.duration_s / longest, "a"), s.speedup.toFixed(2),
            ...(bounded ? [above] : []),
            ...(replayed ? [`${s.stands ?? "–"}${degrees(s.replay_tilt_rad)}`] : []), ...last, number(s.effort, 3), number(s.wall_s, 3)];
  });
  parent.replaceChildren(
    element("h2", { text: "Methods" }),
    table(["method", "status", "for all t", "duration [s]", "", "speed-up",
           ...(bounded ? ["above the bound"] : []),
           ...(replayed ? ["simulated: stands, median tilt"] : []),
           ...(compared ? ["gap to the best"] : ["worst margin", "candidates"]),
           "effort", "run time [s]"], rows),
  );
}

/** Durations of every method in every scenario of a comparison. */
export function scenarioTable(cases) {
  const methods = [...new Set(cases.flatMap((one) => one.walks.map((walk) => walk.label)))];
  const rows = cases.map((one) => {
    const proved = one.walks.filter((walk) => walk.certified && walk.summary.own);
    const best = Math.min(...proved.map((walk) => walk.summary.cost));
    return [one.scenario, one.objective, ...methods.map((method) => {
      const walk = one.walks.find((w) => w.label === method);
      if (!walk) return "–";
      if (!walk.certified) return element("span", { className: "no", text: "✗" });
      if (!walk.summary.own) return element("span", { className: "no", text: walk.summary.status });
      const isBest = walk.summary.cost === best;
      return element("span", { text: seconds(walk.summary.duration_s), className: isBest ? "best" : "" });
    })];
  });
  return [element("h2", { text: "Scenarios: durations [s] of the proved walks" }),
          table(["scenario", "objective", ...methods], rows)];
}

/** Overlaps of walk A, junction by junction, and what holds each; B's as a thin bar below. */
export function junctionTable(parent, [a, b]) {
  const title = element("h2", { text: `Overlaps of A, ${a.label}` });
  if (a.overlaps.length === 0) {
    parent.replaceChildren(title, element("p", { text: "None: half-steps one after the other." }));
    return;
  }
  const other = b?.overlaps.length === a.overlaps.length ? b.overlaps : null;
  const widest = Math.max(...a.overlaps.map((row) => row.upper_bound_s),
                          ...(other ?? []).map((row) => row.overlap_s));
  if (other) title.append(element("small", {}, element("i", { className: "swatch b" }), ` B, ${b.label}`));
  const rows = a.overlaps.map((row, i) => {
    const bound = element("i", { className: "bound" });
    bound.style.width = `${(row.upper_bound_s / widest) * 100}%`;
    const meter = bar(row.overlap_s / widest, "a");
    meter.prepend(bound);
    if (other) {
      const second = element("i", { className: "b" });
      second.style.width = `${(other[i].overlap_s / widest) * 100}%`;
      meter.append(second);
    }
    return [number(row.junction), row.kind === "up_down" ? "up → down" : "down → up", meter,
            seconds(row.overlap_s), seconds(row.upper_bound_s),
            row.price_s === null ? "" : seconds(row.price_s), readable(row.limited_by)];
  });
  parent.replaceChildren(title,
    table(["junction", "kind", "overlap and its bound", "overlap [s]", "bound [s]",
           "price [s]", "limited by"], rows),
    element("p", { className: "small", text: "Price: how much shorter the walk would be if one scale " +
      "less were demanded of what limits the overlap, by this overlap alone, to first order." }));
}

/**
 * What certificates do not speak of, and why: the list by its kinds, pairs of bodies by the
 * reason.
 */
function notCovered(list) {
  if (!list.length) return element('p', {text: 'All that is demanded is covered.'});
  const [pairs, others] =
      [list.filter((one) => one.kind === 'pair'), list.filter((one) => one.kind !== 'pair')];
  const reason = (pair) =>
      pair.sentence.slice(pair.subject.length).replace(/^: (not watched: )?/, '');
  const reasons = [...new Set(pairs.map(reason))];
  const rows = reasons.map(
      (why) =>
          [why,
           pairs.filter((pair) => reason(pair) === why).map((pair) => pair.subject).join(', ')]);
  return element(
      'div', {className: 'not-covered'},
      element(
          'h3', {text: `Not covered: ${list.length} ${list.length === 1 ? 'thing' : 'things'}`}),
      element('ul', {}, ...others.map((one) => element('li', {text: one.sentence}))),
      ...(pairs.length ?
              [element(
                  'details', {},
                  element('summary', {text: `Not watched: ${pairs.length} pairs of bodies`}),
                  table(['why', 'bodies'], rows))] :
              []));
}

/** How far motions may be from the walk, and what that raises; '' where it is the walk alone. */
function tubeWords(tube) {
  if (!tube) return '';
  const degrees = (angle) => `${number(angle * 180 / Math.PI)}°`;
  const raised = Object.entries(tube.raised).filter(([, by]) => by > 0)
                     .map(([name, by]) => `${marginWords(name)} by ${number(by)}`);
  return `Tube: soles within ${number(tube.foot_m)} m and ${degrees(tube.foot_rad)} of the walk, ` +
      `waist ${number(tube.waist_m)} m and ${degrees(tube.waist_rad)}, leg joints ` +
      `${number(tube.joint_rad)} rad and ${number(tube.joint_speed_rad_s)} rad/s, ZMP ` +
      `${number(tube.zmp_m)} m. It raises what is demanded of ${raised.join(', ')}, and takes up to ` +
      `${number(tube.taken.clearance)} m from the clearance of a body, ` +
      `${number(tube.taken.self_clearance)} m from that of a pair.`;
}

/** The statement, and the verdict on each walk. */
export function guarantee(parent, statement, walks) {
  const shown = walks.filter((walk) => walk.certificate);
  const list = shown.map((walk) => {
    const c = walk.certificate;
    const count = Object.values(c.statements).reduce((a, b) => a + b, 0);
    return [walk.label, verdict(walk), number(count), readable(c.message)];
  });
  const one = shown[0]?.certificate;
  const limits = { foot_speed: one?.limits.foot_speed_m_s, foot_yaw_rate: one?.limits.foot_yaw_rate_rad_s };
  const demanded = Object.entries(one?.demanded ?? {}).filter(([, value]) => value !== null).map(([name, value]) =>
    `${marginWords(name)} ≥ ${number(value)}` +
    (limits[name] ? ` (limit ${number(limits[name])})` : ""));
  const [promised, excepted] = (one?.tube ? one.statement : statement).split(/(?=Not guaranteed:)/);
  parent.replaceChildren(
      element('h2', {text: 'What is guaranteed'}),
      element('p', {text: promised}),
      table(['method', 'verdict', 'statements at every instant', ''], list),
      element('p', {
        className: 'small',
        text: demanded.length ? `Demanded [m, rad, s]: ${demanded.join(', ')}.` : ''
      }),
      ...(one?.tube ? [element('p', {className: 'small', text: tubeWords(one.tube)})] : []),
      element('p', {text: excepted ?? ''}),
      notCovered(one?.not_covered ?? []),
  );
}
