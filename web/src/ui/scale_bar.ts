// The bar of the false colours with round numbers.

import type { Walkthrough } from "../app";
import { COLOUR_MAP } from "../draw/colour_map";
import { fractionOf, ticksOf } from "../draw/scale";
import { BAR_TICKS } from "../draw/tone";
import { byId, element } from "./dom";

export function scaleBar(walk: Walkthrough) {
  const place = byId("scale");
  const bar = element("canvas", { width: "1", height: `${COLOUR_MAP.length}`, "aria-hidden": "true" });
  paint(bar);
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

function paint(bar: HTMLCanvasElement) {
  const context = bar.getContext("2d")!;
  COLOUR_MAP.forEach(([r, g, b], i) => {
    context.fillStyle = `rgb(${r} ${g} ${b})`;
    context.fillRect(0, COLOUR_MAP.length - 1 - i, 1, 1);
  });
}
