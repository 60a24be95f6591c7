// The reflection models in GLSL, as in docs/materials.md, and their parameters.
//
// A model defines, for unit vectors in world coordinates (N normal, V to the eye, L to the light):
//   prepareBrdf(V)      once a pixel
//   lobe(L)             [1/sr], for every point of a light
//   smoothPart(L)       [1/sr], for the middle of a light: varies slowly with direction

import type { CosineTable, MaterialEntry } from "../data/scene";
import { rgbOf } from "./surface";

export interface Model {
  name: string;
  glsl: string;
  parameters: Record<string, number | number[]>;
  table: CosineTable | null;
}

const COMMON = /* glsl */ `
vec3 N, V;
float cosV;
`;

/** By 1 - cos, from a difference: the cosine itself loses digits that a large exponent needs. */
const PHONG = /* glsl */ `${COMMON}
uniform vec3 uDiffuse, uSpecular;
uniform float uExponent;
vec3 mirroredV;
void prepareBrdf(vec3 view) {
  V = view; cosV = dot(N, V);
  mirroredV = normalize(2.0 * cosV * N - V);
}
float power(float below) {
#ifdef SHARP
  below = min(below, 0.3);
  return exp(-uExponent * below * (1.0 + below * (0.5 + below * (1.0 / 3.0 + 0.25 * below))));
#else
  return exp2(uExponent * log2(max(1.0 - below, 1e-9)));
#endif
}
vec3 lobe(vec3 L) {
  vec3 apart = L - mirroredV;
  return uSpecular * ((uExponent + 2.0) / (2.0 * PI) * power(0.5 * dot(apart, apart)));
}
vec3 smoothPart(vec3 L) { return uDiffuse / PI; }
`;

const WARD = /* glsl */ `${COMMON}
uniform vec3 uDiffuse, uSpecular;
uniform vec2 uRoughness, uTurn;
vec3 U, W;
void prepareBrdf(vec3 view) {
  V = view; cosV = dot(N, V);
  float horizontal = length(N.xy);
  vec3 u = horizontal > 1e-5 ? vec3(-N.y, N.x, 0.0) / horizontal : normalize(vec3(1.0, 0.0, 0.0) - N.x * N);
  vec3 v = cross(N, u);
  U = (uTurn.x * u + uTurn.y * v) / uRoughness.x;
  W = (uTurn.x * v - uTurn.y * u) / uRoughness.y;
}
vec3 lobe(vec3 L) {
  vec3 h = L + V;
  float z2 = max(dot(h, N) * dot(h, N), 1e-9);
  float u = dot(h, U), v = dot(h, W);
  float power = (u * u + v * v) / z2;
  return uSpecular * (exp(-power) * dot(h, h) / (z2 * z2) / (PI * uRoughness.x * uRoughness.y));
}
vec3 smoothPart(vec3 L) { return uDiffuse / PI; }
`;

const FACETS = /* glsl */ `${COMMON}
uniform float uAlpha, uCellsPerLog, uAverage;
uniform highp sampler2D uTable;
float stretchedV, throughV;
float stretched(float cosine) { return sqrt(cosine * cosine + uAlpha * uAlpha * (1.0 - cosine * cosine)); }
float tableAt(float cosine) {
  float position = clamp(log(1.0 + cosine / uAlpha) * uCellsPerLog, 0.0, 127.9999);
  int cell = int(position);
  float low = texelFetch(uTable, ivec2(cell, 0), 0).r, high = texelFetch(uTable, ivec2(cell + 1, 0), 0).r;
  return mix(low, high, position - float(cell));
}
void prepareBrdf(vec3 view) {
  V = view; cosV = dot(N, V);
  stretchedV = stretched(cosV);
  throughV = tableAt(cosV);
}
float facets(float cosL, vec3 h, float cosH) {
  vec3 aside = h - cosH * N;
  float spread = dot(aside, aside) / (uAlpha * uAlpha) + cosH * cosH;
  float density = 1.0 / (PI * uAlpha * uAlpha * spread * spread);
  cosL = max(cosL, 0.0);
  return density / (2.0 * (cosV * stretched(cosL) + cosL * stretchedV));
}
`;

const ROUGH = /* glsl */ `${FACETS}
uniform vec3 uReflectance, uMultiple;
vec3 lobe(vec3 L) {
  vec3 h = normalize(L + V);
  return uReflectance * facets(dot(N, L), h, dot(N, h));
}
vec3 smoothPart(vec3 L) {
  return uAverage > 0.0 ? uMultiple * (tableAt(dot(N, L)) * throughV / (PI * uAverage)) : vec3(0.0);
}
`;

const PLASTIC = /* glsl */ `${FACETS}
uniform vec3 uBase;
uniform float uIor;
float fresnel(float cosine) {
  if (uIor == 1.0) return 0.0;
  float refracted = sqrt(max(0.0, 1.0 - (1.0 - cosine) * (1.0 + cosine) / (uIor * uIor)));
  float across = (cosine - uIor * refracted) / (cosine + uIor * refracted);
  float along = (uIor * cosine - refracted) / (uIor * cosine + refracted);
  return 0.5 * (across * across + along * along);
}
vec3 lobe(vec3 L) {
  vec3 h = normalize(L + V);
  return vec3(fresnel(dot(L, h)) * facets(dot(N, L), h, dot(N, h)));
}
vec3 smoothPart(vec3 L) { return uBase * (tableAt(dot(N, L)) * throughV / (PI * uAverage)); }
`;

/** From here on, the power goes by a series, which ends at 1 - cos = 0.3: less than 1e-30 is left there. */
const SHARP_EXPONENT = 200;

type Parameters = Omit<Model, "name" | "table">;

const MODELS: Record<string, (material: MaterialEntry, table: CosineTable) => Parameters> = {
  phong: (material) => {
    const { exponent = 1 } = material;
    const glsl = exponent > SHARP_EXPONENT ? `#define SHARP\n${PHONG}` : PHONG;
    return { glsl, parameters: { ...shares(material), uExponent: exponent } };
  },
  ward: (material) => {
    const angle = ((material.rotation ?? 0) * Math.PI) / 180;
    const uTurn = [Math.cos(angle), Math.sin(angle)];
    const { roughness = 0.1 } = material;
    const uRoughness = Array.isArray(roughness) ? roughness : [roughness, roughness];
    return { glsl: WARD, parameters: { ...shares(material), uRoughness, uTurn } };
  },
  rough: (material, table) => {
    const uReflectance = rgbOf(material.reflectance);
    const lost = table.average;
    const uMultiple = uReflectance.map((r) => (r * r * (1 - lost)) / (1 - r * lost));
    return { glsl: ROUGH, parameters: { ...facetParameters(material, table), uReflectance, uMultiple } };
  },
  plastic: (material, table) => {
    const uIor = material.ior ?? 1.5;
    const within = 1 - table.average / (uIor * uIor);
    const uBase = rgbOf(material.diffuse).map((share) => (share * (1 - within)) / (1 - share * within));
    return { glsl: PLASTIC, parameters: { ...facetParameters(material, table), uIor, uBase } };
  },
};

/** `table`: that of its facets, if it has any. */
export function modelOf(material: MaterialEntry, table: CosineTable | null): Model {
  return { name: material.type, table, ...MODELS[material.type]!(material, table!) };
}

function shares(material: MaterialEntry) {
  return { uDiffuse: rgbOf(material.diffuse), uSpecular: rgbOf(material.specular) };
}

function alphaOf(material: MaterialEntry): number {
  const { roughness = 0.1 } = material;
  return Array.isArray(roughness) ? roughness[0] : roughness;
}

function facetParameters(material: MaterialEntry, table: CosineTable) {
  return { uAlpha: alphaOf(material), uCellsPerLog: table.cellsPerLog, uAverage: table.average };
}
