// Pictures of reports at 1366 x 768, 1920 x 1080 and 390 x 844 pixels, light and dark, of what is
// first seen and of the whole page: node draw_reports.mjs OUT_FOLDER REPORT.html...
// OUT_FOLDER/NAME_WIDTHxHEIGHT_THEME.png and …_whole.png, NAME being the report's folder. Tells what
// is wider than the screen and what the console says.
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { Browser, pause } from "../tests/report/browser.mjs";

const [out, ...reports] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
const browser = await Browser.open(1366, 768);
const devtools = (cmd, params) => browser.send("POST", "/goog/cdp/execute", { cmd, params });
try {
  for (const report of reports) {
    const path = resolve(report);
    for (const [width, height] of [[1366, 768], [1920, 1080], [390, 844]]) {
      for (const theme of ["light", "dark"]) {
        await devtools("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
        await devtools("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: theme }] });
        await browser.load("about:blank");
        await browser.load(`file://${path}`);
        await pause(1500);
        const name = join(out, `${basename(dirname(path))}_${width}x${height}_${theme}`);
        writeFileSync(`${name}.png`, await browser.picture());
        const { data } = await devtools("Page.captureScreenshot", { captureBeyondViewport: true });
        writeFileSync(`${name}_whole.png`, Buffer.from(data, "base64"));
        const wide = await browser.run("return document.documentElement.scrollWidth");
        const said = await browser.console();
        if (wide > width || said.length > 0) console.log(name, `${wide} px wide`, JSON.stringify(said));
      }
    }
  }
} finally {
  await browser.close();
}
