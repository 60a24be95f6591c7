// From luminances to the screen: exposure and a tone curve, or false colours with isolines.

import * as THREE from "three";

import type { Rgb } from "../data/scene";
import { fractionOf, type Scale, ticksOf } from "./scale";

export const CURVES = ["reinhard", "aces", "linear"] as const;
export type Curve = (typeof CURVES)[number];

/** Labels beside the bar, and so isolines; as in the pictures of `stilb falsecolor`. */
export const BAR_TICKS = 9;
const MOST_LEVELS = 16;

export interface Display {
  curve: Curve;
  exposure: number;
  falseColour: boolean;
  isolines: boolean;
  scale: Scale;
}

const VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

// Where surfaces meet that are divided differently, rounding leaves single pixels that none of them covers.
const PICTURE = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler2D uPicture;
vec4 pictureAt(ivec2 pixel) {
  vec4 here = texelFetch(uPicture, pixel, 0);
  if (here.a > 0.0) return here;
  ivec2 last = textureSize(uPicture, 0) - 1;
  vec4 around = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 aside = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    around += texelFetch(uPicture, clamp(pixel + aside, ivec2(0), last), 0);
  }
  return around.a > 2.5 ? around / around.a : here;
}`;

const FRAGMENT = /* glsl */ `
${PICTURE}
uniform highp sampler2D uColours;
uniform float uExposure;
uniform int uCurve, uLevelCount;
uniform bool uIsolines, uLogarithmic;
uniform vec2 uEnds;
uniform float uSpacing;
uniform float uLevels[${MOST_LEVELS}];
layout(location = 0) out vec4 colour;

float luminanceOf(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

// sRGB's curve by roots, within 0.012 steps of 8 bits: in software, powers take longer than all else here.
vec3 encoded(vec3 linear) {
  vec3 x = clamp(linear, 0.0, 1.0);
  vec3 root = sqrt(x), fourth = sqrt(root), eighth = sqrt(fourth);
  vec3 curve = 0.64236788 * root + 0.71210786 * fourth - 0.33686885 * eighth - 0.01756386 * x;
  return mix(curve, 12.92 * x, vec3(lessThanEqual(x, vec3(0.0031308))));
}

// Mixes with grey of the same luminance until the screen can show the colour.
vec3 withinScreen(vec3 rgb, float level) {
  float least = min(rgb.r, min(rgb.g, rgb.b)), most = max(rgb.r, max(rgb.g, rgb.b));
  float share = 1.0;
  if (most > 1.0) share = min(share, (1.0 - level) / (most - level));
  if (least < 0.0) share = min(share, level / (level - least));
  return level + share * (rgb - level);
}

// Linear to 0.5, then Reinhard's global operator [Reinhard et al. 2002, eq. 4], white at 8, as in the program's PNG
// pictures.
vec3 reinhard(vec3 rgb) {
  float luminance = luminanceOf(rgb);
  if (luminance <= 0.0) return vec3(0.0);
  float excess = min(max(luminance - 0.5, 0.0) / 0.5, 15.0);
  float level = min(luminance, 0.5) + 0.5 * excess * (1.0 + excess / 225.0) / (1.0 + excess);
  return withinScreen(rgb * (level / luminance), level);
}

// [Narkowicz 2015, ACES filmic tone mapping curve]
vec3 aces(vec3 x) { return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14); }

vec3 toned(vec3 rgb) {
  if (uCurve == 0) return reinhard(rgb);
  if (uCurve == 1) return aces(rgb);
  return rgb;
}

float fractionAt(ivec2 pixel) {
  float value = luminanceOf(pictureAt(clamp(pixel, ivec2(0), textureSize(uPicture, 0) - 1)).rgb);
  if (!uLogarithmic) return (value - uEnds.x) / (uEnds.y - uEnds.x);
  return value > 0.0 ? log(value / uEnds.x) / log(uEnds.y / uEnds.x) : -1.0;
}

int levelBelow(float fraction) {
  int count = 0;
  for (int i = 0; i < uLevelCount; ++i) count += fraction >= uLevels[i] ? 1 : 0;
  return count;
}

// Where the level changes gradually: a jump by half of the distance of levels is an outline of something.
bool isLine(ivec2 pixel, float here, int reach) {
  int level = levelBelow(here);
  for (int i = 0; i < 4; ++i) {
    ivec2 aside = i < 2 ? ivec2(i == 0 ? reach : -reach, 0) : ivec2(0, i == 2 ? reach : -reach);
    float there = fractionAt(pixel + aside);
    if (there > here && there - here < 0.5 * uSpacing && levelBelow(there) > level) return true;
  }
  return false;
}

vec3 falseColour(ivec2 pixel) {
  float fraction = fractionAt(pixel);
  vec3 shown = texture(uColours, vec2((clamp(fraction, 0.0, 1.0) * 256.0 + 0.5) / 257.0, 0.5)).rgb;
  if (!uIsolines) return shown;
  if (isLine(pixel, fraction, 1)) return vec3(1.0);
  return isLine(pixel, fraction, 2) ? 0.45 * shown : shown;
}

// Breaks the bands of 8 bits [Jimenez 2014, Next generation post processing in Call of Duty].
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5; }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef FALSE_COLOUR
  colour = vec4(falseColour(pixel), 1.0);
#else
  vec3 rgb = pictureAt(pixel).rgb;
  colour = vec4(encoded(toned(rgb * uExposure)) + noise(gl_FragCoord.xy) / 255.0, 1.0);
#endif
}`;

const COPY_FRAGMENT = /* glsl */ `
${PICTURE}
layout(location = 0) out vec4 colour;
void main() { colour = pictureAt(ivec2(gl_FragCoord.xy)); }`;

const SCALED_FRAGMENT = /* glsl */ `
precision highp float;
uniform highp sampler2D uPicture;
uniform vec2 uPixel;
layout(location = 0) out vec4 colour;
void main() { colour = texture(uPicture, gl_FragCoord.xy * uPixel); }`;

/** A triangle over the whole target. */
export class FullScreen {
  readonly material: THREE.RawShaderMaterial;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();

  constructor(fragmentShader: string, uniforms: Record<string, THREE.IUniform>, defines: Record<string, number> = {}) {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: VERTEX,
      fragmentShader,
      uniforms,
      defines,
      depthTest: false,
      depthWrite: false,
    });
    const geometry = new THREE.BufferGeometry();
    const corners = new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]);
    geometry.setAttribute("position", new THREE.BufferAttribute(corners, 3));
    const mesh = new THREE.Mesh(geometry, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  draw(renderer: THREE.WebGLRenderer, target: THREE.WebGLRenderTarget | null) {
    renderer.setRenderTarget(target);
    renderer.render(this.scene, this.camera);
  }
}

/** Pixel by pixel. */
export function copyPass(): FullScreen {
  return new FullScreen(COPY_FRAGMENT, { uPicture: { value: null } });
}

/** To a target of another size. */
export function scaledPass(): FullScreen {
  return new FullScreen(SCALED_FRAGMENT, { uPicture: { value: null }, uPixel: { value: new THREE.Vector2() } });
}

export class ToneMapping {
  private readonly uniforms: Record<string, THREE.IUniform> = {
    uPicture: { value: null },
    uColours: { value: null },
    uExposure: { value: 1 },
    uCurve: { value: 0 },
    uLevelCount: { value: 0 },
    uIsolines: { value: false },
    uLogarithmic: { value: false },
    uSpacing: { value: 1 },
    uEnds: { value: new THREE.Vector2() },
    uLevels: { value: new Float32Array(MOST_LEVELS) },
  };
  private readonly colours = new FullScreen(FRAGMENT, this.uniforms);
  private readonly falseColours = new FullScreen(FRAGMENT, this.uniforms, { FALSE_COLOUR: 1 });

  constructor(falseColours: Rgb[]) {
    this.uniforms.uColours!.value = colourTexture(falseColours);
  }

  /** To the screen, pixel by pixel. */
  draw(renderer: THREE.WebGLRenderer, picture: THREE.WebGLRenderTarget, display: Display) {
    const { uniforms } = this;
    uniforms.uPicture!.value = picture.texture;
    uniforms.uExposure!.value = display.exposure;
    uniforms.uCurve!.value = CURVES.indexOf(display.curve);
    if (display.falseColour) this.prepareScale(display);
    (display.falseColour ? this.falseColours : this.colours).draw(renderer, null);
  }

  private prepareScale({ isolines, scale }: Display) {
    const { uniforms } = this;
    uniforms.uIsolines!.value = isolines;
    uniforms.uLogarithmic!.value = scale.logarithmic;
    uniforms.uEnds!.value.set(scale.low, scale.high);
    const levels = ticksOf(scale, BAR_TICKS)
      .map(({ value }) => fractionOf(scale, value))
      .filter((fraction) => fraction > 1e-6 && fraction < 1 - 1e-6)
      .slice(0, MOST_LEVELS);
    uniforms.uLevels!.value.set(levels);
    uniforms.uLevelCount!.value = levels.length;
    uniforms.uSpacing!.value = Math.min(...levels.map((level, i) => level - (levels[i - 1] ?? 0)).slice(1), 1);
  }
}

function colourTexture(colours: Rgb[]): THREE.DataTexture {
  const bytes = Uint8Array.from(colours.flatMap(([r, g, b]) => [r, g, b, 255]));
  const texture = new THREE.DataTexture(bytes, colours.length, 1, THREE.RGBAFormat);
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
