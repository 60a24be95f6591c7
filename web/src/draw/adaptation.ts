// The exposure: by hand, or by an eye that adapts to the picture.

import { automaticExposure } from "./picture_statistics";

/** Of the change that is left, in a second: an e-th each 0.25 s. */
const SPEED = 4;
/** ms between looks at the picture, which the graphics card has to send back. */
const INTERVAL = 200;
/** Relative differences that nobody sees. */
const UNSEEN = 0.004;

export class Adaptation {
  automatic = true;
  /** Stops by which the picture is made brighter than its automatic exposure. */
  compensation = 0;
  /** Per cd/m2, by hand. */
  manual = 0.01;
  private wanted = 0;
  private current = 0;
  private lastLook = -Infinity;
  private lastTime = 0;

  get isUnderWay(): boolean {
    return this.automatic && this.current > 0 && Math.abs(this.current / this.target - 1) > UNSEEN;
  }

  /** The exposure of the next picture [1 / (cd/m2)]. */
  exposure(luminances: () => Float32Array, pictureIsNew: boolean): number {
    if (!this.automatic) {
      this.current = this.manual;
      return this.manual;
    }
    const now = performance.now();
    if ((pictureIsNew && now - this.lastLook > INTERVAL) || this.wanted === 0) {
      this.wanted = automaticExposure(luminances());
      this.lastLook = now;
    }
    const seconds = Math.min((now - this.lastTime) / 1000, 0.1);
    this.lastTime = now;
    if (this.current === 0) this.current = this.target;
    else this.current *= (this.target / this.current) ** (1 - Math.exp(-SPEED * seconds));
    return this.current;
  }

  private get target(): number {
    return this.wanted * 2 ** this.compensation;
  }
}
