// The panel "Lights": each group dimmed, recoloured and switched.

import type { Walkthrough } from "../app";
import type { Rgb } from "../data/scene";
import { button, element, field, press, range, toggle } from "./dom";

export function lightPanel(walk: Walkthrough): HTMLElement {
  const { groups } = walk.scene.header;
  const rows = groups.map((_, i) => groupRow(walk, i));
  const all = button("All as in the scene", () => groups.forEach(({ name }) => walk.set(name, 1)));
  const none = groups.length === 0 ? element("p", { class: "note" }, "This scene has no lights.") : null;
  return element("div", { class: "page" }, none, ...rows, groups.length > 1 ? all : null);
}

function groupRow(walk: Walkthrough, group: number): HTMLElement {
  const { groups, lights } = walk.scene.header;
  const { name } = groups[group]!;
  const members = lights.filter((light) => light.group === group);
  const flux = members.reduce((sum, light) => sum + (light.flux_lm || 0), 0);
  let colour: Rgb = [1, 1, 1];
  let level = 1;
  const on = toggle("On", (wanted) => set(wanted ? level || 1 : 0), { "aria-label": `${name} on` });
  const slider = range(0, 200, 1, 100, `Dimming of ${name} in per cent`);
  const chooser = element("input", { type: "color", value: "#ffffff", "aria-label": `Colour of ${name}` });
  const value = element("output", {});
  const set = (factor: number) => walk.set(name, colour.map((c) => c * factor) as Rgb);
  slider.addEventListener("input", () => set(Number(slider.value) / 100));
  chooser.addEventListener("input", () => {
    colour = chromaticity(chooser.value);
    set(Math.max(level, 0));
  });
  const refresh = () => {
    const factor = walk.lighting.factors[group]!;
    const current = 0.2126 * factor[0] + 0.7152 * factor[1] + 0.0722 * factor[2];
    if (current > 0) {
      level = current;
      colour = factor.map((c) => c / current) as Rgb;
    }
    press(on, current > 0);
    on.textContent = current > 0 ? "On" : "Off";
    slider.value = String(100 * current);
    chooser.value = hex(colour);
    value.textContent = `${Math.round(100 * current)} %`;
  };
  walk.addEventListener("factors", refresh);
  refresh();
  const facts = [members.length > 1 ? `${members.length} lights` : members[0]?.type ?? "", flux > 0 ? `${Math.round(flux)} lm` : ""];
  const title = element("div", { class: "light-title" }, element("h2", {}, name), element("span", { class: "hint" }, facts.filter(Boolean).join(", ")));
  return element("section", { class: "block" }, element("div", { class: "light-head" }, title, chooser, on), field("Dimming", slider, value));
}

/** Linear RGB of luminance 1, so that another colour does not dim. */
function chromaticity(text: string): Rgb {
  const rgb = [1, 3, 5].map((at) => linear(parseInt(text.slice(at, at + 2), 16) / 255)) as Rgb;
  const luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  return luminance > 0 ? (rgb.map((c) => c / luminance) as Rgb) : [1, 1, 1];
}

function linear(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

/** The brightest colour of this chromaticity. */
function hex(rgb: Rgb): string {
  const most = Math.max(...rgb, 1e-9);
  const byte = (value: number) => {
    const x = Math.max(value / most, 0);
    const encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
    return Math.round(255 * encoded).toString(16).padStart(2, "0");
  };
  return `#${rgb.map(byte).join("")}`;
}
