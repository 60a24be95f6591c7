// Materials as the page sees them: a kind of drawing, and a reflectance for light without direction.

import type { MaterialEntry, Rgb } from "../data/scene";

export type Kind = "diffuse" | "glossy" | "mirror" | "glass" | "pane" | "black";

const KINDS: Record<string, Kind> = {
  diffuse: "diffuse",
  phong: "glossy",
  rough: "glossy",
  ward: "glossy",
  plastic: "glossy",
  mirror: "mirror",
  glass: "glass",
  pane: "pane",
  black: "black",
};

/** A type that this page does not know is drawn as if it were diffuse. */
export function kindOf(material: MaterialEntry): Kind {
  return KINDS[material.type] ?? "diffuse";
}

export function rgbOf(value: number | Rgb | undefined, otherwise = 0): Rgb {
  if (Array.isArray(value)) return value;
  const level = value ?? otherwise;
  return [level, level, level];
}

/** The share of light from everywhere that is reflected, for light that is drawn without a highlight. */
export function flatReflectance(material: MaterialEntry): Rgb {
  const kind = kindOf(material);
  return isSpecular(kind) || kind === "black" ? [0, 0, 0] : material.colour;
}

/** Whether light passes through or is mirrored, so that no light is stored on the surface. */
export function isSpecular(kind: Kind): boolean {
  return kind === "mirror" || kind === "glass" || kind === "pane";
}

/** The half-width of the reflected lobe, in radians: decides into how many points a lamp is divided. */
export function lobeWidth(material: MaterialEntry): number {
  if (material.type === "phong") return 1.2 / Math.sqrt((material.exponent ?? 1) + 2);
  const roughness = material.roughness ?? 0.1;
  return Array.isArray(roughness) ? Math.min(...roughness) : roughness;
}
