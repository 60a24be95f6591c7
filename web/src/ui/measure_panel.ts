// The panel "Measure": the ruler, sensors to place, and measurements by the program.

import type * as THREE from "three";

import type { Probe, Walkthrough } from "../app";
import type { Vec3 } from "../data/scene";
import type { Measurement, PlacedSensor, Source } from "../data/source";
import { valueText } from "../light/readings";
import { button, element, press, section, toggle } from "./dom";
import type { Mark, Marks } from "./marks";
import { tomlOf } from "./sensor_toml";

export type Tool = "none" | "ruler" | "sensor" | "measure";

/** Above the surface, so that a sensor is not taken for a point below it. */
const LIFT = 1e-3;

export class MeasurePanel {
  readonly element: HTMLElement;
  tool: Tool = "none";
  private readonly toggles = new Map<Tool, HTMLElement>();
  private readonly ruler = element("p", { class: "note", role: "status" });
  private readonly sensors: { sensor: PlacedSensor; mark: Mark }[] = [];
  private readonly sensorList = element("ul", { class: "list" });
  private readonly results = element("ul", { class: "list" });
  private readonly toml = element("textarea", { readonly: true, rows: "6", "aria-label": "Sensors for the scene file" });
  private readonly savedNote = element("p", { class: "note", role: "status" });
  private readonly sensorDetails: HTMLElement;
  private rulerStart: THREE.Vector3 | null = null;
  private rulerMarks: Mark[] = [];

  constructor(
    private readonly walk: Walkthrough,
    private readonly source: Source,
    private readonly marks: Marks,
  ) {
    this.sensorDetails = this.buildSensorDetails();
    this.element = element("div", { class: "page" }, this.rulerSection(), this.measureSection(), this.sensorSection());
    walk.addEventListener("pick", (event) => {
      const { x, y } = (event as CustomEvent).detail;
      this.pick(x, y);
    });
    this.refreshSensors();
  }

  choose(tool: Tool) {
    this.tool = this.tool === tool ? "none" : tool;
    for (const [each, control] of this.toggles) press(control, each === this.tool);
    this.rulerStart = null;
    this.walk.canvas.classList.toggle("aiming", this.tool !== "none");
    if (this.tool === "ruler") this.ruler.textContent = "Click the first point.";
  }

  private rulerSection(): HTMLElement {
    this.ruler.textContent = "Click two points: their distance is shown.";
    return section("Ruler", this.toolToggle("ruler", "Measure a distance", "R"), this.ruler);
  }

  private measureSection(): HTMLElement | null {
    if (!this.source.live) return null;
    const note = element("p", { class: "note" }, "Click a surface: the program measures it there without patches, by the method auto.");
    return section("Measure here", this.toolToggle("measure", "Measure by clicks", "M"), note, this.results);
  }

  private sensorSection(): HTMLElement {
    return section("Sensors", this.toolToggle("sensor", "Place sensors", "P"), this.sensorList, this.sensorDetails);
  }

  private buildSensorDetails(): HTMLElement {
    const copy = button("Copy", () => void this.copy());
    const save = this.source.live ? button("Save beside the scene", () => void this.save()) : null;
    return element("div", { class: "stack" }, this.toml, element("div", { class: "buttons" }, copy, save), this.savedNote);
  }

  private toolToggle(tool: Tool, label: string, key: string): HTMLElement {
    const control = toggle(label, () => this.choose(tool), { title: `Key ${key}`, class: "wide" });
    this.toggles.set(tool, control);
    return control;
  }

  private pick(x: number, y: number) {
    if (this.tool === "none") return;
    const probe = this.walk.probe(x, y);
    if (!probe) return;
    if (this.tool === "ruler") this.pickRuler(probe.hit.point);
    else if (this.tool === "sensor") this.addSensor(probe);
    else void this.measure(probe, this.walk.rayAt(x, y));
  }

  private pickRuler(point: THREE.Vector3) {
    if (!this.rulerStart) {
      this.marks.remove(...this.rulerMarks);
      this.rulerStart = point;
      this.rulerMarks = [this.marks.add({ points: [point], text: "", kind: "ruler" })];
      this.ruler.textContent = "Click the second point.";
      return;
    }
    const text = `${this.rulerStart.distanceTo(point).toFixed(3)} m`;
    this.marks.remove(...this.rulerMarks);
    this.rulerMarks = [this.marks.add({ points: [this.rulerStart, point], text, kind: "ruler" })];
    const apart = point.clone().sub(this.rulerStart);
    const parts = [apart.x, apart.y, apart.z].map((x) => Math.abs(x).toFixed(3));
    this.ruler.textContent = `${text}; along x ${parts[0]}, y ${parts[1]}, z ${parts[2]} m`;
    this.rulerStart = null;
  }

  private addSensor(probe: Probe) {
    const taken = new Set(this.sensors.map(({ sensor }) => sensor.name).concat(this.walk.scene.header.sensors.map(({ name }) => name)));
    let number = 1;
    while (taken.has(`spot_${number}`)) ++number;
    const [position, normal] = placeOf(probe);
    const sensor: PlacedSensor = { name: `spot_${number}`, type: "illuminance", position, normal };
    const mark = this.marks.add({ points: [probe.hit.point], text: sensor.name, kind: "sensor" });
    this.sensors.push({ sensor, mark });
    this.refreshSensors();
  }

  private refreshSensors() {
    this.sensorList.replaceChildren(
      ...this.sensors.map((entry) => {
        const remove = button("Remove", () => {
          this.marks.remove(entry.mark);
          this.sensors.splice(this.sensors.indexOf(entry), 1);
          this.refreshSensors();
        }, { "aria-label": `Remove ${entry.sensor.name}`, class: "small" });
        return element("li", {}, element("span", {}, entry.sensor.name), remove);
      }),
    );
    this.toml.value = tomlOf(this.sensors.map(({ sensor }) => sensor));
    this.sensorDetails.hidden = this.sensors.length === 0;
    this.savedNote.textContent = "";
  }

  private async copy() {
    this.toml.select();
    try {
      await navigator.clipboard.writeText(this.toml.value);
      this.savedNote.textContent = "Copied.";
    } catch {
      this.savedNote.textContent = "The browser does not allow to copy: the text is selected.";
    }
  }

  private async save() {
    try {
      const { saved } = await this.source.saveSensors(this.sensors.map(({ sensor }) => sensor));
      this.savedNote.textContent = `Saved as ${saved}.`;
    } catch (error) {
      this.savedNote.textContent = messageOf(error);
    }
  }

  /** Both what the page shows and what the program measures, side by side. */
  private async measure(probe: Probe, direction: THREE.Vector3) {
    const [position, normal] = placeOf(probe);
    const mark = this.marks.add({ points: [probe.hit.point], text: "measuring", kind: "measured" });
    const row = element("li", { class: "result" }, element("span", { class: "hint" }, "Measuring"));
    this.results.prepend(row);
    const factors = this.walk.factors();
    const eye = this.walk.view.position.toArray() as Vec3;
    const along = direction.toArray() as Vec3;
    try {
      const illuminance = await this.source.measure({ kind: "illuminance", position, normal, factors });
      const seen = await this.source.measure({ kind: "luminance", position: eye, direction: along, factors });
      row.replaceChildren(comparison(probe, illuminance, seen));
      mark.text = `${valueText({ value: illuminance.value, halfWidth: illuminance.half_width })} lx`;
    } catch (error) {
      row.replaceChildren(element("span", { class: "error" }, messageOf(error)));
      mark.text = "not measured";
    }
    this.marks.draw();
  }
}

function placeOf({ hit }: Probe): [Vec3, Vec3] {
  const round = (x: number) => Number(x.toFixed(4));
  const position = hit.point.clone().addScaledVector(hit.normal, LIFT).toArray().map(round) as Vec3;
  return [position, hit.normal.toArray().map((x) => Number(x.toFixed(6)) + 0) as Vec3];
}

function comparison(probe: Probe, illuminance: Measurement, seen: Measurement): HTMLElement {
  const row = (label: string, shown: string, measured: Measurement) =>
    element("tr", {},
      element("th", { scope: "row" }, label),
      element("td", {}, shown),
      element("td", {}, valueText({ value: measured.value, halfWidth: measured.half_width })));
  const head = element("tr", {}, element("th", {}, `${probe.object}`), element("th", { scope: "col" }, "shown"), element("th", { scope: "col" }, "measured"));
  const lux = probe.illuminance ? valueText(probe.illuminance) : "";
  return element("table", {}, head, row("lx", lux, illuminance), row("cd/m²", valueText(probe.luminance), seen));
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
