// window.stilb: the page for scripts and tests. docs/walk.md describes it; it stays as it is.

import type { Walkthrough } from "./app";
import type { Vec3 } from "./data/scene";

export interface ReadingWithError {
  value: number;
  standard_error: number;
}

export interface StilbPage {
  /** Settles once the first picture is drawn. */
  ready: Promise<void>;
  camera(position: Vec3, target: Vec3, fov?: number): void;
  luminance(x: number, y: number): ReadingWithError | null;
  illuminance(x: number, y: number): ReadingWithError | null;
  set(light: string, factor: number | Vec3): void;
  frameTime(): number;
  falsecolor(on: boolean): void;
}

declare global {
  interface Window {
    stilb: StilbPage;
  }
}

/** Of the normal distribution: half-widths of 95 % intervals in standard errors. */
const STANDARD_ERRORS = 1.959964;

export function publish(walkthrough: Promise<Walkthrough>) {
  let walk: Walkthrough | null = null;
  const started = () => {
    if (!walk) throw new Error("the page is not ready: wait for window.stilb.ready");
    return walk;
  };
  const reading = (value: { value: number; halfWidth: number } | null | undefined) =>
    value ? { value: value.value, standard_error: value.halfWidth / STANDARD_ERRORS } : null;
  window.stilb = {
    ready: walkthrough.then((ready) => {
      walk = ready;
    }),
    camera: (position, target, fov) => started().place(position, target, fov),
    luminance: (x, y) => reading(started().luminanceWithError(x, y)),
    illuminance: (x, y) => reading(started().surfaceAt(x, y)?.illuminance),
    set: (light, factor) => started().set(light, factor),
    frameTime: () => started().times.median(),
    falsecolor: (on) => started().setFalseColour(on),
  };
}
