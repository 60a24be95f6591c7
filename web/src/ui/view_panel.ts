// The panel "View": places to go to, exposure, tone curve and false colours.

import type { Walkthrough } from "../app";
import type { CameraEntry, SensorEntry, Vec3 } from "../data/scene";
import { numberText } from "../draw/scale";
import { type Curve, CURVES } from "../draw/tone";
import { EYE_HEIGHT } from "../walk/view";
import { button, element, field, press, range, section, select, toggle } from "./dom";

const CURVE_NAMES: Record<Curve, string> = { reinhard: "Reinhard", aces: "ACES filmic", linear: "Linear" };

export function viewPanel(walk: Walkthrough): HTMLElement {
  return element("div", { class: "page" }, motionSection(walk), placesSection(walk), exposureSection(walk), colourSection(walk));
}

function motionSection(walk: Walkthrough): HTMLElement {
  const walkButton = toggle("Walk", () => walk.setMode("walk"));
  const orbitButton = toggle("Orbit", () => walk.setMode("orbit"), { title: "Key O" });
  const refresh = () => {
    press(walkButton, walk.mode === "walk");
    press(orbitButton, walk.mode === "orbit");
  };
  walk.addEventListener("mode", refresh);
  refresh();
  const fov = range(20, 110, 1, walk.view.fov, "Angle of view in degrees");
  const value = element("output", {});
  fov.addEventListener("input", () => walk.setFieldOfView(Number(fov.value)));
  const follow = () => {
    fov.value = String(walk.view.fov);
    value.textContent = `${Math.round(walk.view.fov)}°`;
  };
  walk.addEventListener("view", follow);
  follow();
  return section("Motion", element("div", { class: "segments" }, walkButton, orbitButton), field("Angle of view", fov, value));
}

function placesSection(walk: Walkthrough): HTMLElement | null {
  const { cameras, sensors } = walk.scene.header;
  if (cameras.length + sensors.length === 0) return null;
  const list = element("div", { class: "places" });
  cameras.forEach((camera, i) => list.append(placeButton(camera.name, i < 9 ? `${i + 1}` : "", () => goToCamera(walk, camera))));
  for (const sensor of sensors) list.append(placeButton(sensor.name, sensor.type, () => goToSensor(walk, sensor)));
  return section("Go to", list);
}

function placeButton(name: string, hint: string, onClick: () => void): HTMLElement {
  const result = button(name, onClick, { "aria-label": `Go to ${name}` });
  if (hint) result.append(element("span", { class: "hint" }, hint));
  return result;
}

export function goToCamera(walk: Walkthrough, { position, target, fov, up }: CameraEntry) {
  walk.place(position, target, fov, up);
}

/** A line of sight is looked along; a surface is looked at from one side. */
function goToSensor(walk: Walkthrough, { position, direction, normal }: SensorEntry) {
  if (direction) {
    walk.place(position, position.map((x, i) => x + direction[i]!) as Vec3);
    return;
  }
  const [nx, ny, nz] = normal ?? [0, 0, 1];
  const isLevel = Math.hypot(nx, ny) < 0.5;
  const { min, max } = walk.scene.header.bounds;
  const toMiddle = [(min[0] + max[0]) / 2 - position[0], (min[1] + max[1]) / 2 - position[1]];
  const length = Math.hypot(toMiddle[0]!, toMiddle[1]!) || 1;
  const aside = isLevel ? toMiddle.map((x) => x / length) : [nx, ny];
  const height = isLevel && nz > 0 ? EYE_HEIGHT - 0.75 : 0.1;
  walk.place([position[0] + 1.2 * aside[0]! || position[0] + 0.01, position[1] + 1.2 * aside[1]!, position[2] + height], position);
}

function exposureSection(walk: Walkthrough): HTMLElement {
  const { adaptation, display } = walk;
  const byEye = toggle("Adapting", () => setAutomatic(true), { title: "Follows the picture like an eye" });
  const byHand = toggle("By hand", () => setAutomatic(false));
  const slider = range(-6, 6, 0.1, 0, "Exposure in stops");
  const value = element("output", {});
  const reset = () => {
    slider.value = String(adaptation.automatic ? adaptation.compensation : Math.log2(adaptation.manual / BASE));
  };
  const refresh = () => {
    press(byEye, adaptation.automatic);
    press(byHand, !adaptation.automatic);
    const stops = Number(slider.value);
    const sign = stops > 0 ? "+" : stops < 0 ? "−" : "";
    value.textContent = adaptation.automatic ? `${sign}${Math.abs(stops).toFixed(1)} stops` : `${numberText(Number(adaptation.manual.toPrecision(2)))} per cd/m²`;
  };
  const setAutomatic = (automatic: boolean) => {
    if (!automatic) adaptation.manual = display.exposure;
    adaptation.automatic = automatic;
    if (automatic) adaptation.compensation = 0;
    [slider.min, slider.max] = automatic ? ["-6", "6"] : ["-10", "10"];
    reset();
    refresh();
    walk.displayChanged();
  };
  slider.addEventListener("input", () => {
    const stops = Number(slider.value);
    if (adaptation.automatic) adaptation.compensation = stops;
    else adaptation.manual = BASE * 2 ** stops;
    refresh();
    walk.displayChanged();
  });
  refresh();
  const curves = CURVES.map((curve) => [curve, CURVE_NAMES[curve]] as [string, string]);
  const curve = select(curves, (chosen) => {
    display.curve = chosen as Curve;
    walk.displayChanged();
  }, "Tone curve");
  return section("Exposure", element("div", { class: "segments" }, byEye, byHand), field("Exposure", slider, value), field("Tone curve", curve));
}

/** Exposure of 0 stops by hand. */
const BASE = 0.01;

function colourSection(walk: Walkthrough): HTMLElement {
  const { display } = walk;
  const on = toggle("False colours", (wanted) => walk.setFalseColour(wanted), { title: "Key F" });
  const lines = toggle("Isolines", (wanted) => walk.setIsolines(wanted), { title: "Key I" });
  const kind = select([["linear", "Linear"], ["logarithmic", "Logarithmic"]], (chosen) => walk.fitScale(chosen === "logarithmic"), "Scale");
  const low = element("input", { type: "number", min: "0", step: "any", "aria-label": "Least luminance of the scale" });
  const high = element("input", { type: "number", min: "0", step: "any", "aria-label": "Greatest luminance of the scale" });
  const apply = () => {
    const [from, to] = [Number(low.value), Number(high.value)];
    const isUsable = to > from && (!display.scale.logarithmic || from > 0);
    if (isUsable) display.scale = { ...display.scale, low: from, high: to };
    walk.displayChanged();
  };
  low.addEventListener("change", apply);
  high.addEventListener("change", apply);
  const fit = button("Fit to the picture", () => walk.fitScale());
  const refresh = () => {
    press(on, display.falseColour);
    press(lines, display.isolines);
    kind.value = display.scale.logarithmic ? "logarithmic" : "linear";
    low.value = String(display.scale.low);
    high.value = String(display.scale.high);
    details.hidden = !display.falseColour;
  };
  const ends = element("div", { class: "ends" }, low, element("span", {}, "to"), high, element("span", {}, "cd/m²"));
  const details = element("div", { class: "stack" }, field("Scale", kind), ends, fit);
  walk.addEventListener("display", refresh);
  refresh();
  return section("Luminance", element("div", { class: "segments" }, on, lines), details);
}

