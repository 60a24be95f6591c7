// The walk-through: data, picture and motion together. The user interface and window.stilb call it.

import * as THREE from "three";

import type { Container } from "./data/container";
import { type LightHeader, type Rgb, Scene, type SceneHeader, type Vec3 } from "./data/scene";
import { Adaptation } from "./draw/adaptation";
import { FrameTimes } from "./draw/frame_times";
import { typicalRange } from "./draw/picture_statistics";
import { Renderer } from "./draw/renderer";
import { niceScale } from "./draw/scale";
import { Surfaces } from "./draw/surfaces";
import type { Display } from "./draw/tone";
import { Highlights } from "./light/highlights";
import { LampPoints } from "./light/lamp_points";
import { Lighting } from "./light/lighting";
import { luminance } from "./light/luminance";
import { type Reading, Readings, type Value } from "./light/readings";
import { Input } from "./walk/input";
import { Space } from "./walk/space";
import { EYE_HEIGHT, View } from "./walk/view";
import { Walker } from "./walk/walker";

/** Beyond this density of a screen, more pixels cost more than they show. */
const MOST_PIXEL_RATIO = 1.5;
const LONGEST_STEP = 0.1;

export type Mode = "walk" | "orbit";

export interface Probe extends Reading {
  luminance: Value;
}

export class Walkthrough extends EventTarget {
  readonly scene: Scene;
  readonly lighting: Lighting;
  readonly space: Space;
  readonly view = new View();
  readonly input: Input;
  readonly display: Display = {
    curve: "reinhard",
    exposure: 1,
    falseColour: false,
    isolines: false,
    scale: { logarithmic: false, low: 0, high: 100 },
  };
  readonly adaptation = new Adaptation();
  readonly times: FrameTimes;
  mode: Mode = "walk";
  private readonly renderer: Renderer;
  private readonly readings: Readings;
  private readonly walker: Walker;
  private ratio = 1;
  private isScheduled = false;
  private viewIsNew = true;
  private displayIsNew = true;
  private isWalking = false;
  private lastTick = 0;

  constructor(container: Container<SceneHeader>, readonly canvas: HTMLCanvasElement) {
    super();
    this.scene = new Scene(container);
    this.times = new FrameTimes(this.scene.coarseTriangles !== null);
    const highlights = new Highlights(this.scene);
    this.lighting = new Lighting(this.scene, highlights);
    this.space = new Space(this.scene);
    const surfaces = new Surfaces(this.scene, this.lighting, highlights, new LampPoints(this.scene));
    this.renderer = new Renderer(canvas, surfaces, this.space.diagonal);
    this.readings = new Readings(this.lighting, this.space);
    this.walker = new Walker(this.space, this.view);
    this.input = new Input(canvas, {
      look: (dx, dy) => this.look(dx, dy),
      pan: (dx, dy) => this.pan(dx, dy),
      zoom: (factor) => this.zoom(factor),
      click: (x, y) => this.tell("pick", { x, y }),
      hover: (x, y) => this.tell("hover", { x, y }),
      leave: () => this.tell("hover", null),
      wake: () => this.wake(),
    });
    this.placeAtStart();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  receiveLight(container: Container<LightHeader>) {
    const isFirst = this.lighting.header === null;
    this.lighting.receive(container);
    this.renderer.lightChanged(!isFirst);
    this.schedule();
    this.tell("light");
  }

  set(name: string, factor: number | readonly number[]) {
    this.lighting.set(name, factor);
    this.renderer.lightChanged(false);
    this.schedule();
    this.tell("factors");
  }

  place(position: Vec3, target: Vec3, fov?: number, up?: Vec3) {
    this.view.place(position, target, fov, up);
    this.viewMoved();
  }

  setFieldOfView(degrees: number) {
    this.view.fov = degrees;
    this.viewMoved();
  }

  setIsolines(on: boolean) {
    this.display.isolines = on;
    if (on && !this.display.falseColour) this.setFalseColour(true);
    else this.displayChanged();
  }

  setMode(mode: Mode) {
    this.mode = mode;
    if (mode === "orbit") {
      const hit = this.space.cast(this.view.position, this.view.direction());
      const middle = this.space.bounds.getCenter(new THREE.Vector3());
      this.view.target.copy(hit ? hit.point : middle);
    }
    this.tell("mode");
  }

  /** A change of exposure, curve or colours, which needs no new picture. */
  displayChanged() {
    this.displayIsNew = true;
    this.schedule();
    this.tell("display");
  }

  setFalseColour(on: boolean) {
    if (on && !this.display.falseColour) this.fitScale();
    this.display.falseColour = on;
    this.displayChanged();
  }

  /** Round ends about the luminances of the picture. */
  fitScale(logarithmic = this.display.scale.logarithmic) {
    this.requireCurrent();
    this.display.scale = niceScale(logarithmic, ...typicalRange(this.renderer.luminances()));
    this.displayChanged();
  }

  /** rgb at a place of the canvas in CSS pixels, drawn anew where it is out of date; null outside of it. */
  luminanceAt(x: number, y: number, centred: boolean): Float32Array | null {
    const { clientWidth, clientHeight } = this.canvas;
    if (!(x >= 0 && y >= 0 && x < clientWidth && y < clientHeight)) return null;
    this.applyView();
    const at = (place: number, most: number) => Math.min(Math.floor((Math.floor(place) + 0.5) * this.ratio), most - 1);
    const [width, height] = this.renderer.size;
    const result = this.renderer.pixel(at(x, width), at(y, height), centred);
    this.schedule();
    return result;
  }

  /** Luminance of the middle of a pixel; null outside of the canvas. */
  luminanceWithError(x: number, y: number): Value | null {
    const rgb = this.luminanceAt(x, y, true);
    if (!rgb) return null;
    const value = luminance(rgb);
    const reading = this.surfaceAt(x, y);
    return { value, halfWidth: reading ? this.readings.luminanceError(reading, value) : 0 };
  }

  /** The surface at a place of the canvas with its readings, as the averaged picture shows it. */
  probe(x: number, y: number): Probe | null {
    const rgb = this.luminanceAt(x, y, false);
    const reading = rgb && this.surfaceAt(x, y);
    if (!rgb || !reading) return null;
    const value = luminance(rgb);
    return { ...reading, luminance: { value, halfWidth: this.readings.luminanceError(reading, value) } };
  }

  surfaceAt(x: number, y: number): Reading | null {
    return this.readings.surfaceAt(this.view.position, this.rayAt(x, y));
  }

  rayAt(x: number, y: number): THREE.Vector3 {
    this.applyView();
    const { clientWidth, clientHeight } = this.canvas;
    const place = new THREE.Vector3(
      (2 * (Math.floor(x) + 0.5)) / clientWidth - 1, 1 - (2 * (Math.floor(y) + 0.5)) / clientHeight, 0.5);
    this.renderer.camera.updateProjectionMatrix();
    return place.unproject(this.renderer.camera).sub(this.view.position).normalize();
  }

  /** Where a point is seen, in CSS pixels; null behind the eye. */
  project(point: THREE.Vector3): [number, number] | null {
    this.applyView();
    const { camera } = this.renderer;
    if (point.clone().applyMatrix4(camera.matrixWorldInverse).z > -1e-3) return null;
    camera.updateProjectionMatrix();
    const place = point.clone().project(camera);
    return [(0.5 + 0.5 * place.x) * this.canvas.clientWidth, (0.5 - 0.5 * place.y) * this.canvas.clientHeight];
  }

  factors(): Record<string, Rgb> {
    return Object.fromEntries(this.scene.header.groups.map(({ name }, i) => [name, this.lighting.factors[i]!]));
  }

  private placeAtStart() {
    const camera = this.scene.header.cameras[0];
    if (camera) {
      this.view.place(camera.position, camera.target, camera.fov, camera.up);
      return;
    }
    const { min, max } = this.scene.header.bounds;
    const eye: Vec3 = [min[0] + 0.15 * (max[0] - min[0]), min[1] + 0.15 * (max[1] - min[1]), min[2] + EYE_HEIGHT];
    const middle = min.map((low, i) => (low + max[i]!) / 2) as Vec3;
    this.view.place(eye, [middle[0], middle[1], Math.min(middle[2], eye[2])], 75);
  }

  /** Walks by a pad: -1 to 1 each. */
  push(forward: number, right: number) {
    this.input.pad = { forward, right };
    this.wake();
  }

  private look(dx: number, dy: number) {
    if (this.mode === "orbit") this.view.orbit(-dx, -dy, 1);
    else this.view.turn(dx, dy);
    this.viewMoved();
  }

  private pan(dx: number, dy: number) {
    const right = new THREE.Vector3().crossVectors(this.view.direction(), new THREE.Vector3(0, 0, 1)).normalize();
    const up = new THREE.Vector3().crossVectors(right, this.view.direction());
    const scale = (0.0015 * this.view.fov * this.view.position.distanceTo(this.view.target)) / 60;
    const shift = right.multiplyScalar(-dx * scale).addScaledVector(up, dy * scale);
    this.view.position.add(shift);
    this.view.target.add(shift);
    this.viewMoved();
  }

  private zoom(factor: number) {
    if (this.mode === "orbit") this.view.orbit(0, 0, factor);
    else this.view.fov = Math.min(Math.max(this.view.fov * factor, 10), 120);
    this.viewMoved();
  }

  private viewMoved() {
    this.viewIsNew = true;
    this.renderer.viewChanged();
    this.schedule();
    this.tell("view");
  }

  private wake() {
    if (this.mode === "orbit") this.setMode("walk");
    if (!this.isWalking) this.lastTick = performance.now();
    this.isWalking = true;
    this.schedule();
  }

  private resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.ratio = Math.min(window.devicePixelRatio || 1, MOST_PIXEL_RATIO);
    this.renderer.resize(clientWidth, clientHeight, this.ratio);
    this.viewMoved();
  }

  private applyView() {
    this.view.applyTo(this.renderer.camera, this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1));
  }

  private schedule() {
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number) {
    this.isScheduled = false;
    this.walk(now);
    const moves = this.viewIsNew;
    this.viewIsNew = false;
    this.applyView();
    this.drawIfNeeded(moves);
    if (this.isWalking || this.renderer.canImprove || this.adaptation.isUnderWay) this.schedule();
    else this.times.rest();
  }

  private walk(now: number) {
    if (!this.isWalking) return;
    const seconds = Math.min(Math.max((now - this.lastTick) / 1000, 0), LONGEST_STEP);
    this.lastTick = now;
    const motion = this.input.motion();
    if (this.walker.step(motion, seconds)) this.viewMoved();
    else if (motion.forward === 0 && motion.right === 0 && motion.turn === 0) this.isWalking = false;
  }

  private drawIfNeeded(moves: boolean) {
    const draws = moves || this.renderer.canImprove;
    if (!draws && !this.displayIsNew && !this.adaptation.isUnderWay) return;
    const begin = this.times.begin();
    if (moves) this.renderer.drawMoving(this.times.scale, this.times.isCoarse);
    else if (draws) this.renderer.drawStill();
    this.display.exposure = this.adaptation.exposure(() => this.renderer.luminances(), draws);
    this.renderer.show(this.display);
    this.displayIsNew = false;
    this.renderer.finish();
    if (draws) this.times.end(begin, moves);
    this.tell("frame");
  }

  private requireCurrent() {
    if (!this.renderer.isCurrent) this.luminanceAt(0, 0, true);
  }

  private tell(type: string, detail: unknown = undefined) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
