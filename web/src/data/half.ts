// Numbers of half precision (IEEE 754 binary16).

function decode(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** The value of every half, by its bits. */
export const floatFromHalf: Float32Array = Float32Array.from({ length: 65536 }, (_, bits) => decode(bits));
