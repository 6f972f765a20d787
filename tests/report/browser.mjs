// Chromium without a screen, driven by WebDriver over HTTP.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export function hasBrowser() {
  return ["chromium", "chromedriver"].every((name) => !spawnSync(name, ["--version"]).error);
}

// WebGL in software. Chromium's sandbox does not start for root.
const flags = [
  "--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-dev-shm-usage",
  ...(process.getuid() === 0 ? ["--no-sandbox"] : []),
];

/** Flags of a browser without WebGL: a page costs a quarter of the time. */
export const flat = ["--disable-3d-apis"];

export class Browser {
  /** A window whose page is `width` times `height` pixels. `more`: further flags. */
  static async open(width, height, more = []) {
    const browser = new Browser();
    browser.isFlat = more === flat;
    browser.profile = mkdtempSync(join(tmpdir(), "halfstep_browser_"));
    browser.driver = spawn("chromedriver", ["--port=0"], { stdio: ["ignore", "pipe", "ignore"] });
    const port = await new Promise((resolve, reject) => {
      let text = "";
      browser.driver.stdout.on("data", (part) => {
        text += part;
        const found = /started successfully on port (\d+)/.exec(text);
        if (found) resolve(found[1]);
      });
      browser.driver.on("exit", () => reject(new Error(`chromedriver ended: ${text}`)));
    });
    browser.url = `http://127.0.0.1:${port}/session`;
    const options = { args: [...flags, ...more, `--user-data-dir=${browser.profile}`] };
    const session = await browser.send("POST", "", {
      capabilities: {
        alwaysMatch: {
          browserName: "chrome",
          "goog:chromeOptions": options,
          "goog:loggingPrefs": { browser: "ALL", performance: "ALL" },
        },
      },
    });
    browser.url += `/${session.sessionId}`;
    await browser.send("POST", "/timeouts", { script: 180_000 }); // axe-core on a busy machine [ms]
    await browser.send("POST", "/goog/cdp/execute", {
      cmd: "Emulation.setDeviceMetricsOverride",
      params: { width, height, deviceScaleFactor: 1, mobile: false },
    });
    return browser;
  }

  async send(method, path, body) {
    const response = await fetch(this.url + path, {
      method,
      body: body ? JSON.stringify(body) : undefined,
      headers: { "content-type": "application/json" },
    });
    const { value } = await response.json();
    if (!response.ok) throw new Error(`${path}: ${value.message}`);
    return value;
  }

  load(url) {
    return this.send("POST", "/url", { url });
  }

  /** Runs the body of a function in the page and returns what it returns. */
  run(script, ...args) {
    return this.send("POST", "/execute/sync", { script, args });
  }

  /** Sets an element's value, or whether it is checked, as its user would. */
  set(id, value) {
    return this.run(
      `const e = document.getElementById(arguments[0]);
       if (typeof arguments[1] === "boolean") e.checked = arguments[1]; else e.value = arguments[1];
       e.dispatchEvent(new Event("input")); e.dispatchEvent(new Event("change"));`, id, value);
  }

  /** Presses a key in the page: " ", "\\uE014" (right arrow) … */
  key(value) {
    const actions = [{ type: "keyDown", value }, { type: "keyUp", value }];
    return this.send("POST", "/actions", { actions: [{ type: "key", id: "keys", actions }] });
  }

  /** PNG of the page, or of an element of it. */
  async picture(selector = null) {
    let path = "/screenshot";
    if (selector) {
      const found = await this.send("POST", "/element", { using: "css selector", value: selector });
      path = `/element/${Object.values(found)[0]}/screenshot`;
    }
    return Buffer.from(await this.send("GET", path), "base64");
  }

  /** Entries of the console since the last call; that WebGL is not there is left out. */
  async console() {
    const said = await this.send("POST", "/se/log", { type: "browser" });
    return this.isFlat ? said.filter(({ message }) => !message.includes("WebGL")) : said;
  }

  /** Addresses that the page has asked for since the last call, data: and blob: ones apart. */
  async requests() {
    const log = await this.send("POST", "/se/log", { type: "performance" });
    return log.map((entry) => JSON.parse(entry.message).message)
      .filter((message) => message.method === "Network.requestWillBeSent")
      .map((message) => message.params.request.url)
      .filter((url) => !/^(data|blob):/.test(url));
  }

  async close() {
    await this.send("DELETE", "").catch(() => {});
    this.driver.kill();
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
