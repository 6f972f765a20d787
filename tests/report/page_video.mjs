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
  const show = ["--seconds", "0.2", "--show", "a=raw&b=none&camera=feet"];
  execFileSync(halfstep, [...options, "walk.webm", ...show], { cwd: place, env });
  const video = await lookAt(browser, `file://${place}/walk.webm`);
  assert.deepEqual(video.slice(0, 2), [1280, 720], `a video: ${video}`);
  assert.ok(Math.abs(video[2] - 7 / 30) < 0.002 && video[3] === 0.15, `0.2 s and the last frame: ${video}`);

  const told = spawnSync(halfstep, ["report", "run", "--video", "small.webm", "--video-size", "640x360",
    "--video-rate", "60", ...show], { cwd: place, env, encoding: "utf8" });
  assert.match(told.stderr, /frame 10 of 13\nframe 13 of 13\n$/, "frames are told as it goes");
  const small = await lookAt(browser, `file://${place}/small.webm`);
  assert.deepEqual(small.slice(0, 2), [640, 360], `as large as asked for: ${small}`);
  assert.ok(Math.abs(small[2] - 13 / 60) < 0.002, `of so many frames a second: ${small}`);

  const refused = (more, extra = {}) =>
    spawnSync(halfstep, [...options, ...more], { cwd: place, env: { ...env, ...extra }, encoding: "utf8" });
  const unknown = refused(["no.webm", "--show", "a=rwa"]);
  assert.equal(unknown.status, 2);
  assert.match(unknown.stderr, /--show: a: rwa \(valid: raw, dichotomy, /);
  const odd = refused(["no.webm", "--video-size", "641x360"]);
  assert.equal(odd.status, 2);
  assert.match(odd.stderr, /--video-size: 641x360 \(valid: WIDTHxHEIGHT, two even numbers/);
  const none = refused(["no.webm"], { PATH: dirname(halfstep) });
  assert.equal(none.status, 1);
  assert.match(none.stderr, /PATH has no browser/);

  // Before the browser has started, and while it draws.
  for (const [signal, wait] of [["SIGINT", 500], ["SIGTERM", 0], ["SIGTERM", 6000]]) {
    const stopped = spawn(halfstep, [...options, "no.webm"], { cwd: place, env, stdio: "ignore" });
    while (readdirSync(temporary).length === 0) await pause(20);
    await pause(wait);
    stopped.kill(signal);
    assert.equal(await new Promise((resolve) => stopped.on("exit", resolve)), 130, `${signal} after ${wait} ms`);
    assert.ok(!existsSync(join(place, "no.webm")), "no half file");
    assert.deepEqual(readdirSync(temporary), [], `nothing is left behind by ${signal} after ${wait} ms`);
    const left = spawnSync("pgrep", ["-f", temporary], { encoding: "utf8" }).stdout;
    assert.equal(left ?? "", "", "no process either");
  }
}

// [width, height, duration, the time that a seek to 0.15 s came to] of a video.
async function lookAt(browser, address) {
  await browser.load("about:blank"); // then the page of the video
  await browser.load(address);
  const video = await browser.send("POST", "/execute/async", { args: [], script: `
    const done = arguments[0], video = document.querySelector("video");
    const tell = () => done([video.videoWidth, video.videoHeight, video.duration, video.currentTime]);
    video.pause();
    video.addEventListener("seeked", tell);
    video.addEventListener("error", () => done(video.error.message));
    const seek = () => { video.currentTime = 0.15; };
    if (video.readyState > 0) seek(); else video.addEventListener("loadedmetadata", seek);` });
  await browser.console(); // of the browser's own page
  return video;
}
