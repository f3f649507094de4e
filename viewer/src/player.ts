// The clock of the playback: time, speed, loop. It asks for animation frames only while it plays.
//
// The time that is wanted is kept when the recording does not reach it, so that a run that starts again comes back to
// the instant that was looked at.

import type { Recording } from "./data/recording";
import { lowerBound } from "./math/thin";

export const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

/** How long the whole should take to look at [s]. */
const SHORTEST = 3;
const LONGEST = 20;
/** Samples a second below which playing goes on between samples. */
const SMOOTH_BELOW = 30;

/** The speed nearest to one at which so much time takes a bearable while. */
export function fittingSpeed(duration: number): number {
  if (!(duration > 0)) return 1;
  const byDistance = [...SPEEDS].sort((a, b) => Math.abs(Math.log(a)) - Math.abs(Math.log(b)) || a - b);
  const lasts = (speed: number) => duration / speed;
  const fits = byDistance.find((speed) => lasts(speed) >= SHORTEST && lasts(speed) <= LONGEST);
  return fits ?? (lasts(1) < SHORTEST ? SPEEDS[0] : SPEEDS[SPEEDS.length - 1]);
}

export class Player {
  playing = false;
  loop = false;
  speed = 1;
  /** The time that is wanted [s]. */
  wanted = 0;
  /** Called when what is to be shown has changed; while playing with the duration of the last frame [ms]. */
  changed: (frameTook: number | null) => void = () => {};
  private recording: Recording | null = null;
  private last = 0;
  private request = 0;

  /** Another recording; the time stays where it was if paused. */
  load(recording: Recording, fresh: boolean): void {
    this.recording = recording;
    if (fresh) this.speed = fittingSpeed(recording.header.end || recording.lastTime);
    if (fresh || this.playing) this.wanted = 0;
    this.changed(null);
  }

  /** The time that is shown [s]. */
  get time(): number {
    return Math.min(this.wanted, this.recording?.lastTime ?? 0);
  }

  /** Whether what is shown may lie between samples. */
  get smooth(): boolean {
    const { recording } = this;
    if (!this.playing || !recording || recording.rows < 2) return false;
    const spacing = recording.lastTime / (recording.rows - 1);
    return this.speed / spacing < SMOOTH_BELOW;
  }

  play(): void {
    const { recording } = this;
    if (this.playing || !recording) return;
    if (this.time >= recording.lastTime && recording.header.complete) this.wanted = 0;
    this.wanted = this.time;
    this.playing = true;
    this.last = performance.now();
    this.request = requestAnimationFrame((now) => this.tick(now));
    this.changed(null);
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.request);
    // Only samples are shown at rest.
    this.seek(this.time);
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Goes to the sample nearest to a time [s]; the time itself while playing. */
  seek(time: number): void {
    const { recording } = this;
    if (!recording || recording.rows === 0) return;
    const within = Math.min(Math.max(0, time), recording.lastTime);
    this.wanted = this.playing ? within : recording.time[recording.rowNear(within)];
    this.last = performance.now();
    this.changed(null);
  }

  /** So many samples forward. */
  step(samples: number): void {
    const { recording } = this;
    if (!recording || recording.rows === 0) return;
    this.pause();
    const row = Math.min(recording.rows - 1, Math.max(0, recording.rowNear(this.time) + samples));
    this.seek(recording.time[row]);
  }

  /** To the next event, or the one before. */
  stepEvent(direction: 1 | -1): void {
    const { recording } = this;
    if (!recording || recording.events.length === 0) return;
    this.pause();
    const times = recording.events
      .map((event) => recording.time[recording.rowNear(event.time)])
      .sort((a, b) => a - b);
    const here = lowerBound(times, times.length, this.time);
    const next = direction < 0 ? times[here - 1] : times.find((time) => time > this.time);
    if (next !== undefined) this.seek(next);
  }

  private tick(now: number): void {
    const { recording } = this;
    if (!this.playing || !recording) return;
    // A frame is dated from its start, which may lie before a seek.
    const took = Math.max(0, now - this.last);
    this.last = now;
    // A page that slept does not leap.
    this.wanted += (this.speed * Math.min(took, 250)) / 1000;
    if (this.wanted >= recording.lastTime) {
      if (!recording.header.complete) {
        this.wanted = recording.lastTime;
      } else if (this.loop) {
        this.wanted = 0;
      } else {
        this.pause();
        return;
      }
    }
    this.changed(took);
    this.request = requestAnimationFrame((next) => this.tick(next));
  }
}
