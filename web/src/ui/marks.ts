// Marks over the picture: rulers, sensors and measured points, which stay at their places in the scene.

import * as THREE from "three";

import type { Walkthrough } from "../app";
import { byId } from "./dom";

export interface Mark {
  points: THREE.Vector3[];
  text: string;
  kind: "ruler" | "sensor" | "measured";
}

const SVG = "http://www.w3.org/2000/svg";

export class Marks {
  private readonly marks: Mark[] = [];
  private readonly svg = byId<SVGSVGElement>("marks");

  constructor(private readonly walk: Walkthrough) {
    walk.addEventListener("frame", () => this.draw());
  }

  add(mark: Mark): Mark {
    this.marks.push(mark);
    this.draw();
    return mark;
  }

  remove(...gone: Mark[]) {
    for (const mark of gone) {
      const at = this.marks.indexOf(mark);
      if (at >= 0) this.marks.splice(at, 1);
    }
    this.draw();
  }

  draw() {
    if (this.marks.length === 0 && this.svg.childElementCount === 0) return;
    this.svg.replaceChildren(...this.marks.flatMap((mark) => this.shapes(mark)));
  }

  private shapes({ points, text, kind }: Mark): SVGElement[] {
    const places = points.map((point) => this.walk.project(point));
    if (places.some((place) => place === null)) return [];
    const seen = places as [number, number][];
    const shapes: SVGElement[] = [];
    if (seen.length === 2) {
      const [[x1, y1], [x2, y2]] = seen as [[number, number], [number, number]];
      shapes.push(shape("line", { x1, y1, x2, y2, class: "casing" }), shape("line", { x1, y1, x2, y2, class: kind }));
    }
    for (const [cx, cy] of seen) shapes.push(shape("circle", { cx, cy, r: 4.5, class: kind }));
    const x = seen.reduce((sum, [px]) => sum + px, 0) / seen.length + 9;
    const y = seen.reduce((sum, [, py]) => sum + py, 0) / seen.length - 9;
    const label = shape("text", { x, y, class: kind });
    label.textContent = text;
    return [...shapes, label];
  }
}

function shape(name: string, attributes: Record<string, string | number>): SVGElement {
  const result = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) result.setAttribute(key, String(value));
  return result;
}
