// Luminance and illuminance under the cursor, with their 95 % half-widths.

import type { Vec3 } from "../data/scene";
import type { Hit, Space } from "../walk/space";
import * as THREE from "three";
import { kindOf } from "../materials/surface";
import type { Lighting, StoredLight } from "./lighting";
import { luminance } from "./luminance";

export interface Value {
  value: number;
  halfWidth: number;
}

export interface Reading {
  hit: Hit;
  object: string;
  material: string;
  /** What a mirror or a pane shows, where the line of sight meets one first. */
  seenBy: string | null;
  illuminance: Value | null;
}

/** Mirrors behind one another. */
const MOST_REFLECTIONS = 4;

export class Readings {
  constructor(
    private readonly lighting: Lighting,
    private readonly space: Space,
  ) {}

  /** The surface on a line of sight, seen by mirrors and through panes. */
  surfaceAt(origin: THREE.Vector3, direction: THREE.Vector3): Reading | null {
    const { scene } = this.lighting;
    let [from, along] = [origin, direction.clone().normalize()];
    let seenBy: string | null = null;
    for (let i = 0; i <= MOST_REFLECTIONS; ++i) {
      const hit = this.space.cast(from, along, THREE.FrontSide, i > 0 ? 1e-4 : 0);
      const mesh = hit && scene.meshOfTriangle(hit.triangle);
      if (!hit || !mesh) return null;
      const material = scene.materialOf(mesh);
      const kind = kindOf(material);
      const object = scene.header.objects[mesh.object]?.name ?? "";
      if (kind === "mirror") {
        seenBy ??= `in the mirror ${object}`;
        along = along.clone().reflect(hit.normal);
      } else if (kind === "pane" || kind === "glass") {
        seenBy ??= `through ${object}`;
      } else {
        return { hit, object, material: material.name, seenBy, illuminance: this.illuminanceAt(hit) };
      }
      from = hit.point;
    }
    return null;
  }

  /** Half-width of a luminance: that of the direct light in it, in proportion, and that of the stored light. */
  luminanceError(reading: Reading, measured: number): number {
    const { hit } = reading;
    const { scene, direct } = this.lighting;
    const mesh = scene.meshOfTriangle(hit.triangle)!;
    const emission = mesh.light < 0 ? 0 : this.emissionOf(mesh.light, mesh.luminance_cd_m2 ?? [0, 0, 0]);
    const stored = this.storedAt(hit);
    const lux = interpolate(hit, (vertex) => luminance(direct, 3 * vertex));
    const directError = lux > 0 ? this.directErrorAt(hit, lux) / lux : 0;
    const fromStored = Math.min(stored.luminance, measured);
    const fromDirect = Math.max(measured - fromStored - emission, 0);
    // What mirrors and panes take away is taken from the error, too.
    const share = stored.luminance > measured ? measured / stored.luminance : 1;
    return Math.hypot(fromDirect * directError, share * stored.luminanceError);
  }

  private illuminanceAt(hit: Hit): Value {
    const stored = this.storedAt(hit);
    const lux = interpolate(hit, (vertex) => luminance(this.lighting.direct, 3 * vertex));
    return { value: lux + stored.illuminance, halfWidth: Math.hypot(this.directErrorAt(hit, lux), stored.error) };
  }

  /** In proportion to the direct light that is left of that at factor 1. */
  private directErrorAt(hit: Hit, lux: number): number {
    const { scene } = this.lighting;
    const error = interpolate(hit, (vertex) => scene.directError[vertex]!);
    const whole = interpolate(hit, (vertex) => this.lighting.directAtFactorOne(vertex));
    return whole > 0 ? (error * lux) / whole : error;
  }

  private emissionOf(light: number, rgb: Vec3): number {
    const factor = this.lighting.factorOf(light);
    return luminance(rgb.map((value, b) => value * factor[b]!));
  }

  private storedAt(hit: Hit): StoredLight {
    const at = hit.vertices.map((vertex) => this.lighting.storedAt(vertex));
    const mean = (of: keyof StoredLight) =>
      at.reduce((sum, stored, k) => sum + hit.weights[k]! * stored[of], 0);
    return {
      illuminance: mean("illuminance"), error: mean("error"),
      luminance: mean("luminance"), luminanceError: mean("luminanceError"),
    };
  }
}

function interpolate(hit: Hit, of: (vertex: number) => number): number {
  return hit.vertices.reduce((sum, vertex, k) => sum + hit.weights[k]! * of(vertex), 0);
}

/** Value and half-width with as many decimals as the half-width has two digits. */
export function valueText({ value, halfWidth }: Value): string {
  const digitsOf = (x: number, digits: number) => Math.max(0, Math.min(6, digits - 1 - Math.floor(Math.log10(x))));
  if (!(halfWidth > 0)) return value > 0 ? value.toFixed(digitsOf(value, 3)) : "0";
  const decimals = digitsOf(halfWidth, 2);
  return `${value.toFixed(decimals)} ± ${halfWidth.toFixed(decimals)}`;
}
