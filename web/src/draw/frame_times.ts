// Times of frames, and the resolution that keeps a moving view fluent.

/** ms: 15 frames a second. */
const SLOWEST = 1000 / 15;
/** So much faster that the next finer resolution is fast enough, too. */
const ROOM = 0.55;
const SCALES = [1, 0.8, 0.65, 0.5, 0.4];
const REMEMBERED = 30;
/** Frames at one resolution before another is tried. */
const PATIENCE = 3;

export class FrameTimes {
  private readonly times: number[] = [];
  private level = 0;
  /** Whether pictures that move take fewer triangles, where there are such: once they must, they do. */
  isCoarse = false;
  private sinceChange = 0;
  private lastBegin: number | null = null;

  constructor(private readonly canBeCoarse: boolean) {}

  /** Of the full resolution, for the next moving frame. */
  get scale(): number {
    return SCALES[this.level]!;
  }

  begin(): number {
    return performance.now();
  }

  /** Frames that follow each other take the time between them, the browser's own work included. */
  end(begin: number, moves: boolean) {
    const drawing = performance.now() - begin;
    const time = this.lastBegin === null ? drawing : Math.max(drawing, begin - this.lastBegin);
    this.lastBegin = begin;
    this.times.push(time);
    if (this.times.length > REMEMBERED) this.times.shift();
    if (moves) this.adapt(drawing);
  }

  /** No frame follows the last one. */
  rest() {
    this.lastBegin = null;
  }

  /** Median of the last frames [ms]; 0 before the first. */
  median(): number {
    if (this.times.length === 0) return 0;
    const sorted = [...this.times].sort((a, b) => a - b);
    return sorted[Math.floor(sorted.length / 2)]!;
  }

  private adapt(time: number) {
    if (++this.sinceChange < PATIENCE) return;
    if (time > SLOWEST && this.canBeCoarse && !this.isCoarse) {
      this.isCoarse = true;
      this.sinceChange = 0;
    } else if (time > SLOWEST && this.level < SCALES.length - 1) this.change(1);
    else if (time < ROOM * SLOWEST && this.level > 0) this.change(-1);
  }

  private change(step: number) {
    this.level += step;
    this.sinceChange = 0;
  }
}
