// The tables of rough surfaces that the program computes by visible normals, here by a sum over directions.
const CELLS = 128;
const STEPS = 64;

/** Fresnel's reflectance of unpolarised light. */
function fresnel(cosine, ior) {
  const refracted = Math.sqrt(Math.max(0, 1 - (1 - cosine ** 2) / ior ** 2));
  const across = (cosine - ior * refracted) / (cosine + ior * refracted);
  const along = (ior * cosine - refracted) / (ior * cosine + refracted);
  return (across ** 2 + along ** 2) / 2;
}

/** The share of light that facets after GGX reflect once: white ones, or those of a coat of this index. */
function albedo(alpha, ior, cosine) {
  const view = [Math.sqrt(1 - cosine ** 2), 0, cosine];
  const stretched = (c) => Math.sqrt(c ** 2 + alpha ** 2 * (1 - c ** 2));
  let sum = 0;
  for (let i = 0; i < STEPS; ++i) {
    // Even in the square of the sine: each direction has the same projected solid angle.
    const sine = Math.sqrt((i + 0.5) / STEPS);
    const z = Math.sqrt(1 - sine ** 2);
    for (let j = 0; j < STEPS; ++j) {
      const phi = (Math.PI * (j + 0.5)) / STEPS;
      const half = [sine * Math.cos(phi) + view[0], sine * Math.sin(phi), z + view[2]];
      const length = Math.hypot(...half);
      const normal = half.map((x) => x / length);
      const spread = (1 - normal[2] ** 2) / alpha ** 2 + normal[2] ** 2;
      const density = 1 / (Math.PI * alpha ** 2 * spread ** 2);
      const share = ior === undefined ? 1 : fresnel(length / 2, ior);
      sum += (share * density) / (2 * (cosine * stretched(z) + z * stretched(cosine)));
    }
  }
  return (sum * Math.PI) / STEPS ** 2;
}

/** 1 - albedo() by the cosine. `ior`: undefined for white facets. */
export function facetTable(alpha, ior) {
  const cells_per_log = CELLS / Math.log1p(1 / alpha);
  const cosines = Array.from({ length: CELLS + 1 }, (_, i) => Math.min(alpha * Math.expm1(i / cells_per_log), 1));
  const values = cosines.map((cosine) => 1 - albedo(alpha, ior, Math.max(cosine, 1e-3)));
  let average = 0;
  for (let i = 0; i < CELLS; ++i) average += ((values[i] + values[i + 1]) / 2) * (cosines[i + 1] ** 2 - cosines[i] ** 2);
  return { values, cells_per_log, average };
}
