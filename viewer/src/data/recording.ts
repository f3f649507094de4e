// A recording in memory: the header, growing columns of numbers, surfaces, events.
//
// Time is f64, everything else f32, row after row. Rows are only ever added at the end; whoever draws asks
// `generation` and `rows` whether there is something new.

import type { Fields } from "./fields";
import type { ArraySpec, Header } from "./header";
import type { Network } from "./network";

export interface Surface {
  /** Relative to the centre of mass in the reference placement [m], three a point. */
  points: Float32Array;
  /** Outward, counter-clockwise; three indices a triangle. */
  triangles: Uint32Array;
}

export interface RunEvent {
  time: number;
  kind: string;
  body: string | null;
}

/** One array of the recording: `stride` numbers a row. */
export class Track {
  values: Float32Array = new Float32Array(0);
  constructor(readonly spec: ArraySpec) {}

  get stride(): number {
    return this.spec.stride;
  }

  /** The numbers of one body: `stride / bodies` of them. */
  widthOf(bodies: number): number {
    return this.stride / bodies;
  }

  /** Whether it has a number a body at least: its first dimension is the body. */
  get perBody(): boolean {
    return this.spec.dims[0]?.[0] === "body";
  }
}

export class Recording {
  readonly tracks = new Map<string, Track>();
  readonly surfaces: (Surface | undefined)[] = [];
  time: Float64Array = new Float64Array(0);
  rows = 0;
  events: RunEvent[] = [];
  /** The forces between bodies; `null` where the source cannot tell them. */
  network: Network | null = null;
  /** The fields of its bodies; `null` where the source cannot tell them. */
  fields: Fields | null = null;

  constructor(public header: Header) {
    for (const spec of header.arrays) this.tracks.set(spec.name, new Track(spec));
  }

  track(name: string): Track | undefined {
    return this.tracks.get(name);
  }

  /** Whether no row will come: the run has ended, or what a report holds of it is all there is. */
  get isOver(): boolean {
    return this.header.complete || this.header.mode === "report";
  }

  /** The last time that is there [s]. */
  get lastTime(): number {
    return this.rows > 0 ? this.time[this.rows - 1] : 0;
  }

  /** Takes rows `first …` in; rows that are there already are overwritten. */
  put(first: number, time: Float64Array, values: Float32Array[]): void {
    if (first > this.rows) throw new Error(`Rows ${this.rows} to ${first} are missing.`);
    const rows = first + time.length;
    this.reserve(rows);
    this.time.set(time, first);
    let index = 0;
    for (const track of this.tracks.values()) track.values.set(values[index++], first * track.stride);
    this.rows = Math.max(this.rows, rows);
  }

  /** The last row that is not after `t`; 0 before the first. */
  rowAt(t: number): number {
    let low = 0;
    let high = this.rows - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.time[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return Math.max(low, 0);
  }

  /** The row whose time is nearest to `t`. */
  rowNear(t: number): number {
    const row = this.rowAt(t);
    const next = Math.min(row + 1, this.rows - 1);
    return next > row && this.time[next] - t < t - this.time[row] ? next : row;
  }

  setEvents(numbers: Float64Array): void {
    this.events = [];
    const { event_kinds: kinds, bodies } = this.header;
    for (let at = 0; at + 2 < numbers.length; at += 3) {
      const [time, kind, body] = numbers.subarray(at, at + 3);
      this.events.push({ time, kind: kinds[kind] ?? "event", body: bodies[body]?.name ?? null });
    }
  }

  private reserve(rows: number): void {
    if (rows <= this.time.length) return;
    const room = Math.max(rows, this.rows === 0 ? rows : 2 * this.time.length, 16);
    this.time = grown(this.time, new Float64Array(room));
    for (const track of this.tracks.values()) {
      track.values = grown(track.values, new Float32Array(room * track.stride));
    }
  }
}

function grown<A extends Float32Array | Float64Array>(old: A, room: A): A {
  room.set(old);
  return room;
}
