// Pictures of a walk from its report, one each 1/RATE s of the walk, and of its end for one second:
// node draw_walk.mjs REPORT.html FOLDER RATE METHOD [ID=VALUE]...   (IDs of the report's controls)
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Browser, pause } from "../../tests/report/browser.mjs";

const [report, folder, rate, method, ...settings] = process.argv.slice(2);
const browser = await Browser.open(1100, 760);
try {
  await browser.load(`file://${resolve(report)}`);
  const place = await browser.run(
    `return [...document.getElementById("method-a").options]
       .find((option) => option.text.startsWith(arguments[0])).value;`, method);
  for (const setting of [`method-a=${place}`, "method-b=-1", ...settings]) {
    const [id, value] = setting.split("=");
    await browser.set(id, { true: true, false: false }[value] ?? value);
  }
  await pause(1500);
  const duration = Number(await browser.run(`return document.getElementById("scrub").max;`));
  const number = Math.ceil(duration * rate);
  for (let i = 0; i <= number + Number(rate); ++i) {
    if (i <= number) {
      await browser.run(
        `const e = document.getElementById("scrub"); e.value = arguments[0];
         e.dispatchEvent(new Event("input")); e.dispatchEvent(new Event("change"));`,
        Math.min(i / rate, duration));
      await pause(60);
    }
    const name = `${String(i).padStart(4, "0")}.png`;
    writeFileSync(join(folder, name), await browser.picture("#view"));
  }
} finally {
  await browser.close();
}
