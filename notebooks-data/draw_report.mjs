// A picture of a report, or of the page at an address, at 1366 x 768 pixels, after setting some of
// its controls by their ids: node draw_report.mjs REPORT.html|http://ADDRESS OUT.png [ID=VALUE]...
import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { Browser, pause } from "../tests/report/browser.mjs";

const [report, out, ...settings] = process.argv.slice(2);
const browser = await Browser.open(1366, 768);
try {
  await browser.load(report.startsWith("http:") ? report : `file://${resolve(report)}`);
  for (const setting of settings) {
    const [id, value] = setting.split("=");
    await browser.set(id, { true: true, false: false }[value] ?? value);
  }
  await pause(1500);
  writeFileSync(out, await browser.picture());
} finally {
  await browser.close();
}
