// What a page is to people who cannot see or point well, by axe-core.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";

const laptop = [1366, 768]; // [px]
const telephone = [390, 844];
export const once = [["light", laptop]];
const some = [...once, ["dark", telephone]];
export const all = [...some, ["dark", laptop], ["light", telephone]];

const emulate = (browser, name, params) =>
  browser.send("POST", "/goog/cdp/execute", { cmd: `Emulation.${name}`, params });

async function show(browser, width, height, theme) {
  await emulate(browser, "setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  await emulate(browser, "setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: theme }] });
}

/**
 * The serious and critical faults of the open page, a sentence each: of `looks`, by default on a
 * laptop in the light and a telephone in the dark. `packages`: where axe-core is fetched to; null
 * when it is not.
 */
export async function faultsOf(browser, packages, looks = some) {
  const path = join(packages, "node_modules/axe-core/axe.min.js");
  if (!existsSync(path)) return null;
  await browser.run(readFileSync(path, "utf8"));
  const found = [];
  for (const [theme, [width, height]] of looks) {
    await show(browser, width, height, theme);
    const faults = await browser.send("POST", "/execute/async", { args: [], script: `
      const done = arguments[0];
      requestAnimationFrame(() => requestAnimationFrame(() => axe.run(document, {
        resultTypes: ["violations"],
        runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
      }).then(({ violations }) => done(violations
        .filter(({ impact }) => impact === "serious" || impact === "critical")
        .map(({ id, help, nodes }) => id + ": " + help + ": " + nodes.slice(0, 4)
          .map(({ html, any }) => html.slice(0, 120) + " " + (any[0]?.message ?? "")).join(" | "))),
      (error) => done([String(error)]))));` });
    found.push(...faults.map((fault) => `${theme}, ${width} px: ${fault}`));
  }
  await show(browser, ...laptop, "light");
  return found;
}
