// PNG with a palette of 256 colours: a picture of a page takes a third of what it would with all its colours.
//
// Colours are chosen by median cut: the box of colours that holds the most, times its extent, is halved until there are
// enough boxes; a pixel takes the mean of its box.

import { deflateSync } from "node:zlib";

const COLORS = 256;
/** Bits of a channel by which colours are counted. */
const BITS = 6;

/** An indexed PNG of RGBA pixels. */
export function indexedPng({ width, height, data }) {
  const counts = new Map();
  const keys = new Int32Array(width * height);
  for (let pixel = 0; pixel < keys.length; pixel++) {
    const [r, g, b] = data.subarray(4 * pixel, 4 * pixel + 3);
    const key = ((r >> (8 - BITS)) << (2 * BITS)) | ((g >> (8 - BITS)) << BITS) | (b >> (8 - BITS));
    keys[pixel] = key;
    const seen = counts.get(key) ?? { count: 0, sum: [0, 0, 0] };
    seen.count++;
    [r, g, b].forEach((value, k) => {
      seen.sum[k] += value;
    });
    counts.set(key, seen);
  }
  const boxes = medianCut(
    [...counts].map(([key, { count, sum }]) => ({ key, count, rgb: sum.map((s) => s / count) })),
  );
  const index = new Map(boxes.flatMap((box, at) => box.map(({ key }) => [key, at])));
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) rows[y * (width + 1) + 1 + x] = index.get(keys[y * width + x]);
  }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  const palette = Buffer.from(boxes.flatMap((box) => mean(box).map(Math.round)));
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  const chunks = [
    chunk("IHDR", head),
    chunk("PLTE", palette),
    chunk("IDAT", deflateSync(rows, { level: 9 })),
  ];
  return Buffer.concat([signature, ...chunks, chunk("IEND", Buffer.alloc(0))]);
}

function medianCut(colors) {
  const boxes = [colors];
  while (boxes.length < COLORS) {
    const widest = boxes.map(measured).reduce((best, box) => (box.weight > best.weight ? box : best));
    if (widest.weight === 0) break;
    const box = boxes.splice(boxes.indexOf(widest.box), 1)[0];
    box.sort((a, b) => a.rgb[widest.axis] - b.rgb[widest.axis]);
    const half = box.reduce((sum, { count }) => sum + count, 0) / 2;
    let passed = 0;
    const cut = box.findIndex(({ count }) => {
      passed += count;
      return passed >= half;
    });
    const at = Math.min(box.length - 1, Math.max(1, cut + (cut === 0 ? 1 : 0)));
    boxes.push(box.slice(0, at), box.slice(at));
  }
  return boxes;
}

/** The axis along which a box is longest, and how much there is to gain by cutting it. */
function measured(box) {
  const extents = [0, 1, 2].map((axis) => {
    const values = box.map(({ rgb }) => rgb[axis]);
    return values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b));
  });
  const axis = extents.indexOf(Math.max(...extents));
  const count = box.reduce((sum, one) => sum + one.count, 0);
  return { box, axis, weight: box.length > 1 ? Math.sqrt(count) * extents[axis] ** 2 : 0 };
}

function mean(box) {
  const count = box.reduce((sum, one) => sum + one.count, 0);
  return [0, 1, 2].map((axis) => box.reduce((sum, one) => sum + one.rgb[axis] * one.count, 0) / count);
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const framed = Buffer.alloc(body.length + 8);
  framed.writeUInt32BE(data.length, 0);
  framed.set(body, 4);
  framed.writeUInt32BE(crc32(body), body.length + 4);
  return framed;
}

/** The checksum of PNG. */
function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; k++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}
