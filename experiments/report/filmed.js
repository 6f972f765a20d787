// What a film needs of the report's page.
import { parsedAddress, unknownIn } from "./address.js";

const byId = (id) => document.getElementById(id);

/**
 * The page of a Film and of filmByCommand. `page` has: hasView(), walks() as they are shown, timeline,
 * draw(t), which draws an instant at once, drawnWalks(), those that can be chosen, and applyAddress(asked).
 */
export function filmedPage({ hasView, walks, timeline, draw, drawnWalks, applyAddress }) {
  return {
    canvas: byId("canvas"),
    hasView,
    begin: () => (timeline.t < timeline.duration ? timeline.t : 0),
    duration: () => timeline.duration,
    show: draw,
    captions: () => ({
      names: walks().map((walk, i) => byId(`tag-${"ab"[i]}`).textContent),
      beside: byId("view").classList.contains("beside"),
      clock: `${timeline.t.toFixed(2)} s`,
    }),
    choose(address) {
      timeline.seek(0);
      const asked = parsedAddress(address);
      const unknown = unknownIn(asked, drawnWalks(), byId("camera"));
      if (!unknown) applyAddress(asked);
      return unknown;
    },
  };
}
