// The pad for walking on touch screens.

import type { Walkthrough } from "../app";
import { byId, element } from "./dom";

const REACH = 44;

export function walkingPad(walk: Walkthrough) {
  const pad = byId("pad");
  pad.hidden = !window.matchMedia("(pointer: coarse)").matches;
  const knob = element("div", { class: "knob" });
  pad.append(knob);
  const move = (x: number, y: number) => {
    const length = Math.max(Math.hypot(x, y), REACH);
    walk.push(-y / length, x / length);
    knob.style.transform = `translate(${(x / length) * REACH}px, ${(y / length) * REACH}px)`;
  };
  const place = (event: PointerEvent) => {
    const box = pad.getBoundingClientRect();
    move(event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2);
  };
  pad.addEventListener("pointerdown", (event) => {
    pad.setPointerCapture(event.pointerId);
    place(event);
  });
  pad.addEventListener("pointermove", (event) => {
    if (pad.hasPointerCapture(event.pointerId)) place(event);
  });
  for (const end of ["pointerup", "pointercancel"] as const) pad.addEventListener(end, () => move(0, 0));
}
