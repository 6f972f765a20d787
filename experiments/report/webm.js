// A WebM file of one video track, without sound. Source: [RFC9559].

const ids = {
  ebml: 0x1a45dfa3, version: 0x4286, readVersion: 0x42f7, maxIdLength: 0x42f2, maxSizeLength: 0x42f3,
  docType: 0x4282, docTypeVersion: 0x4287, docTypeReadVersion: 0x4285,
  segment: 0x18538067, info: 0x1549a966, timecodeScale: 0x2ad7b1, duration: 0x4489,
  muxingApp: 0x4d80, writingApp: 0x5741,
  tracks: 0x1654ae6b, track: 0xae, number: 0xd7, uid: 0x73c5, type: 0x83, codec: 0x86,
  lacing: 0x9c, video: 0xe0, width: 0xb0, height: 0xba,
  cluster: 0x1f43b675, timecode: 0xe7, block: 0xa3,
};

const unknownSize = [0x01, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff];

// The bytes of a whole number ≥ 0, the highest first.
function whole(number) {
  const bytes = [];
  for (let rest = number; rest > 0; rest = Math.floor(rest / 256)) bytes.unshift(rest % 256);
  return bytes.length ? bytes : [0];
}

// How long an element is: eight bytes, the first of which says that they are eight.
function size(length) {
  const bytes = whole(length);
  return [0x01, ...new Array(7 - bytes.length).fill(0), ...bytes];
}

function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

const element = (name, ...content) => {
  const body = joined(content);
  return joined([whole(ids[name]), size(body.length), body]);
};
const number = (name, value) => element(name, whole(value));
const text = (name, value) => element(name, new TextEncoder().encode(value));
function real(name, value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return element(name, bytes);
}

/** The file's begin. `codec`: "V_VP9" or "V_VP8"; `duration` [s]. */
export function webmHead({ codec, width, height, duration }) {
  return joined([
    element("ebml", number("version", 1), number("readVersion", 1), number("maxIdLength", 4),
            number("maxSizeLength", 8), text("docType", "webm"), number("docTypeVersion", 4),
            number("docTypeReadVersion", 2)),
    whole(ids.segment), unknownSize,
    element("info", number("timecodeScale", 1000000), real("duration", 1000 * duration),
            text("muxingApp", "halfstep"), text("writingApp", "halfstep")),
    element("tracks", element("track", number("number", 1), number("uid", 1), number("type", 1),
                              number("lacing", 0), text("codec", codec),
                              element("video", number("width", width), number("height", height)))),
  ]);
}

/**
 * Frames [{time [ms], key, bytes}] that follow each other, the first of them a key frame. All lie
 * within 32 s.
 */
export function webmCluster(frames) {
  const begin = frames[0].time;
  const blocks = frames.map(({ time, key, bytes }) => {
    const after = time - begin;
    return element("block", [0x81, after >> 8, after & 255, key ? 0x80 : 0], bytes);
  });
  return element("cluster", number("timecode", begin), ...blocks);
}
