// The bar of the false colours with round numbers.

import type { Walkthrough } from "../app";
import type { Rgb } from "../data/scene";
import { fractionOf, ticksOf } from "../draw/scale";
import { BAR_TICKS } from "../draw/tone";
import { byId, element } from "./dom";

export function scaleBar(walk: Walkthrough) {
  const place = byId("scale");
  const colours = walk.scene.header.false_colours;
  const bar = element("canvas", { width: "1", height: `${colours.length}`, "aria-hidden": "true" });
  paint(bar, colours);
  const labels = element("ol", {});
  place.append(element("p", {}, "cd/m²"), element("div", { class: "scale-body" }, bar, labels));
  const refresh = () => {
    const { falseColour, scale } = walk.display;
    place.hidden = !falseColour;
    labels.replaceChildren(
      ...ticksOf(scale, BAR_TICKS).map(({ value, label }) => {
        const item = element("li", {}, label);
        item.style.bottom = `${100 * fractionOf(scale, value)}%`;
        return item;
      }),
    );
  };
  walk.addEventListener("display", refresh);
  refresh();
}

function paint(bar: HTMLCanvasElement, colours: Rgb[]) {
  const context = bar.getContext("2d")!;
  colours.forEach(([r, g, b], i) => {
    context.fillStyle = `rgb(${r} ${g} ${b})`;
    context.fillRect(0, colours.length - 1 - i, 1, 1);
  });
}
