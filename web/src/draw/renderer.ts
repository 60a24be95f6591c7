// Draws a scene's luminances into a float picture, and the picture to the screen.

import * as THREE from "three";

import { Mirrors } from "./mirrors";
import { PictureStatistics } from "./picture_statistics";
import type { Surfaces } from "./surfaces";
import { copyPass, type Display, ToneMapping } from "./tone";

/** Pictures that are averaged while the view stands still. */
export const SAMPLES = 16;
/** After the last of these, 2 % of the difference to the former light are left. */
const FADING_SAMPLES = 12;
const FADING_SHARE = 0.28;

export class Renderer {
  readonly camera = new THREE.PerspectiveCamera(60, 1, 0.03, 1000);
  private readonly gl: THREE.WebGLRenderer;
  private readonly frame: THREE.WebGLRenderTarget;
  private readonly sum: THREE.WebGLRenderTarget;
  private readonly mirrors: Mirrors;
  private readonly tone: ToneMapping;
  private readonly statistics = new PictureStatistics();
  private readonly average = copyPass();
  private readonly floatType: THREE.TextureDataType;
  private width = 1;
  private height = 1;
  /** Of the picture in `frame`: its size as a share of the canvas, and whether it is unjittered. */
  private frameScale = 0;
  private frameIsCentred = false;
  private samples = 0;
  private isStale = true;
  /** Whether the averaged picture shows something else, so that the average begins anew. */
  private mustRestart = true;
  /** Samples that are left of the change from one average to the next. */
  private fading = 0;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly surfaces: Surfaces,
    extent: number,
  ) {
    this.gl = newRenderer(canvas);
    this.tone = new ToneMapping(surfaces.scene.header.false_colours);
    this.camera.far = Math.max(100, 4 * extent);
    this.floatType = bestFloatType(this.gl);
    this.frame = pictureTarget(this.floatType, true);
    this.sum = pictureTarget(this.floatType, false);
    this.mirrors = new Mirrors(this.gl, surfaces, this.floatType);
    this.gl.setOpaqueSort((a, b) => this.reach(a.object) - this.reach(b.object));
    const blending = this.average.material;
    blending.transparent = true;
    blending.blending = THREE.CustomBlending;
    blending.blendSrc = THREE.ConstantAlphaFactor;
    blending.blendDst = THREE.OneMinusConstantAlphaFactor;
  }

  resize(width: number, height: number, ratio: number) {
    this.width = Math.max(1, Math.round(width * ratio));
    this.height = Math.max(1, Math.round(height * ratio));
    this.sum.setSize(this.width, this.height);
    this.viewChanged();
  }

  /** The screen's pixels that the canvas covers. */
  get size(): [number, number] {
    return [this.width, this.height];
  }

  /** Gradually: refined light fades in, so that the picture does not lose its smooth edges again and again. */
  lightChanged(gradually: boolean) {
    this.surfaces.refreshLight();
    this.mirrors.invalidate();
    this.isStale = true;
    if (!gradually) this.mustRestart = true;
    else this.fading = FADING_SAMPLES;
  }

  viewChanged() {
    this.isStale = true;
    this.mustRestart = true;
  }

  /** Whether drawing again would make the picture better. */
  get canImprove(): boolean {
    const isSmooth = this.samples >= SAMPLES && this.fading === 0;
    return this.isStale || this.frameScale < 1 || !isSmooth || this.mirrors.hasStaleProbe;
  }

  get isCurrent(): boolean {
    return !this.isStale;
  }

  /** One picture of a view that moves, at a share of the resolution, and with fewer triangles. */
  drawMoving(scale: number, isCoarse: boolean) {
    this.surfaces.showCoarse(isCoarse);
    if (this.mirrors.exist) this.mirrors.refreshProbes(false);
    this.drawFrame(scale, [0, 0], false);
    this.mustRestart = true;
  }

  /** One more sample of a view that stands still; the first one is exact at the pixels' middles. */
  drawStill() {
    this.surfaces.showCoarse(false);
    this.mirrors.refreshProbes(true);
    if (this.mustRestart || this.frameScale < 1) {
      this.samples = 0;
      this.fading = 0;
    }
    this.mustRestart = false;
    this.drawFrame(1, sampleOffset(this.samples + this.fading), true);
    this.accumulate();
  }

  /** The canvas gets the picture's resolution: the browser enlarges it, which is faster than doing so here. */
  show(display: Display) {
    const picture = this.isAveraged ? this.sum : this.frame;
    const { width, height } = picture;
    if (this.canvas.width !== width || this.canvas.height !== height) this.gl.setSize(width, height, false);
    this.tone.draw(this.gl, picture, display);
  }

  /** Waits until the graphics card has drawn everything. */
  finish() {
    const gl = this.gl.getContext();
    this.gl.setRenderTarget(null);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Luminances of the picture's pixels in ascending order, for exposure and scales. */
  luminances(): Float32Array {
    return this.statistics.luminances(this.gl, this.frame.texture);
  }

  /** rgb [cd/m2] at a pixel of the canvas, from its upper left; of its middle, or averaged over it. */
  pixel(x: number, y: number, centred: boolean): Float32Array {
    const isSharp = !this.isStale && this.frameScale === 1 && !this.mirrors.hasStaleProbe;
    if (!isSharp || (centred && !this.frameIsCentred)) {
      this.mustRestart = true;
      this.drawStill();
    }
    const target = centred || !this.isAveraged ? this.frame : this.sum;
    const texel = new Float32Array(4);
    this.gl.readRenderTargetPixels(target, x, this.height - 1 - y, 1, 1, texel);
    return texel;
  }

  private get isAveraged(): boolean {
    return this.samples > 1 && !this.mustRestart && this.frameScale === 1;
  }

  private drawFrame(scale: number, offset: readonly [number, number], finest: boolean) {
    const width = Math.max(1, Math.round(this.width * scale));
    const height = Math.max(1, Math.round(this.height * scale));
    if (this.frame.width !== width || this.frame.height !== height) this.frame.setSize(width, height);
    this.prepareCamera(offset, width, height);
    if (this.mirrors.exist) this.mirrors.refreshPlanes(this.camera, width, height, finest);
    this.surfaces.lookFrom(this.camera.position, finest);
    this.gl.setRenderTarget(this.frame);
    this.gl.clear();
    this.gl.render(this.surfaces.opaque, this.camera);
    this.mirrors.drawOver(this.camera);
    this.frameScale = scale;
    this.frameIsCentred = offset[0] === 0 && offset[1] === 0;
    this.isStale = false;
  }

  private prepareCamera([x, y]: readonly [number, number], width: number, height: number) {
    this.camera.aspect = this.width / this.height;
    this.camera.updateProjectionMatrix();
    this.camera.projectionMatrix.elements[8]! -= (2 * x) / width;
    this.camera.projectionMatrix.elements[9]! -= (2 * y) / height;
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    this.camera.updateMatrixWorld(true);
  }

  /** Near things first, and the room that is around them last: what they hide is not shaded. */
  private reach(object: THREE.Object3D): number {
    const sphere = (object as THREE.Mesh).geometry.boundingSphere;
    return sphere ? sphere.center.distanceTo(this.camera.position) + sphere.radius : 0;
  }

  private accumulate() {
    if (this.fading > 0) --this.fading;
    else this.samples = Math.min(this.samples + 1, SAMPLES);
    const share = this.fading > 0 ? FADING_SHARE : 1 / this.samples;
    const { material } = this.average;
    material.uniforms.uPicture!.value = this.frame.texture;
    material.blendAlpha = share;
    this.average.draw(this.gl, this.sum);
  }
}

function newRenderer(canvas: HTMLCanvasElement): THREE.WebGLRenderer {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: false, depth: false });
  renderer.autoClear = false;
  renderer.sortObjects = true;
  renderer.setClearColor(0, 0);
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  return renderer;
}

/** Panes and averages blend, which not all cards can do with 32 bits. */
function bestFloatType(renderer: THREE.WebGLRenderer): THREE.TextureDataType {
  const { extensions } = renderer;
  if (!extensions.has("EXT_color_buffer_float")) {
    throw new Error("this browser's WebGL2 cannot draw into float pictures (EXT_color_buffer_float)");
  }
  return extensions.has("EXT_float_blend") && extensions.has("OES_texture_float_linear")
    ? THREE.FloatType
    : THREE.HalfFloatType;
}

function pictureTarget(type: THREE.TextureDataType, depthBuffer: boolean): THREE.WebGLRenderTarget {
  return new THREE.WebGLRenderTarget(1, 1, {
    type,
    depthBuffer,
    minFilter: THREE.LinearFilter,
    magFilter: THREE.LinearFilter,
    generateMipmaps: false,
  });
}

/** Offsets within a pixel, the first 0: the R2 sequence [Roberts 2018]. */
function sampleOffset(index: number): [number, number] {
  if (index === 0) return [0, 0];
  const at = (step: number) => ((0.5 + step * index) % 1) - 0.5;
  return [at(0.7548776662466927), at(0.5698402909980532)];
}
