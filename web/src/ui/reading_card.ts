// The card with the readings under the cursor.

import type { Probe, Walkthrough } from "../app";
import { valueText } from "../light/readings";
import { byId, element } from "./dom";

export function readingCard(walk: Walkthrough) {
  const card = byId("reading");
  let place: { x: number; y: number } | null = null;
  let isPending = false;
  const refresh = () => {
    isPending = false;
    const probe = place && walk.probe(place.x, place.y);
    card.hidden = !probe;
    if (probe) card.replaceChildren(...rows(probe));
  };
  // At most once a frame: reading a pixel waits for the graphics card.
  const schedule = () => {
    if (isPending) return;
    isPending = true;
    setTimeout(refresh, 60);
  };
  walk.addEventListener("hover", (event) => {
    place = (event as CustomEvent).detail;
    schedule();
  });
  // A finger does not hover: what it taps is read.
  walk.addEventListener("pick", (event) => {
    place = (event as CustomEvent).detail;
    schedule();
  });
  walk.addEventListener("light", schedule);
  walk.addEventListener("factors", schedule);
  walk.addEventListener("view", () => {
    if (place) schedule();
  });
}

function rows(probe: Probe): HTMLElement[] {
  const name = element("p", { class: "where" }, element("strong", {}, probe.object), ` ${probe.material}`);
  if (probe.seenBy) name.append(element("span", { class: "hint" }, ` ${probe.seenBy}`));
  const luminance = row(valueText(probe.luminance), "cd/m²", "Luminance");
  const illuminance = probe.illuminance ? row(valueText(probe.illuminance), "lx", "Illuminance") : null;
  return [luminance, ...(illuminance ? [illuminance] : []), name];
}

function row(value: string, unit: string, label: string): HTMLElement {
  return element("p", { class: "value", "aria-label": `${label} ${value} ${unit}` }, element("span", {}, value), element("span", { class: "unit" }, unit));
}
