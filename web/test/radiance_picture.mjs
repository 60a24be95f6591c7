// Reads the Radiance pictures of `stilb render`: luminances in cd/m2, rounded to 1/256 of a pixel's largest component.

/** {width, height, luminances, row by row}. */
export function readRadiancePicture(file) {
  const end = file.indexOf("\n\n") + 2;
  const line = file.toString("latin1", end, file.indexOf("\n", end));
  const [, height, width] = /^-Y (\d+) \+X (\d+)$/.exec(line).map(Number);
  let at = end + line.length + 1;
  const luminances = new Float64Array(width * height);
  for (let y = 0; y < height; ++y) {
    at += 4;
    const planes = [0, 1, 2, 3].map(() => {
      const values = new Uint8Array(width);
      for (let x = 0; x < width;) {
        const count = file[at++];
        if (count > 128) {
          values.fill(file[at++], x, x + count - 128);
          x += count - 128;
        } else {
          values.set(file.subarray(at, at + count), x);
          at += count;
          x += count;
        }
      }
      return values;
    });
    for (let x = 0; x < width; ++x) {
      const [r, g, b, exponent] = planes.map((plane) => plane[x]);
      const unit = exponent ? 2 ** (exponent - 136) : 0;
      // Radiance's luminance; its pictures truncate, hence the halves.
      luminances[y * width + x] = 179 * unit * (0.265 * (r + 0.5) + 0.67 * (g + 0.5) + 0.065 * (b + 0.5));
    }
  }
  return { width, height, luminances };
}
