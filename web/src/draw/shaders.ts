// Shaders of surfaces. All write luminance in linear RGB [cd/m2].

export const HEADER = /* glsl */ `
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
// Panes and glass are drawn over the same triangles again, and must agree to the last bit.
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

export const DIFFUSE_FRAGMENT = /* glsl */ `${HEADER}
uniform vec3 uEmission;
in vec3 vGlow;
layout(location = 0) out vec4 luminance;
void main() { luminance = vec4(vGlow + uEmission, 1.0); }`;

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
