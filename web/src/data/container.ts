// Reads the containers of scenes and light: a JSON header and named arrays. docs/walk.md describes the format.

import { floatFromHalf } from "./half";

const MAGIC = "STILBWLK";
const VERSION = 1;
const BYTES = { f32: 4, f16: 2, u32: 4, u16: 2, u8: 1, s16: 2 } as const;

interface ArrayEntry {
  type: keyof typeof BYTES;
  components: number;
  count: number;
  offset: number;
  planes?: boolean;
}

export class Container<Header extends object = object> {
  constructor(
    readonly header: Header & { arrays: Record<string, ArrayEntry> },
    private readonly bytes: Uint8Array,
  ) {}

  has(name: string): boolean {
    return name in this.header.arrays;
  }

  count(name: string): number {
    return this.entry(name).count;
  }

  /** f32, or f16 widened. */
  floats(name: string): Float32Array {
    const { type } = this.entry(name);
    if (type === "f16") return Float32Array.from(this.halves(name), (half) => floatFromHalf[half]!);
    this.require(name, "f32");
    return new Float32Array(this.interleaved(name).buffer);
  }

  /** f16 as its bits, which take half of the memory, and which graphics cards read. */
  halves(name: string): Uint16Array {
    this.require(name, "f16");
    return new Uint16Array(this.interleaved(name).buffer);
  }

  signed16(name: string): Int16Array {
    this.require(name, "s16");
    return new Int16Array(this.interleaved(name).buffer);
  }

  unsigned(name: string): Uint32Array | Uint16Array | Uint8Array {
    const { type } = this.entry(name);
    const buffer = this.interleaved(name).buffer;
    if (type === "u32") return new Uint32Array(buffer);
    if (type === "u16") return new Uint16Array(buffer);
    this.require(name, "u8");
    return new Uint8Array(buffer);
  }

  private require(name: string, type: string) {
    const found = this.entry(name).type;
    if (found !== type) throw new Error(`array "${name}" has the type ${found}; expected ${type}`);
  }

  private entry(name: string): ArrayEntry {
    const entry = this.header.arrays[name];
    if (!entry) throw new Error(`array "${name}" is missing`);
    return entry;
  }

  /** A copy in the ordinary order: element by element, component by component. */
  private interleaved(name: string): Uint8Array<ArrayBuffer> {
    const { type, components, count, offset, planes } = this.entry(name);
    const size = BYTES[type];
    const total = size * components * count;
    if (!(offset >= 0 && offset + total <= this.bytes.length)) {
      throw new Error(`array "${name}" does not fit into its file, which is probably cut off`);
    }
    const source = this.bytes.subarray(offset, offset + total);
    if (!planes) return Uint8Array.from(source);
    const result = new Uint8Array(total);
    const stride = size * components;
    for (let plane = 0; plane < stride; ++plane) {
      const from = plane * count;
      for (let i = 0; i < count; ++i) result[i * stride + plane] = source[from + i]!;
    }
    return result;
  }
}

export function parseContainer<Header extends object>(bytes: Uint8Array): Container<Header> {
  const magic = String.fromCharCode(...bytes.subarray(0, 8));
  if (magic !== MAGIC) throw new Error("these are no data of stilb view");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const version = view.getUint32(8, true);
  if (version !== VERSION) {
    throw new Error(`the data have version ${version}, and this page reads version ${VERSION}`);
  }
  const length = view.getUint32(12, true);
  if (16 + length > bytes.length) throw new Error("the data are cut off");
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(16, 16 + length)));
  const start = Math.ceil((16 + length) / 8) * 8;
  return new Container<Header>(header, bytes.subarray(start));
}

export async function readContainer<Header extends object>(packed: Uint8Array): Promise<Container<Header>> {
  const blob = new Blob([packed as Uint8Array<ArrayBuffer>]);
  const stream = blob.stream().pipeThrough(new DecompressionStream("gzip"));
  return parseContainer<Header>(new Uint8Array(await new Response(stream).arrayBuffer()));
}
