// The points of each light at several levels of detail: all of them, and merged to at most 16, 4 and 1.

import type { Scene } from "../data/scene";

/** Position, normal (0: to all sides) and weight of a point of a light. */
export interface LampPoint {
  position: number[];
  normal: number[];
  weight: number;
}

export interface LampLevel {
  first: number;
  count: number;
}

/** A light's levels, from one point to all; its middle and its radius. */
export interface Lamp {
  levels: LampLevel[];
  middle: number[];
  radius: number;
}

const MERGED_COUNTS = [1, 4, 16];

export class LampPoints {
  readonly lamps: Lamp[];
  private readonly rows: LampPoint[] = [];

  constructor(scene: Scene) {
    this.lamps = scene.header.lights.map(({ points: [first, count] }) => {
      const points = Array.from({ length: count }, (_, i) => pointAt(scene.lightPoints, first + i));
      return this.add(points);
    });
  }

  pointsOf({ first, count }: LampLevel): LampPoint[] {
    return this.rows.slice(first, first + count);
  }

  private add(points: LampPoint[]): Lamp {
    const merged = MERGED_COUNTS.filter((count) => count < points.length).map((count) => merge(points, count));
    const levels = [...merged, points].map((level) => {
      const first = this.rows.length;
      this.rows.push(...level);
      return { first, count: level.length };
    });
    const middle = points.length > 0 ? mean(points).position : [0, 0, 0];
    const radius = Math.max(0, ...points.map(({ position }) => distance(position, middle)));
    return { levels, middle, radius };
  }
}

function pointAt(rows: Float32Array, row: number): LampPoint {
  const at = 8 * row;
  return {
    position: [...rows.subarray(at, at + 3)],
    normal: [...rows.subarray(at + 3, at + 6)],
    weight: rows[at + 6]!,
  };
}

function distance(a: number[], b: number[]): number {
  return Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!);
}

/** Halves along the longest axis until there are `count` clusters; each becomes its weighted mean. */
function merge(points: LampPoint[], count: number): LampPoint[] {
  let clusters = [points];
  while (clusters.length < count) {
    clusters = clusters.flatMap((cluster) => (cluster.length > 1 ? halves(cluster) : [cluster]));
    if (clusters.every(({ length }) => length === 1)) break;
  }
  return clusters.map(mean);
}

function halves(points: LampPoint[]): LampPoint[][] {
  const extent = (axis: number) => {
    const values = points.map(({ position }) => position[axis]!);
    return Math.max(...values) - Math.min(...values);
  };
  const axis = [0, 1, 2].reduce((best, candidate) => (extent(candidate) > extent(best) + 1e-9 ? candidate : best));
  const sorted = [...points].sort((a, b) => a.position[axis]! - b.position[axis]!);
  const middle = Math.ceil(sorted.length / 2);
  return [sorted.slice(0, middle), sorted.slice(middle)];
}

function mean(points: LampPoint[]): LampPoint {
  const weight = points.reduce((sum, point) => sum + point.weight, 0);
  const average = (of: (point: LampPoint) => number[]) =>
    [0, 1, 2].map((i) => points.reduce((sum, point) => sum + point.weight * of(point)[i]!, 0) / (weight || 1));
  const normal = average((point) => point.normal);
  const length = Math.hypot(...normal);
  return {
    position: average((point) => point.position),
    // Points around a lamp shine to all sides together.
    normal: length > 0.5 ? normal.map((x) => x / length) : [0, 0, 0],
    weight,
  };
}
