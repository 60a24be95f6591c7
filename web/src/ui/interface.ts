// The user interface: tool bar, panel with its tabs, keys.

import type { Walkthrough } from "../app";
import type { Source } from "../data/source";
import { isTyped } from "../walk/input";
import { byId, button, element, press, toggle } from "./dom";
import { lightPanel } from "./light_panel";
import { Marks } from "./marks";
import { MeasurePanel } from "./measure_panel";
import { walkingPad } from "./pad";
import { readingCard } from "./reading_card";
import { scaleBar } from "./scale_bar";
import { goToCamera, viewPanel } from "./view_panel";

/** Narrower, the panel covers the picture: it opens when asked for. */
const NARROW = "(max-width: 760px)";

export function buildInterface(walk: Walkthrough, source: Source) {
  const { name, file } = walk.scene.header;
  byId("title").textContent = name || file;
  document.title = `${name || file} · Stilb`;
  const measuring = new MeasurePanel(walk, source, new Marks(walk));
  buildPanel([["View", viewPanel(walk)], ["Lights", lightPanel(walk)], ["Measure", measuring.element]]);
  buildTools(walk);
  scaleBar(walk);
  readingCard(walk);
  walkingPad(walk);
  listenToKeys(walk, measuring, source);
}

function buildPanel(pages: [string, HTMLElement][]) {
  const panel = byId("panel");
  const tabs = pages.map(([title, page], i) => {
    page.id = `page-${i}`;
    page.setAttribute("role", "tabpanel");
    page.setAttribute("aria-label", title);
    return button(title, () => show(i), { role: "tab", "aria-controls": page.id });
  });
  const show = (chosen: number) => {
    tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
    });
    pages.forEach(([, page], i) => (page.hidden = i !== chosen));
  };
  const list = element("div", { role: "tablist", class: "tabs" }, ...tabs);
  list.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    const next = (tabs.indexOf(event.target as HTMLButtonElement) + step + tabs.length) % tabs.length;
    show(next);
    tabs[next]!.focus();
  });
  panel.append(list, ...pages.map(([, page]) => page));
  show(0);
}

function buildTools(walk: Walkthrough) {
  const colours = toggle("False colours", (on) => walk.setFalseColour(on), { title: "Key F" });
  const settings = toggle("Settings", (open) => setOpen(open), { "aria-controls": "panel" });
  const setOpen = (open: boolean) => {
    press(settings, open);
    settings.setAttribute("aria-expanded", String(open));
    document.body.classList.toggle("with-panel", open);
  };
  byId("tools").append(colours, settings);
  walk.addEventListener("display", () => press(colours, walk.display.falseColour));
  setOpen(!window.matchMedia(NARROW).matches);
}

function listenToKeys(walk: Walkthrough, measuring: MeasurePanel, source: Source) {
  const actions: Record<string, () => void> = {
    o: () => walk.setMode(walk.mode === "walk" ? "orbit" : "walk"),
    f: () => walk.setFalseColour(!walk.display.falseColour),
    i: () => walk.setIsolines(!walk.display.isolines),
    r: () => measuring.choose("ruler"),
    p: () => measuring.choose("sensor"),
    escape: () => measuring.choose("none"),
  };
  if (source.live) actions.m = () => measuring.choose("measure");
  walk.scene.header.cameras.slice(0, 9).forEach((camera, i) => (actions[`${i + 1}`] = () => goToCamera(walk, camera)));
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyped(event.target)) return;
    actions[event.key.toLowerCase()]?.();
  });
}
