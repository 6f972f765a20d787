// Videos of a run by `halfstep report --video`.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { pause } from "./browser.mjs";

/** `place` has the folder run; `halfstep` is the program. */
export async function testVideo(browser, halfstep, place) {
  const temporary = join(place, "temporary");
  mkdirSync(temporary);
  const env = { ...process.env, TMPDIR: temporary };
  const options = ["report", "run", "--quiet", "--video"];
  execFileSync(halfstep, [...options, "walk.webm", "--seconds", "0.2", "--show", "a=raw&b=none&camera=feet"],
               { cwd: place, env });
  await browser.load("about:blank"); // then the page of the video
  await browser.load(`file://${place}/walk.webm`);
  const video = await browser.send("POST", "/execute/async", { args: [], script: `
    const done = arguments[0], video = document.querySelector("video");
    const tell = () => done([video.videoWidth, video.videoHeight, video.duration, video.currentTime]);
    video.pause();
    video.addEventListener("seeked", tell);
    video.addEventListener("error", () => done(video.error.message));
    const seek = () => { video.currentTime = 0.15; };
    if (video.readyState > 0) seek(); else video.addEventListener("loadedmetadata", seek);` });
  assert.deepEqual(video.slice(0, 2), [1280, 720], `a video: ${video}`);
  assert.ok(Math.abs(video[2] - 7 / 30) < 0.002 && video[3] === 0.15, `0.2 s and the last frame: ${video}`);
  await browser.console(); // of the browser's own page

  const refused = (more, extra = {}) =>
    spawnSync(halfstep, [...options, ...more], { cwd: place, env: { ...env, ...extra }, encoding: "utf8" });
  const unknown = refused(["no.webm", "--show", "a=rwa"]);
  assert.equal(unknown.status, 2);
  assert.match(unknown.stderr, /--show: a: rwa \(valid: raw, dichotomy, /);
  const none = refused(["no.webm"], { PATH: dirname(halfstep) });
  assert.equal(none.status, 1);
  assert.match(none.stderr, /PATH has no browser/);

  const stopped = spawn(halfstep, [...options, "no.webm"], { cwd: place, env, stdio: "ignore" });
  while (readdirSync(temporary).length === 0) await pause(50);
  await pause(500);
  stopped.kill("SIGINT");
  assert.equal(await new Promise((resolve) => stopped.on("exit", resolve)), 130);
  assert.ok(!existsSync(join(place, "no.webm")), "no half file");
  assert.deepEqual(readdirSync(temporary), [], "nothing is left behind");
}
