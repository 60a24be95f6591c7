/** Of linear Rec. 709. */
export function luminance(rgb: ArrayLike<number>, at = 0): number {
  return 0.2126 * rgb[at]! + 0.7152 * rgb[at + 1]! + 0.0722 * rgb[at + 2]!;
}
