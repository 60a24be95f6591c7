// Placed sensors as sections of a scene file.

import type { PlacedSensor } from "../data/source";

export function tomlOf(sensors: PlacedSensor[]): string {
  return sensors
    .map(({ name, type, position, normal }) =>
      [`[sensors.${name}]`, `type = "${type}"`, `position = ${list(position)}`, `normal = ${list(normal)}`].join("\n"))
    .join("\n\n");
}

/** With a decimal point each: the numbers of a TOML array have one type. */
function list(values: readonly number[]): string {
  return `[${values.map((value) => (Number.isInteger(value) ? value.toFixed(1) : String(value))).join(", ")}]`;
}
