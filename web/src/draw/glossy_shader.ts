// The shader of glossy surfaces: for each lamp, its illuminance times the mean of the BRDF over its points.

import type { Model } from "../materials/brdf";
import { HEADER } from "./shaders";

/** More points run in a loop: constant indices are faster, but long shaders take long to compile. */
const MOST_UNROLLED = 4;

/** `counts`: points of the lamp in each slot. */
export function glossyFragment(model: Model, counts: number[]): string {
  const firsts = counts.map((_, slot) => counts.slice(0, slot).reduce((sum, count) => sum + count, 0));
  return /* glsl */ `${HEADER}
uniform vec3 uEmission, uEye;
uniform vec4 uLamps[${total(counts)}];    // position, weight
uniform vec3 uFronts[${total(counts)}];   // normal, or 0 where a point shines to all sides
uniform vec3 uColours[${counts.length}];
uniform vec3 uMiddles[${counts.length}];
in vec3 vGlow, vPosition, vNormal;
${varyings(counts.length)}
layout(location = 0) out vec4 luminance;
${model.glsl}
// Without branches, which cost more than they save where graphics are drawn in software.
void addPoint(vec4 lamp, vec3 front, inout vec3 sum, inout float total) {
  vec3 apart = lamp.xyz - vPosition;
  float inverse = inversesqrt(dot(apart, apart));
  vec3 L = apart * inverse;
  float cosLamp = max(-dot(front, L), 1.0 - dot(front, front));
  float weight = lamp.w * max(dot(N, L), 0.0) * max(cosLamp, 0.0) * inverse * inverse;
  total += weight;
  sum += weight * lobe(L);
}
void main() {
  N = normalize(vNormal);
  vec3 view = normalize(uEye - vPosition);
  // At outlines of coarse meshes the shading normal leans away: mirrored to its front, as the program does.
  float facing = dot(N, view);
  if (facing < 0.0) view -= 2.0 * facing * N;
  if (abs(facing) < 1e-3) view = normalize(view + N * 1e-3);
  prepareBrdf(view);
  vec3 reflected = vGlow + uEmission;
  vec3 L, brdf, sum;
  vec3 apart;
  float total;
${counts.map((count, slot) => slotCode(slot, firsts[slot]!, count)).join("")}
  luminance = vec4(reflected, 1.0);
}`;
}

function total(counts: number[]): number {
  return counts.reduce((sum, count) => sum + count, 0);
}

function varyings(slots: number): string {
  return Array.from({ length: Math.ceil(slots / 4) }, (_, i) => `in vec4 vSlots${i};`).join("\n");
}

function slotCode(slot: number, first: number, count: number): string {
  return `
  apart = uMiddles[${slot}] - vPosition;
  L = apart * inversesqrt(dot(apart, apart));
  brdf = smoothPart(normalize(L + N * max(1e-3 - dot(N, L), 0.0)));
${count === 1 ? POINT_CODE : lampCode(first, count)}
  reflected += max(vSlots${Math.floor(slot / 4)}[${slot % 4}], 0.0) * uColours[${slot}] * brdf;`;
}

const POINT_CODE = `  brdf += step(0.0, dot(N, L)) * lobe(L);`;

function lampCode(first: number, count: number): string {
  const add = (i: string | number) => `addPoint(uLamps[${i}], uFronts[${i}], sum, total);`;
  const unrolled = Array.from({ length: count }, (_, i) => `  ${add(first + i)}`).join("\n");
  const loop = `  for (int i = ${first}; i < ${first + count}; ++i) ${add("i")}`;
  return `  sum = vec3(0.0);
  total = 0.0;
${count <= MOST_UNROLLED ? unrolled : loop}
  brdf += sum / max(total, 1e-20);`;
}
