// Tables of facets after GGX with Smith's height-correlated masking: shares of light by the cosine, as the
// program computes them (docs/materials.md, "Rough" and "Plastic").

const CELLS = 128;
/** Rings and rays of the disk of visible normals: a quarter of the program's, for tables within 1e-3. */
const RINGS = 32;
const RAYS = 32;

/** A share of light, tabulated evenly in log(1 + cosine / alpha), and its mean under light from everywhere. */
export interface CosineTable {
  values: Float32Array;
  average: number;
  cellsPerLog: number;
}

interface Vector {
  x: number;
  y: number;
  z: number;
}

/** 1 - albedo of white facets: the light that remains between them. */
export function lossTable(alpha: number): CosineTable {
  return tabulate(alpha, (cosine) =>
    meanOverNormals(alpha, cosine, (view, normal) => {
      const out = reflected(view, normal);
      return out.z > 0 ? 1 - passing(alpha, view, out) : 1;
    }),
  );
}

/** The share of light that passes a clear coat with such facets. */
export function transmissionTable(alpha: number, ior: number): CosineTable {
  return tabulate(alpha, (cosine) => {
    const reflectance = meanOverNormals(alpha, cosine, (view, normal) => {
      const out = reflected(view, normal);
      if (out.z <= 0) return 0;
      return fresnel(dot(view, normal), ior) * passing(alpha, view, out);
    });
    return 1 - reflectance;
  });
}

/** Fresnel's reflectance of unpolarised light. */
export function fresnel(cosine: number, ior: number): number {
  if (ior === 1) return 0;
  const refracted = Math.sqrt(Math.max(0, 1 - ((1 - cosine) * (1 + cosine)) / (ior * ior)));
  const across = (cosine - ior * refracted) / (cosine + ior * refracted);
  const along = (ior * cosine - refracted) / (ior * cosine + refracted);
  return (across * across + along * along) / 2;
}

function tabulate(alpha: number, share: (cosine: number) => number): CosineTable {
  const cellsPerLog = CELLS / Math.log1p(1 / alpha);
  const cosineAt = (position: number) => Math.min(alpha * Math.expm1(position / cellsPerLog), 1);
  const values = Float32Array.from({ length: CELLS + 1 }, (_, i) => share(cosineAt(i)));
  let average = 0;
  for (let i = 0; i < CELLS; ++i) {
    // The integral of (a + b t) 2 c dc over a cell, exactly.
    const low = cosineAt(i);
    const width = cosineAt(i + 1) - low;
    const [first, last] = [values[i]!, values[i + 1]!];
    average += width * (low * (first + last) + (width * (first + 2 * last)) / 3);
  }
  return { values, average, cellsPerLog };
}

/** By the midpoint rule on the disk of visible normals, denser near its rim, where steep facets are. */
function meanOverNormals(alpha: number, cosine: number, of: (view: Vector, normal: Vector) => number): number {
  const view = { x: Math.sqrt((1 - cosine) * (1 + cosine)), y: 0, z: cosine };
  let sum = 0;
  for (let i = 0; i < RINGS; ++i) {
    const toRim = 1 - (i + 0.5) / RINGS;
    const radius = Math.sqrt(1 - toRim ** 3);
    let ring = 0;
    for (let j = 0; j < RAYS; ++j) {
      const phi = Math.PI * ((j + 0.5) / RAYS - 0.5);
      ring += of(view, visibleNormal(alpha, view, radius * Math.cos(phi), radius * Math.sin(phi)));
    }
    sum += 3 * toRim * toRim * ring;
  }
  return sum / (RINGS * RAYS);
}

/** The visible normal above a point of the unit disk [Heitz 2018]; the view lies in the plane y = 0. */
function visibleNormal(alpha: number, view: Vector, px: number, py: number): Vector {
  const length = Math.hypot(alpha * view.x, view.z);
  const vx = (alpha * view.x) / length;
  const vz = view.z / length;
  const share = (1 + vz) / 2;
  const halfChord = Math.sqrt(Math.max(0, 1 - px * px));
  const y = (1 - share) * halfChord + share * py;
  const z = Math.sqrt(Math.max(0, 1 - px * px - y * y));
  // Along t1 = (0, 1, 0) and t2 = view x t1; the sides of y do not matter to means over them.
  return normalized({ x: alpha * (-vz * y + vx * z), y: alpha * px, z: Math.max(vx * y + vz * z, 1e-12) });
}

function passing(alpha: number, view: Vector, out: Vector): number {
  const stretched = (v: Vector) => Math.sqrt(v.z * v.z + alpha * alpha * (v.x * v.x + v.y * v.y));
  const [a, b] = [stretched(view), stretched(out)];
  return (out.z * (view.z + a)) / (out.z * a + view.z * b);
}

function reflected(view: Vector, normal: Vector): Vector {
  const twice = 2 * dot(view, normal);
  return { x: twice * normal.x - view.x, y: twice * normal.y - view.y, z: twice * normal.z - view.z };
}

function dot(a: Vector, b: Vector): number {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

function normalized(v: Vector): Vector {
  const length = Math.hypot(v.x, v.y, v.z);
  return { x: v.x / length, y: v.y / length, z: v.z / length };
}
