// Every control of report.html: each test is given a Browser and the address of a page.
import assert from "node:assert/strict";
import { pause } from "./browser.mjs";

const emulate = (browser, name, params) =>
  browser.send("POST", "/goog/cdp/execute", { cmd: `Emulation.${name}`, params });
const click = (browser, id) => browser.run("document.getElementById(arguments[0]).click()", id);
const state = (browser) => browser.run(`
  const of = (id) => document.getElementById(id);
  return { t: Number.parseFloat(of("clock").textContent), a: of("method-a").selectedOptions[0].label,
    b: of("method-b").selectedOptions[0].label, pair: of("pair").hidden ? "" : of("pair").textContent,
    outcome: of("outcome").textContent, hash: location.hash };`);

/** A run of which the methods raw, dichotomy and dichotomy/published are proved. */
export async function testControls(browser, url) {
  await browser.load(`${url}#t=1.25&a=raw&b=dichotomy%2Fpublished`);
  const { t, a, b } = await state(browser);
  assert.deepEqual([t, a, b], [1.25, "raw", "dichotomy/published"], "as the address says");
  await browser.run("location.hash = 't=0.75&b=none'");
  await pause(100);
  assert.deepEqual([(await state(browser)).t, (await state(browser)).b], [0.75, "none"]);

  await browser.set("method-a", "1");
  await browser.key("w");
  const worst = await state(browser);
  const least = await browser.run("return document.querySelector('#least button').textContent");
  assert.equal(worst.t, Number.parseFloat(least), "w goes to the first row of the least margins");
  assert.match(worst.pair, /nearest: .* cm at/);
  await click(browser, "link");
  await pause(100);
  const { hash } = await state(browser);
  assert.match(hash, /^#t=[\d.]+&a=dichotomy&b=none$/);

  await browser.key("?");
  assert.ok(await browser.run("return document.getElementById('help').open"), "? shows the keys");
  await browser.key("\uE00C");
  assert.ok(!(await browser.run("return document.getElementById('help').open")));
  await browser.set("method-b", "0");
  await testPlots(browser);
}

/** Of a page that is open, with two walks. */
async function testPlots(browser) {
  const shown = () => browser.run(`
    return [...document.querySelectorAll(".plot")].map((plot) =>
      [...plot.querySelectorAll(".key")].map((key) => key.getAttribute("aria-pressed")).join());`);
  const press = (shift) => browser.run(`document.querySelector(".plot .key").dispatchEvent(
    new MouseEvent("click", { bubbles: true, shiftKey: arguments[0] }))`, shift);
  await press(false);
  assert.equal((await shown())[0], "false,true", "hidden");
  await press(true);
  assert.equal((await shown())[0], "true,false", "alone");
  await press(true);
  assert.equal((await shown())[0], "true,true", "all again");

  const joint = await browser.run(`const pick = document.querySelector(".pick");
    pick.selectedIndex = pick.selectedIndex === 0 ? 1 : 0;
    pick.dispatchEvent(new Event("change"));
    return { name: pick.value, names: pick.options.length, note: document.querySelector(".note[title]").textContent };`);
  assert.equal(joint.names, 12, "one joint of twelve is picked");
  assert.match(joint.note, /rad\/s at .* rad/);
  await browser.set("pace", "each"); // all is drawn anew
  assert.equal(await browser.run("return document.querySelector('.pick').value"), joint.name, "and stays so");

  const ends = () => browser.run("return document.getElementById('clock').textContent.split('/')[1]");
  const longer = Number.parseFloat(await ends());
  await browser.set("pace", "squeezed");
  assert.ok(Number.parseFloat(await ends()) < longer, "the longer walk is squeezed");
  await browser.set("pace", "each");
  await browser.set("camera", "feet");
}

/** What an open page with a view saves, by the types and sizes of the files. */
export async function testSaving(browser) {
  await browser.run(`window.saved = [];
    URL.createObjectURL = (blob) => { window.saved.push(blob); return "data:,"; };
    HTMLAnchorElement.prototype.click = function () {
      window.saved.push(this.download);
    };
    for (const button of document.querySelector(".plot").querySelectorAll(".save")) button.click();`);
  await click(browser, "picture");
  await browser.set("scrub", "3.9"); // the last tenth of a second: each frame is drawn in software
  await click(browser, "record");
  const deadline = Date.now() + 90000; // the recorder is slow where others compute
  const saved = () => browser.run("return window.saved.map((s) => s.type ? [s.type, s.size] : s)");
  while ((await saved()).length < 8 && Date.now() < deadline) await pause(100);
  const list = await saved();
  const types = list.filter(Array.isArray).map(([type]) => type).sort();
  assert.deepEqual(types, ["image/png", "image/png", "image/svg+xml", "video/webm"], JSON.stringify(list));
  for (const [type, size] of list.filter(Array.isArray)) assert.ok(size > 1500, `${type}: ${size}`);
  assert.ok(list.includes("CoM_and_ZMP_x.svg"), JSON.stringify(list));
  const svg = await browser.run(`return window.saved.find((s) => s.type === "image/svg+xml").text()`);
  const figure = await browser.run(`const read = new DOMParser().parseFromString(arguments[0], "image/svg+xml");
    return { width: read.documentElement.getAttribute("width"), broken: Boolean(read.querySelector("parsererror")),
      paths: read.querySelectorAll("path").length, words: [...read.querySelectorAll("text")].map((text) => text.textContent) };`, svg);
  assert.ok(figure.width === "252pt" && figure.paths > 8 && !figure.broken, JSON.stringify(figure));
  assert.ok(["CoM", "ZMP", "time [s]"].every((word) => figure.words.includes(word)), "lines are named");
}

export async function testPhoneInTheDark(browser, url) {
  await emulate(browser, "setDeviceMetricsOverride",
    { width: 390, height: 844, deviceScaleFactor: 1, mobile: false });
  await emulate(browser, "setEmulatedMedia",
    { features: [{ name: "prefers-color-scheme", value: "dark" }] });
  await browser.load(url);
  const page = await browser.run(`return {
    width: document.documentElement.scrollWidth,
    highest: Math.max(...[...document.querySelectorAll("tbody tr")].map((row) => row.offsetHeight)),
    background: getComputedStyle(document.body).backgroundColor };`);
  assert.ok(page.width <= 390, `no wider than the screen: ${page.width} px`);
  assert.ok(page.highest <= 120, `rows are not tall: ${page.highest} px`);
  assert.equal(page.background, "rgb(18, 23, 29)");
  await emulate(browser, "setEmulatedMedia",
    { features: [{ name: "prefers-color-scheme", value: "light" }] });
  await pause(100);
  const light = await browser.run("return getComputedStyle(document.body).backgroundColor");
  assert.equal(light, "rgb(255, 255, 255)", "the theme follows the system");
  await emulate(browser, "setDeviceMetricsOverride",
    { width: 1366, height: 768, deviceScaleFactor: 1, mobile: false });
}

/** A run whose plan is not feasible: too low over the obstacle. */
export async function testInfeasible(browser, url) {
  await browser.load(url);
  const { t, a, b, outcome } = await state(browser);
  assert.ok(t > 0, "opens at the worst instant");
  assert.deepEqual([a, b], ["raw", "none"]);
  assert.match(outcome, /not proved: footstep 1 \(right\), half-step \S+ at .*: the right leg is /);
  const list = await browser.run(`
    const section = document.getElementById("infeasible");
    return { hidden: section.hidden, text: section.textContent,
             first: section.querySelector("button.go").textContent };`);
  assert.equal(list.hidden, false);
  assert.match(list.text, /Why A, raw, is not feasible.*Missed, the worst first.*tried, and feasible/s);
  assert.ok(Math.abs(Number.parseFloat(list.first) - t) < 0.011, "opens at the gravest");
  await browser.run(`[...document.querySelectorAll("#least tr")]
    .find((row) => /^[\\d.]+ sclearance/.test(row.textContent)).querySelector("button").click()`);
  assert.match((await state(browser)).pair, /nearest: .*LEG_LINK5 – /);
  const missed = await browser.run("return document.querySelectorAll('#least .no').length");
  assert.ok(missed >= 2, "the missed demand is told");
  assert.deepEqual(await browser.console(), [], "the console is empty");
}
