// Recordings made by hand for the unit tests.

import type { Body, Header, Outcome, Summary } from "../../src/data/header";
import { Recording } from "../../src/data/recording";
import type { Listener, Progress } from "../../src/data/source";

export function bodyNamed(name: string, more: Partial<Body> = {}): Body {
  const euler_tensor = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  return { name, kind: "rigid", mass: 1, center: [0, 0, 0], euler_tensor, size: 1, surface: null, ...more };
}

export function headerOf(more: Partial<Header> = {}): Header {
  return {
    protocol: 1,
    mode: "report",
    run: 1,
    gravity: [0, 0, -10],
    bodies: [bodyNamed("a")],
    supports: [],
    surfaces: [],
    arrays: [],
    columns: [],
    event_kinds: ["apex", "closest_approach"],
    rows: 0,
    end: 1,
    complete: true,
    outcome: "completed",
    thinned: null,
    notes: [],
    ...more,
  };
}

/** A recording with scalars by name, one value a sample. */
export function scalars(
  time: number[],
  values: Record<string, number[]>,
  more: Partial<Header> = {},
): Recording {
  const arrays = Object.keys(values).map((name) => ({
    name,
    units: "J",
    description: "",
    dims: [],
    stride: 1,
  }));
  const recording = new Recording(headerOf({ arrays, rows: time.length, ...more }));
  recording.put(
    0,
    Float64Array.from(time),
    Object.values(values).map((column) => Float32Array.from(column)),
  );
  return recording;
}

/** A listener that writes down what it is told. */
export class Told implements Listener {
  readonly calls: string[] = [];
  recording: Recording | null = null;

  begun(recording: Recording): void {
    this.recording = recording;
    this.calls.push("begun");
  }
  grew(): void {
    this.calls.push("grew");
  }
  surfaced(): void {
    this.calls.push("surfaced");
  }
  progress({ time, paused }: Progress): void {
    this.calls.push(`progress ${time} ${paused ? "paused" : "running"}`);
  }
  done(outcome: Outcome | null, summary: Summary, hash?: string | null): void {
    this.calls.push(`done ${outcome} ${summary.ledger} ${hash}`);
  }
  failed(message: string, refused?: string[]): void {
    this.calls.push(`failed ${message}${refused ? ` of ${refused}` : ""}`);
  }
  lost(reason: string): void {
    this.calls.push(`lost ${reason}`);
  }
  found(): void {
    this.calls.push("found");
  }
}
