// Reads the PNG files that a browser makes: 8 bits, RGB or RGBA, not interlaced.
import { inflateSync } from "node:zlib";

/** {width, height, pixel(x, y)}: a pixel is 0xRRGGBB. */
export function readPng(bytes) {
  const parts = [];
  let header = null;
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    const type = bytes.toString("latin1", at + 4, at + 8);
    const body = bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at));
    if (type === "IHDR") header = body;
    if (type === "IDAT") parts.push(body);
  }
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const channels = { 2: 3, 6: 4 }[header[9]];
  if (header[8] !== 8 || !channels || header[12] !== 0) throw new Error("not such a PNG");
  const rows = inflateSync(Buffer.concat(parts));
  const line = width * channels;
  const out = new Uint8Array(line * height);
  const value = (x, y) => (x < 0 || y < 0 ? 0 : out[y * line + x]);
  for (let y = 0; y < height; ++y) {
    const filter = rows[y * (line + 1)];
    for (let x = 0; x < line; ++x) {
      const [a, b, c] = [value(x - channels, y), value(x, y - 1), x < channels ? 0 : value(x - channels, y - 1)];
      const p = a + b - c;
      const nearest = [a, b, c].reduce((best, v) => (Math.abs(p - v) < Math.abs(p - best) ? v : best));
      const predicted = [0, a, b, (a + b) >> 1, nearest][filter];
      out[y * line + x] = rows[y * (line + 1) + 1 + x] + predicted;
    }
  }
  const pixel = (x, y) => {
    const at = y * line + x * channels;
    return (out[at] << 16) | (out[at + 1] << 8) | out[at + 2];
  };
  return { width, height, pixel };
}

/** How many different colours there are among pixels `spacing` apart. */
export function countColours({ width, height, pixel }, spacing = 4) {
  const seen = new Set();
  for (let y = 0; y < height; y += spacing) {
    for (let x = 0; x < width; x += spacing) seen.add(pixel(x, y));
  }
  return seen.size;
}

/** The part of the pixels `spacing` apart that differ. */
export function partThatDiffers(one, other, spacing = 2) {
  let [different, all] = [0, 0];
  for (let y = 0; y < one.height; y += spacing) {
    for (let x = 0; x < one.width; x += spacing, ++all) {
      if (one.pixel(x, y) !== other.pixel(x, y)) ++different;
    }
  }
  return different / all;
}
