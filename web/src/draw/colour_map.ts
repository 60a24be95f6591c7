// The colours of false-colour pictures: the same curve through OKLab as that of `stilb falsecolor`.

const SAMPLES = 257;
const PIECES = 32 * (SAMPLES - 1);

type Oklab = [number, number, number];

/** Lightness, chroma, hue in degrees. */
const KNOTS: [number, number, number][] = [
  [0.13, 0.035, 280],
  [0.34, 0.155, 290],
  [0.55, 0.2, 358],
  [0.76, 0.15, 60],
  [0.97, 0.07, 105],
];

const POINTS: Oklab[] = KNOTS.map(([lightness, chroma, degrees]) => {
  const hue = (degrees * Math.PI) / 180;
  return [lightness, chroma * Math.cos(hue), chroma * Math.sin(hue)];
});

function combine(s: number, x: Oklab, t: number, y: Oklab): Oklab {
  return [s * x[0] + t * y[0], s * x[1] + t * y[1], s * x[2] + t * y[2]];
}

/** Cubic through the knots (Catmull-Rom; straight beyond the ends), parameter 0 to 1. */
function curveAt(parameter: number): Oklab {
  const place = parameter * (POINTS.length - 1);
  const i = Math.min(Math.floor(place), POINTS.length - 2);
  const t = place - i;
  const from = POINTS[i]!;
  const to = POINTS[i + 1]!;
  const before = POINTS[i - 1] ?? combine(2, from, -1, to);
  const after = POINTS[i + 2] ?? combine(2, to, -1, from);
  const ends = combine((1 + 2 * t) * (1 - t) * (1 - t), from, t * t * (3 - 2 * t), to);
  const leave = (t * (1 - t) * (1 - t)) / 2;
  const arrive = (t * t * (t - 1)) / 2;
  const slopes = combine(leave, combine(1, to, -1, before), arrive, combine(1, after, -1, from));
  return combine(1, ends, 1, slopes);
}

/** Colours at equal distances along the curve, both ends included. */
function evenSamples(): Oklab[] {
  const points = Array.from({ length: PIECES + 1 }, (_, i) => curveAt(i / PIECES));
  const lengths = new Float64Array(PIECES + 1);
  for (let i = 1; i <= PIECES; ++i) {
    const [a, b] = [points[i - 1]!, points[i]!];
    lengths[i] = lengths[i - 1]! + Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  let i = 0;
  return Array.from({ length: SAMPLES }, (_, sample) => {
    const wanted = (lengths[PIECES]! * sample) / (SAMPLES - 1);
    while (i + 2 < lengths.length && lengths[i + 1]! < wanted) ++i;
    const t = (wanted - lengths[i]!) / (lengths[i + 1]! - lengths[i]!);
    return combine(1 - t, points[i]!, t, points[i + 1]!);
  });
}

function encoded(linear: number): number {
  const value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(Math.max(value, 0), 1));
}

/** [Ottosson 2020, A perceptual color space for image processing] */
function toSrgb([lightness, a, b]: Oklab): [number, number, number] {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s),
  ];
}

/** sRGB of each sample, from the least to the most. */
export const COLOUR_MAP: [number, number, number][] = evenSamples().map(toSrgb);
