// What is shown at an instant: the placement p, P of every body, taken from a sample or, for slow motion only, from
// the straight line between two.

import type { Recording } from "./recording";

/** Entries of P may differ by this much between samples that are joined by a straight line: about 20 degrees. */
const JOINED_BELOW = 0.35;

export class Frame {
  time = 0;
  /** The sample that is shown, or the one before the instant. */
  row = 0;
  /** Centres of mass [m], three a body. */
  position = new Float32Array(0);
  /** P, row-major, nine a body. */
  gradient = new Float32Array(0);

  /** Takes the last sample up to `time`; with `smooth`, goes on from it towards the next. */
  take(recording: Recording, time: number, smooth: boolean): void {
    const position = recording.track("position")?.values ?? this.position;
    const gradient = recording.track("placement_gradient")?.values ?? this.gradient;
    const bodies = recording.header.bodies.length;
    const row = recording.rowAt(time);
    this.row = row;
    this.time = smooth ? time : recording.rows > 0 ? recording.time[row] : 0;
    this.position = position.slice(3 * bodies * row, 3 * bodies * (row + 1));
    this.gradient = gradient.slice(9 * bodies * row, 9 * bodies * (row + 1));
    if (!smooth || row + 1 >= recording.rows) return;
    const part = (time - recording.time[row]) / (recording.time[row + 1] - recording.time[row]);
    if (!(part > 0 && part <= 1)) return;
    for (let body = 0; body < bodies; body++) {
      const next = 9 * (bodies * (row + 1) + body);
      if (this.spread(gradient, 9 * body, next) > JOINED_BELOW) continue;
      blend(this.gradient, 9 * body, gradient.subarray(next, next + 9), part);
      const at = 3 * (bodies * (row + 1) + body);
      blend(this.position, 3 * body, position.subarray(at, at + 3), part);
    }
  }

  private spread(gradient: Float32Array, here: number, next: number): number {
    let most = 0;
    for (let k = 0; k < 9; k++) most = Math.max(most, Math.abs(gradient[next + k] - this.gradient[here + k]));
    return most;
  }
}

function blend(into: Float32Array, at: number, other: Float32Array, part: number): void {
  for (let k = 0; k < other.length; k++) into[at + k] += part * (other[k] - into[at + k]);
}
