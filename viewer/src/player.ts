// The clock of the playback: time, speed, loop. It asks for animation frames only while it plays.
//
// The time that is wanted is kept when the recording does not reach it, so that a run that starts again comes back to
// the instant that was looked at.

import type { Recording } from "./data/recording";
import { lowerBound } from "./math/thin";

/** How long the whole should take to look at [s]. */
const SHORTEST = 3;
const LONGEST = 20;
/** What takes no longer to look at is played again and again [s]. */
const LOOPED = 10;
/** Speeds that can be chosen whatever is shown. */
const USUAL: [number, number] = [0.01, 10];
/** Decades of speeds. */
const DECADES: [number, number] = [-15, 9];
/** Samples a second below which playing goes on between samples. */
const SMOOTH_BELOW = 30;

/** 1, 2 and 5 of every decade. */
const LADDER: number[] = [];
for (let decade = DECADES[0]; decade <= DECADES[1]; decade++) {
  for (const lead of [1, 2, 5]) LADDER.push(Number(`${lead}e${decade}`));
}

/** The speed nearest to one at which so much time takes a bearable while. */
export function fittingSpeed(duration: number): number {
  if (!(duration > 0)) return 1;
  const byDistance = [...LADDER].sort((a, b) => Math.abs(Math.log(a)) - Math.abs(Math.log(b)) || a - b);
  const lasts = (speed: number) => duration / speed;
  const fits = byDistance.find((speed) => lasts(speed) >= SHORTEST && lasts(speed) <= LONGEST);
  return fits ?? LADDER[lasts(1) < SHORTEST ? 0 : LADDER.length - 1];
}

/** The speeds to choose from: the usual ones, and those within ten times the fitting one. */
export function speedsFor(duration: number): number[] {
  const fitting = fittingSpeed(duration);
  const low = Math.min(USUAL[0], fitting / 10) * (1 - 1e-9);
  const high = Math.max(USUAL[1], 10 * fitting) * (1 + 1e-9);
  return LADDER.filter((speed) => speed >= low && speed <= high);
}

/** Whether so much time is so short to look at that it is played again and again. */
export function loops(duration: number): boolean {
  return duration > 0 && duration / fittingSpeed(duration) <= LOOPED;
}

export class Player {
  playing = false;
  loop = false;
  speed = 1;
  /** How long the whole takes, as far as that is known [s]. */
  duration = 0;
  /** Whether the reader stays at an instant within the recording. */
  holds = false;
  /** The time that is wanted [s]. */
  wanted = 0;
  /** Called when what is to be shown has changed; while playing with the duration of the last frame [ms]. */
  changed: (frameTook: number | null) => void = () => {};
  private recording: Recording | null = null;
  private last = 0;
  private request = 0;
  private choseSpeed = false;
  private choseLoop = false;

  /** Another recording, from its start; the time stays where it was if the reader stopped within the one before. */
  load(recording: Recording): void {
    const before = this.recording?.lastTime ?? 0;
    this.holds = !this.playing && this.wanted > 0 && this.wanted < before;
    this.recording = recording;
    if (!this.holds) this.wanted = 0;
    this.fit();
    this.changed(null);
  }

  /** Fits speed and loop to how long the whole takes, unless the reader has chosen them. */
  fit(): void {
    const { recording } = this;
    if (!recording) return;
    const { end, rows } = recording.header;
    this.duration =
      recording.isOver && recording.rows >= rows ? recording.lastTime : end || recording.lastTime;
    if (!this.choseSpeed) this.speed = fittingSpeed(this.duration);
    if (!this.choseLoop) this.loop = loops(this.duration);
  }

  chooseSpeed(speed: number): void {
    this.speed = speed;
    this.choseSpeed = true;
  }

  toggleLoop(): void {
    this.loop = !this.loop;
    this.choseLoop = true;
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
    if (this.time >= recording.lastTime && recording.isOver) this.wanted = 0;
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

  /** Stays at a time, also one that the recording has not reached [s]. */
  hold(time: number): void {
    this.pause();
    this.wanted = Math.max(0, time);
    this.holds = true;
    // A run that is over does not come there.
    if (this.recording && (time <= this.recording.lastTime || this.recording.isOver)) this.seek(time);
    else this.changed(null);
  }

  /** Goes to the end and stays there; of a run that goes on, to what has come last. */
  toEnd(): void {
    if (this.recording?.isOver) this.pause();
    this.seek(Number.POSITIVE_INFINITY);
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
      if (!recording.isOver) {
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
