// What was told of an episode, by messages of protocol 3, and what of it was true at a time.
import { readable } from "./words.js";

// The last element of a list in the order of `key` that is not after t.
function lastUntil(list, key, t) {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle][key] <= t) low = middle + 1;
    else high = middle;
  }
  return list[low - 1];
}

// A list keeps its order when a message comes twice: on connection the newest are told again.
function put(list, message, name) {
  if (list.at(-1)?.[name] === message[name]) list[list.length - 1] = message;
  else list.push(message);
}

const mostEvents = 2000;
const mostWholes = 100;
const mostWorlds = 5000; // a live page forgets what is older

export class EpisodeRecord {
  constructor() {
    this.hello = null;
    this.worlds = [];
    this.walks = [];
    this.wholes = new Map(); // walks with all of their footsteps, those asked for of late
    this.grants = [];
    this.events = [];
    this.waiting = null; // why there is no walk yet
    this.state = null;
    this.motion = null;
    this.volumes = null; // of the motion in execution
    this.cells = new Map(); // messages `volume` by their numbers
    this.end = null;
  }

  take(message) {
    const what = {
      hello: () => { this.hello = message; },
      waiting: () => { this.waiting = message.reason; },
      world: () => this.takeWorld(message),
      walk: () => this.takeWalk(message),
      grant: () => put(this.grants, message, "grant"),
      event: () => this.takeEvent(message),
      state: () => { this.state = message; },
      motion: () => { this.motion = message; },
      volume: () => this.cells.set(message.volume, message),
      volumes: () => { this.volumes = message; },
      end: () => { this.end = message; },
    }[message.type];
    what?.();
    if (this.events.length > mostEvents) this.events.splice(0, mostEvents / 2);
  }

  takeWorld(message) {
    put(this.worlds, message, "world");
    if (this.worlds.length > mostWorlds) this.worlds.splice(0, mostWorlds / 2);
  }

  // A stop while the robot was held tells no reason of its own.
  takeEvent(message) {
    this.events.push({ ...message, held: this.state?.held ?? false });
  }

  takeWalk(message) {
    this.waiting = null;
    put(this.walks, message, "walk");
  }

  worldAt(t) { return lastUntil(this.worlds, "known_s", t) ?? this.worlds[0]; }
  walkAt(t) { return this.whole(lastUntil(this.walks, "handed_over_s", t) ?? this.walks[0]); }
  grantAt(t) { return lastUntil(this.grants, "t_s", t); }
  eventsUntil(t) { return this.events.filter((event) => event.t_s <= t); }

  /** Walks that were replaced within `span` [s] before t: [walk, its successor, how long ago]. */
  replaced(t, span) {
    const pairs = [];
    for (let i = this.walks.length - 1; i > 0; --i) {
      const age = t - this.walks[i].handed_over_s;
      if (age > span) break;
      if (age >= 0) pairs.push([this.whole(this.walks[i - 1]), this.whole(this.walks[i]), age]);
    }
    return pairs;
  }

  // A walk with all of its footsteps: the first `same` are those of the walk told before it.
  whole(walk) {
    if (!walk?.same) return walk;
    if (this.wholes.size > mostWholes) this.wholes.clear();
    if (!this.wholes.has(walk)) {
      const parts = [walk.footsteps];
      let missing = walk.same;
      for (let i = this.walks.lastIndexOf(walk) - 1; i >= 0 && missing > 0; --i) {
        const { same, footsteps } = this.walks[i];
        if (same >= missing) continue;
        parts.unshift(footsteps.slice(0, missing - same));
        missing = same;
      }
      this.wholes.set(walk, { ...walk, footsteps: parts.flat() });
    }
    return this.wholes.get(walk);
  }
}

/** Each footstep takes two; the first two soles are where the walk starts. */
export const numHalfSteps = (walk) => 2 * (walk.footsteps.length - 2);

/** Of a footstep, by its place in the list: begun, granted (also to land), or to come. */
export function stageOf(footstep, begun, through) {
  const rises = 2 * footstep - 3; // half-steps from 1; the first two are the starting soles
  if (rises <= begun) return "begun";
  return rises + 1 <= through ? "granted" : "to come";
}

// Why the robot came to rest, where its event does not say: what was told last before it.
function whyStopped(event, before) {
  const cause = before.findLast(({ event: name }) => ["unsafe", "contradicted", "lost", "handed_over"].includes(name));
  if (event.held) return "it was told to pause";
  if (!cause || cause.event === "handed_over") return "no further half-step was proved in time";
  return { unsafe: `no safe way on: ${cause.text}`, contradicted: `an obstacle did not keep its bounds: ${cause.text}`,
           lost: "a frame was lost, and what was proved ran out" }[cause.event];
}

const kinds = {
  safe: "the way is safe as it is", resumed: "it walks on", changed: "another way", shortened: "a shorter way",
  smoothed: "a faster walk of the same footsteps", commanded: "as commanded",
};

/** Why a walk took over, in words. */
export function handOverWords({ walk, kind, reason }) {
  if (walk === 0) return `the first: ${reason}`;
  if (kind === "smoothed" && reason === "overlaps") return kinds.smoothed;
  return `${kinds[kind] ?? kind}${reason ? `: ${reason}` : ""}`;
}

const words = {
  handed_over: ({ walk, text, half_step: from }) => {
    const [kind, ...reason] = text.split(": ");
    const why = handOverWords({ walk, kind, reason: reason.join(": ") });
    return walk === 0 ? `walk 0, ${why}` : `walk ${walk} taken over, from half-step ${from} on: ${why}`;
  },
  lost: ({ text }) => `a measurement was lost: ${text}`,
  commanded: ({ text }) => `commanded: ${text}`,
  near: ({ text, half_step: half }) => `half-step ${half} begins ${text}`,
  contradicted: ({ text }) => `did not keep its error and speed: earlier proofs are void: ${text}`,
  refused: ({ text }) => `a walk was refused: ${text}`,
  unsafe: ({ text }) => `no safe way on was found: ${text}`,
  stopped: (event, before) => {
    const [rests, ...awaited] = event.text.split(": ");
    const why = awaited.length ? awaited.join(": ") : whyStopped(event, before);
    return `stops after half-step ${event.half_step}, ${rests}: ${why}`;
  },
  early: ({ text }) => text,
  late: ({ text }) => text,
  pushed: ({ text }) => `pushed: ${text}`,
  error: ({ text }) => `refused: ${text}`,
};

/**
 * An event with its reason in words, given those before it; null for those that happen all the time.
 */
export function inWords(event, before) {
  if (event.event === "measured" || event.event === "begins") return null;
  const text = readable(words[event.event]?.(event, before) ?? `${event.event}: ${event.text}`);
  return event.t_s === null ? text : `${event.t_s.toFixed(2)} s ${text}`;
}
