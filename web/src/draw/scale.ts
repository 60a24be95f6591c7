// Scales of false colours with round ends and labels, as `stilb falsecolor` chooses them.

const SLACK = 1e-6;
const ROUND = [1, 2, 5];
const MOST_DECADES = 4;

export interface Scale {
  logarithmic: boolean;
  low: number;
  high: number;
}

export interface Tick {
  value: number;
  label: string;
}

/** The smallest of 1, 2, 5 times a power of ten that is not below `least`. */
function niceStep(least: number): number {
  const exponent = Math.floor(Math.log10(least));
  const mantissa = ROUND.find((m) => m * 10 ** exponent >= least * (1 - SLACK)) ?? 10;
  return round(mantissa * 10 ** exponent);
}

/** Without the digits that powers of ten add by rounding. */
function round(value: number): number {
  return Number(value.toPrecision(12));
}

export function niceScale(logarithmic: boolean, low: number, high: number): Scale {
  if (!logarithmic) {
    if (!(high > low)) [low, high] = [0, high > 0 ? high : 1];
    const step = niceStep((high - low) / 8);
    return {
      logarithmic,
      low: round(step * Math.floor(low / step + SLACK)),
      high: round(step * Math.ceil(high / step - SLACK)),
    };
  }
  if (!(high > 0)) return { logarithmic, low: 1, high: 10 };
  const top = niceStep(high);
  const bottom = 1 / niceStep(1 / Math.max(low, high * 10 ** -MOST_DECADES));
  return { logarithmic, low: round(Math.max(bottom, top * 10 ** -MOST_DECADES)), high: top };
}

export function fractionOf(scale: Scale, value: number): number {
  if (!scale.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  return value > 0 ? Math.log(value / scale.low) / Math.log(scale.high / scale.low) : -Infinity;
}

/** Labelled values of the scale: steps of 1, 2 or 5; on logarithmic scales 1, 2 and 5 in each decade. */
export function ticksOf(scale: Scale, most: number): Tick[] {
  if (scale.logarithmic) return logarithmicTicks(scale, most);
  const step = niceStep((scale.high - scale.low) / Math.max(most - 1, 1));
  const ticks: Tick[] = [];
  for (let i = Math.ceil(scale.low / step - SLACK); i <= Math.floor(scale.high / step + SLACK); ++i) {
    ticks.push(tick(round(i * step)));
  }
  return ticks;
}

function logarithmicTicks(scale: Scale, most: number): Tick[] {
  const first = Math.floor(Math.log10(scale.low)) - 1;
  const last = Math.ceil(Math.log10(scale.high)) + 1;
  const within = (mantissas: number[], stride: number) => {
    const values: number[] = [];
    for (let exponent = first; exponent <= last; ++exponent) {
      if (exponent % stride === 0) values.push(...mantissas.map((m) => round(m * 10 ** exponent)));
    }
    return values.filter((v) => v >= scale.low * (1 - SLACK) && v <= scale.high * (1 + SLACK));
  };
  let chosen = within(ROUND, 1);
  for (let stride = 1; chosen.length > most && stride < 8; ++stride) chosen = within([1], stride);
  return chosen.map(tick);
}

function tick(value: number): Tick {
  return { value, label: numberText(value) };
}

/** Short, with thin spaces between thousands and without a power of ten where it can be. */
export function numberText(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(0).replace("e+", "e");
  const text = String(round(value));
  const [whole, decimals] = text.split(".");
  if (whole!.length < 5) return text;
  const grouped = whole!.replace(/\B(?=(\d{3})+$)/g, "\u202f");
  return decimals ? `${grouped}.${decimals}` : grouped;
}
