// Writes containers of scenes and light, as docs/walk.md describes them.
import { gzipSync } from "node:zlib";

const ARRAYS = {
  f32: Float32Array, f16: Uint16Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array, s16: Int16Array,
};

/** The bits of a number in half precision, rounded to the nearest. */
export function halfBits(value) {
  const sign = value < 0 || Object.is(value, -0) ? 0x8000 : 0;
  const size = Math.abs(value);
  if (size < 2 ** -14) return sign | Math.round(size * 2 ** 24);
  let exponent = Math.floor(Math.log2(size));
  let fraction = Math.round((size / 2 ** exponent - 1) * 1024);
  if (fraction === 1024) [exponent, fraction] = [exponent + 1, 0];
  if (exponent > 15) throw new Error(`${value} is too large for half precision`);
  return sign | ((exponent + 15) << 10) | fraction;
}

/** arrays: name -> {type, components, values, planes}. */
export function packContainer(header, arrays) {
  const entries = {};
  const parts = [];
  let offset = 0;
  for (const [name, { type, components = 1, values, planes = false }] of Object.entries(arrays)) {
    const source = type === "f16" ? Uint16Array.from(values, halfBits) : values;
    const typed = ARRAYS[type].from(source);
    const bytes = new Uint8Array(typed.buffer);
    const count = typed.length / components;
    entries[name] = { type, components, count, offset, planes };
    const padded = new Uint8Array(Math.ceil(bytes.length / 8) * 8);
    padded.set(planes ? inPlanes(bytes, count) : bytes);
    parts.push(padded);
    offset += padded.length;
  }
  const text = Buffer.from(JSON.stringify({ ...header, arrays: entries }));
  const start = Buffer.alloc(Math.ceil((16 + text.length) / 8) * 8);
  start.write("STILBWLK", "latin1");
  start.writeUInt32LE(1, 8);
  start.writeUInt32LE(text.length, 12);
  text.copy(start, 16);
  return gzipSync(Buffer.concat([start, ...parts]));
}

function inPlanes(bytes, count) {
  const stride = bytes.length / Math.max(count, 1);
  const result = new Uint8Array(bytes.length);
  for (let i = 0; i < count; ++i) {
    for (let plane = 0; plane < stride; ++plane) result[plane * count + i] = bytes[i * stride + plane];
  }
  return result;
}
