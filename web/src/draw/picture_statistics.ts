// Luminances of a grid of pixels: what exposure and scales are chosen from.

import * as THREE from "three";

import { scaledPass } from "./tone";

const SIDE = 96;

export class PictureStatistics {
  private readonly pass = scaledPass();
  private readonly target = new THREE.WebGLRenderTarget(SIDE, SIDE, {
    type: THREE.FloatType,
    depthBuffer: false,
    minFilter: THREE.NearestFilter,
    magFilter: THREE.NearestFilter,
  });
  private readonly texels = new Float32Array(4 * SIDE * SIDE);

  /** Luminances above 0, in ascending order. */
  luminances(renderer: THREE.WebGLRenderer, picture: THREE.Texture): Float32Array {
    this.pass.material.uniforms.uPicture!.value = picture;
    this.pass.material.uniforms.uPixel!.value.set(1 / SIDE, 1 / SIDE);
    this.pass.draw(renderer, this.target);
    renderer.readRenderTargetPixels(this.target, 0, 0, SIDE, SIDE, this.texels);
    const values: number[] = [];
    for (let i = 0; i < this.texels.length; i += 4) {
      const value = 0.2126 * this.texels[i]! + 0.7152 * this.texels[i + 1]! + 0.0722 * this.texels[i + 2]!;
      if (value > 0 && Number.isFinite(value)) values.push(value);
    }
    return Float32Array.from(values).sort();
  }
}

/**
 * The program's own rule: nine tenths of the pixels are no brighter than 0.65, but the median lies between 0.12 and 0.36;
 * and nine tenths are no brighter than 4.
 */
export function automaticExposure(luminances: Float32Array): number {
  if (luminances.length === 0) return 1;
  const at = (share: number) => luminances[Math.floor(share * (luminances.length - 1))]!;
  const median = at(0.5), bright = at(0.9);
  return Math.min(Math.max(0.65 / bright, 0.12 / median), 0.36 / median, 4 / bright);
}

/** The range of luminances without the lamps' tail. */
export function typicalRange(luminances: Float32Array): [number, number] {
  if (luminances.length === 0) return [0, 1];
  const at = (share: number) => luminances[Math.floor(share * (luminances.length - 1))]!;
  return [at(0.005), at(0.985)];
}
