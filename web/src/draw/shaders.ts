// Shaders of surfaces. All write luminance in linear RGB [cd/m2].

import type { Model } from "../materials/brdf";

const HEADER = /* glsl */ `
precision highp float;
precision highp int;
#define PI 3.14159265358979
`;

export const SURFACE_VERTEX = /* glsl */ `${HEADER}
uniform mat4 viewMatrix, projectionMatrix;
in vec3 position;
in vec3 glow;
out vec3 vGlow;
#ifdef SHADED
in vec3 normal;
out vec3 vPosition, vNormal;
#endif
#if SLOTS > 0
in vec4 slots0;
out vec4 vSlots0;
#endif
#if SLOTS > 4
in vec4 slots1;
out vec4 vSlots1;
#endif
#if SLOTS > 8
in vec4 slots2;
out vec4 vSlots2;
#endif
#if SLOTS > 12
in vec4 slots3;
out vec4 vSlots3;
#endif
// The depth pass and the shading pass must agree to the last bit.
invariant gl_Position;
void main() {
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1.0));
  vGlow = glow;
#ifdef SHADED
  vPosition = position;
  vNormal = normal;
#endif
#if SLOTS > 0
  vSlots0 = slots0;
#endif
#if SLOTS > 4
  vSlots1 = slots1;
#endif
#if SLOTS > 8
  vSlots2 = slots2;
#endif
#if SLOTS > 12
  vSlots3 = slots3;
#endif
}`;

export const DEPTH_FRAGMENT = /* glsl */ `${HEADER}
void main() {}`;

export const DIFFUSE_FRAGMENT = /* glsl */ `${HEADER}
uniform vec3 uEmission;
in vec3 vGlow;
layout(location = 0) out vec4 luminance;
void main() { luminance = vec4(vGlow + uEmission, 1.0); }`;

/** The mean of the BRDF over the points of each lamp, times its illuminance. */
export function glossyFragment(model: Model): string {
  return /* glsl */ `${HEADER}
uniform vec3 uEmission, uEye;
uniform highp sampler2D uLamps;
uniform ivec2 uPoints[SLOTS];   // first, count
uniform vec3 uColours[SLOTS];
uniform vec3 uMiddles[SLOTS];
in vec3 vGlow, vPosition, vNormal;
#if SLOTS > 0
in vec4 vSlots0;
#endif
#if SLOTS > 4
in vec4 vSlots1;
#endif
#if SLOTS > 8
in vec4 vSlots2;
#endif
#if SLOTS > 12
in vec4 vSlots3;
#endif
layout(location = 0) out vec4 luminance;
${model.glsl}
vec3 meanLobe(ivec2 points) {
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = points.x; i < points.x + points.y; ++i) {
    ivec2 at = ivec2(2 * (i % 256), i / 256);
    vec4 lamp = texelFetch(uLamps, at, 0);
    vec3 apart = lamp.xyz - vPosition;
    float inverse = inversesqrt(dot(apart, apart));
    vec3 L = apart * inverse;
    float weight = lamp.w * dot(N, L) * inverse * inverse;
    if (points.y > 1) {
      vec3 front = texelFetch(uLamps, at + ivec2(1, 0), 0).xyz;
      if (front != vec3(0.0)) weight *= max(-dot(front, L), 0.0);
    }
    if (weight <= 0.0) continue;
    total += weight;
    sum += weight * lobe(L);
  }
  return total > 0.0 ? sum / total : vec3(0.0);
}
vec3 reflectedFrom(int slot, float illuminance) {
  if (illuminance <= 0.0) return vec3(0.0);
  vec3 L = normalize(uMiddles[slot] - vPosition);
  L += N * max(1e-3 - dot(N, L), 0.0);
  return illuminance * uColours[slot] * (smoothPart(L) + meanLobe(uPoints[slot]));
}
float slotAt(int slot) {
#if SLOTS > 12
  if (slot >= 12) return vSlots3[slot - 12];
#endif
#if SLOTS > 8
  if (slot >= 8) return vSlots2[slot - 8];
#endif
#if SLOTS > 4
  if (slot >= 4) return vSlots1[slot - 4];
#endif
  return vSlots0[slot];
}
void main() {
  vec3 normal = normalize(vNormal);
  vec3 view = normalize(uEye - vPosition);
  // At outlines of coarse meshes the shading normal leans away: mirrored to its front, as the program does.
  float facing = dot(normal, view);
  if (facing < 0.0) view -= 2.0 * facing * normal;
  if (abs(facing) < 1e-3) view = normalize(view + normal * 1e-3);
  prepareBrdf(normal, view);
  vec3 sum = vGlow + uEmission;
  for (int slot = 0; slot < SLOTS; ++slot) sum += reflectedFrom(slot, slotAt(slot));
  luminance = vec4(sum, 1.0);
}`;
}

/** What a direction shows in a probe: the direction's point on the box of the scene, seen from the probe. */
const PROBE = /* glsl */ `
uniform highp samplerCube uProbe;
uniform vec3 uProbePosition, uLow, uHigh;
vec3 probeTowards(vec3 from, vec3 direction) {
  vec3 safe = direction + vec3(lessThan(abs(direction), vec3(1e-6))) * 1e-6;
  vec3 walls = max((uLow - from) / safe, (uHigh - from) / safe);
  float reach = max(min(walls.x, min(walls.y, walls.z)), 0.0);
  return textureLod(uProbe, from + reach * direction - uProbePosition, 0.0).rgb;
}
`;

const MIRRORED = /* glsl */ `
uniform bool uPlanar;
uniform mat4 uMirrorMatrix;
uniform highp sampler2D uMirrored;
${PROBE}
vec3 mirroredLight(vec3 from, vec3 direction) {
  if (!uPlanar) return probeTowards(from, direction);
  vec4 place = uMirrorMatrix * vec4(from, 1.0);
  return textureLod(uMirrored, 0.5 + 0.5 * place.xy / place.w, 0.0).rgb;
}
`;

export const MIRROR_FRAGMENT = /* glsl */ `${HEADER}
uniform vec3 uEye, uReflectance, uEmission;
in vec3 vPosition, vNormal;
layout(location = 0) out vec4 luminance;
${MIRRORED}
void main() {
  vec3 normal = normalize(vNormal);
  vec3 view = normalize(vPosition - uEye);
  luminance = vec4(uReflectance * mirroredLight(vPosition, reflect(view, normal)) + uEmission, 1.0);
}`;

/** Each polarisation with all its inter-reflections, as ThinDielectric::shares(). */
const PANE_SHARES = /* glsl */ `
uniform float uIor;
uniform vec3 uInternal;
void ofOnePolarisation(float face, vec3 inside, inout vec3 reflectance, inout vec3 transmittance) {
  vec3 through = (1.0 - face) * (1.0 - face) * inside / max(1.0 - face * face * inside * inside, 1e-9);
  transmittance += 0.5 * through;
  reflectance += 0.5 * (face + face * inside * through);
}
vec2 faceShares(float cosine) {
  float refracted = sqrt(max(0.0, 1.0 - (1.0 - cosine) * (1.0 + cosine) / (uIor * uIor)));
  float across = (cosine - uIor * refracted) / (cosine + uIor * refracted);
  float along = (uIor * cosine - refracted) / (uIor * cosine + refracted);
  return vec2(across * across, along * along);
}
void sheetShares(float cosine, out vec3 reflectance, out vec3 transmittance) {
  reflectance = transmittance = vec3(0.0);
  float refracted = sqrt(max(1e-9, 1.0 - (1.0 - cosine) * (1.0 + cosine) / (uIor * uIor)));
  vec3 inside = pow(uInternal, vec3(1.0 / refracted));
  vec2 face = faceShares(cosine);
  ofOnePolarisation(face.x, inside, reflectance, transmittance);
  ofOnePolarisation(face.y, inside, reflectance, transmittance);
}
`;

/** Multiplies what is behind a pane or a glass body by its transmittance. */
export const TRANSMITTED_FRAGMENT = /* glsl */ `${HEADER}
uniform vec3 uEye;
in vec3 vPosition, vNormal;
layout(location = 0) out vec4 share;
${PANE_SHARES}
void main() {
  vec3 reflectance, transmittance;
  float cosine = clamp(abs(dot(normalize(vNormal), normalize(uEye - vPosition))), 1e-3, 1.0);
  sheetShares(cosine, reflectance, transmittance);
  share = vec4(transmittance, 1.0);
}`;

/** Adds what a pane or a glass body mirrors. */
export const REFLECTED_FRAGMENT = /* glsl */ `${HEADER}
uniform vec3 uEye;
in vec3 vPosition, vNormal;
layout(location = 0) out vec4 luminance;
${PANE_SHARES}
${MIRRORED}
void main() {
  vec3 normal = normalize(vNormal);
  vec3 view = normalize(vPosition - uEye);
  float cosine = clamp(abs(dot(normal, view)), 1e-3, 1.0);
  vec3 reflectance, transmittance;
#ifdef BODY
  vec2 face = faceShares(cosine);
  reflectance = vec3(0.5 * (face.x + face.y));
#else
  sheetShares(cosine, reflectance, transmittance);
#endif
  luminance = vec4(reflectance * mirroredLight(vPosition, reflect(view, normal)), 0.0);
}`;
