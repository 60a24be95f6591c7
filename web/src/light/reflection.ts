// Luminance of glossy light vertices towards an eye, from the stored light and the materials' tables.

import type { Scene } from "../data/scene";
import { luminance } from "./luminance";

/** Zernike's terms (j, m) and (j, -m) of one order. */
interface TermPair {
  m: number;
  cosine: number;
  sine: number;
}

export function termCount(degree: number): number {
  return ((degree + 1) * (degree + 2)) / 2;
}

function termPairs(degree: number): TermPair[] {
  const pairs: TermPair[] = [];
  for (let j = 0; j <= degree; ++j) {
    for (let m = j % 2; m <= j; m += 2) {
      pairs.push({ m, cosine: (j * (j + 2) + m) / 2, sine: (j * (j + 2) - m) / 2 });
    }
  }
  return pairs;
}

/** Beyond this angle behind a surface, no pixel near a light vertex can see it. */
const HIDDEN_COSINE = -0.5;
const LAST_ROW = Math.PI / 2 - (0.1 * Math.PI) / 180;

/** The directions of the reflection tables for one eye. */
interface Row {
  theta: number;
  fraction: number;
}

function rowAt(cosine: number, thetas: number): Row {
  const angle = Math.min(Math.acos(Math.min(Math.max(cosine, 0), 1)), LAST_ROW);
  const step = Math.PI / 2 / (thetas - 1);
  const theta = Math.min(Math.floor(angle / step), thetas - 2);
  const end = theta === thetas - 2 ? LAST_ROW : (theta + 1) * step;
  return { theta, fraction: Math.min((angle - theta * step) / (end - theta * step), 1) };
}

export class ReflectedLight {
  private readonly pairs: TermPair[];
  private readonly terms: number;
  private readonly cosines: Float64Array;
  private readonly sines: Float64Array;
  /** Light vertices whose luminance changes with the eye. */
  readonly glossy: number[] = [];

  constructor(private readonly scene: Scene) {
    const { degree } = scene.header;
    this.pairs = termPairs(degree);
    this.terms = termCount(degree);
    this.cosines = new Float64Array(degree + 1);
    this.sines = new Float64Array(degree + 1);
    for (let i = 0; i < scene.lightVertexCount; ++i) {
      const hasTerms = scene.lightTerms[i + 1]! - scene.lightTerms[i]! > 1;
      if (hasTerms && scene.reflections[scene.lightMaterials[i]!]) this.glossy.push(i);
    }
  }

  /** Writes [cd/m2] of all glossy light vertices towards the eye; `terms`: rgb of each stored term. */
  towards(eye: readonly number[], terms: Float32Array, result: Float32Array) {
    for (const vertex of this.glossy) this.evaluate(vertex, eye, terms, result);
  }

  /**
   * What a light vertex would show [cd/m2] if each term were as large as its noise in proportion to that of the first
   * one, and all added up in quadrature. Times the relative error of the first term, it is the error of the luminance:
   * a lobe gathers more noise than the illuminance has. The noise grows with the degree j, since directions in frames
   * are even for the illuminance, but not for finer terms: measured over solutions of several seeds, 1.2 times at
   * degree 1, 1.8 at 3, 2.4 at 6, and sqrt(j + 1) is a little more.
   */
  inQuadrature(vertex: number, eye: readonly number[], terms: Float32Array): number {
    const { lightMaterials, lightTerms, reflections, header } = this.scene;
    const direction = this.towardsEye(vertex, eye);
    const material = lightMaterials[vertex]!;
    const { thetas = 33, phis = 1 } = header.materials[material]!;
    const table = reflections[material];
    if (!direction || !table) return 0;
    const { theta, fraction } = rowAt(direction.cosine, thetas);
    const turn = Math.atan2(direction.y, direction.x) / (2 * Math.PI);
    const entry = (theta + Math.round(fraction)) * phis + (Math.floor((turn - Math.floor(turn)) * phis) % phis);
    const first = terms.subarray(3 * lightTerms[vertex]!, 3 * lightTerms[vertex]! + 3);
    let sum = 0;
    for (let k = 0, degree = 0; k < this.terms; ++k) {
      if (k === termCount(degree)) ++degree;
      const at = 3 * (entry * this.terms + k);
      sum += (degree + 1) * luminance([0, 1, 2].map((band) => first[band]! * table[at + band]!)) ** 2;
    }
    return Math.sqrt(sum);
  }

  private evaluate(vertex: number, eye: readonly number[], terms: Float32Array, result: Float32Array) {
    const { lightMaterials, lightTerms, reflections, header } = this.scene;
    const direction = this.towardsEye(vertex, eye);
    if (!direction) return;
    const { x, y } = direction;
    const material = lightMaterials[vertex]!;
    const { thetas = 33, phis = 1 } = header.materials[material]!;
    const row = rowAt(direction.cosine, thetas);
    const first = 3 * lightTerms[vertex]!;
    if (phis === 1) this.isotropic(reflections[material]!, row, x, y, terms, first, result, 3 * vertex);
    else this.anisotropic(reflections[material]!, row, phis, x, y, terms, first, result, 3 * vertex);
  }

  /** The direction to the eye in the frame of the surface; null where the eye is far behind it. */
  private towardsEye(vertex: number, eye: readonly number[]): { cosine: number; x: number; y: number } | null {
    const { lightPositions, lightNormals, lightAxes } = this.scene;
    const at = 3 * vertex;
    const dx = eye[0]! - lightPositions[at]!;
    const dy = eye[1]! - lightPositions[at + 1]!;
    const dz = eye[2]! - lightPositions[at + 2]!;
    const scale = 1 / (32767 * Math.max(Math.hypot(dx, dy, dz), 1e-9));
    const nx = lightNormals[at]! / 32767;
    const ny = lightNormals[at + 1]! / 32767;
    const nz = lightNormals[at + 2]! / 32767;
    const cosine = (dx * nx + dy * ny + dz * nz) * scale * 32767;
    if (cosine < HIDDEN_COSINE) return null;
    const ax = lightAxes[at]!;
    const ay = lightAxes[at + 1]!;
    const az = lightAxes[at + 2]!;
    const x = (dx * ax + dy * ay + dz * az) * scale;
    const y = (dx * (ny * az - nz * ay) + dy * (nz * ax - nx * az) + dz * (nx * ay - ny * ax)) * scale;
    return { cosine, x, y };
  }

  private isotropic(
    table: Float32Array, row: Row, x: number, y: number,
    terms: Float32Array, first: number, result: Float32Array, at: number,
  ) {
    this.prepareAngles(x, y);
    const low = row.theta * this.terms * 3;
    const high = low + this.terms * 3;
    const f = row.fraction;
    let r = 0, g = 0, b = 0;
    for (const { m, cosine, sine } of this.pairs) {
      const c = first + 3 * cosine;
      const t = 3 * cosine;
      const cos = this.cosines[m]!;
      let tr = terms[c]! * cos, tg = terms[c + 1]! * cos, tb = terms[c + 2]! * cos;
      if (m > 0) {
        const s = first + 3 * sine;
        const sin = this.sines[m]!;
        tr += terms[s]! * sin;
        tg += terms[s + 1]! * sin;
        tb += terms[s + 2]! * sin;
      }
      r += tr * (table[low + t]! + f * (table[high + t]! - table[low + t]!));
      g += tg * (table[low + t + 1]! + f * (table[high + t + 1]! - table[low + t + 1]!));
      b += tb * (table[low + t + 2]! + f * (table[high + t + 2]! - table[low + t + 2]!));
    }
    store(result, at, r, g, b);
  }

  /** The table has the factors of a basis that is turned to the azimuth: so are the terms. */
  private anisotropic(
    table: Float32Array, row: Row, phis: number, x: number, y: number,
    terms: Float32Array, first: number, result: Float32Array, at: number,
  ) {
    this.prepareAngles(x, y);
    const turn = Math.atan2(y, x) / (2 * Math.PI);
    const column = (turn - Math.floor(turn)) * phis;
    const p = Math.min(Math.floor(column), phis - 1);
    const sum = [0, 0, 0];
    for (const [theta, weight] of [[row.theta, 1 - row.fraction], [row.theta + 1, row.fraction]] as const) {
      for (const [phi, share] of [[p, 1 - (column - p)], [(p + 1) % phis, column - p]] as const) {
        this.addTurned(table, (theta * phis + phi) * this.terms * 3, weight * share, terms, first, sum);
      }
    }
    store(result, at, sum[0]!, sum[1]!, sum[2]!);
  }

  private addTurned(
    table: Float32Array, entry: number, weight: number, terms: Float32Array, first: number, sum: number[],
  ) {
    for (const { m, cosine, sine } of this.pairs) {
      const cos = this.cosines[m]!;
      const sin = m > 0 ? this.sines[m]! : 0;
      for (let band = 0; band < 3; ++band) {
        const even = terms[first + 3 * cosine + band]!;
        const odd = m > 0 ? terms[first + 3 * sine + band]! : 0;
        sum[band]! += weight * (even * cos + odd * sin) * table[entry + 3 * cosine + band]!;
        if (m > 0) sum[band]! += weight * (odd * cos - even * sin) * table[entry + 3 * sine + band]!;
      }
    }
  }

  /** cos(m phi) and sin(m phi) of the azimuth of (x, y), by the angle's sum. */
  private prepareAngles(x: number, y: number) {
    const length = Math.hypot(x, y);
    const cos = length > 1e-12 ? x / length : 1;
    const sin = length > 1e-12 ? y / length : 0;
    this.cosines[0] = 1;
    this.sines[0] = 0;
    for (let m = 1; m < this.cosines.length; ++m) {
      this.cosines[m] = this.cosines[m - 1]! * cos - this.sines[m - 1]! * sin;
      this.sines[m] = this.sines[m - 1]! * cos + this.cosines[m - 1]! * sin;
    }
  }
}

/** The series of a positive function may swing below 0. */
function store(result: Float32Array, at: number, r: number, g: number, b: number) {
  result[at] = Math.max(r, 0);
  result[at + 1] = Math.max(g, 0);
  result[at + 2] = Math.max(b, 0);
}
