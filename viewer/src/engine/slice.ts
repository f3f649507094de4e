// The evaluations that are asked of the engine at once: so many that the worker hears the page every few milliseconds.

/** Duration aimed at for a slice [ms]. */
export const SLICE_MS = 10;
const FIRST = 16;
const MOST = 2 ** 30;
/** The most by which a slice is longer than the one before: the engine gets faster while the browser compiles it. */
const GROWTH = 2;
/** The most by which it is shorter, as where bodies begin to touch. */
const SHRINKAGE = 8;

export class Slice {
  evaluations = FIRST;

  /** Adapts to how long the last one took [ms]; a clock may be too coarse to tell. */
  took(ms: number): void {
    const factor = Math.min(GROWTH, Math.max(1 / SHRINKAGE, SLICE_MS / Math.max(ms, 0)));
    this.evaluations = Math.min(MOST, Math.max(1, Math.round(factor * this.evaluations)));
  }
}
