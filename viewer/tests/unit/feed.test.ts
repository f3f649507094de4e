// Messages of a run, made into a recording and told.

import { describe, expect, it } from "vitest";
import { Feed } from "../../src/data/feed";
import type { Recording } from "../../src/data/recording";
import { headerOf, Told } from "./made";

const HEADER = headerOf({
  mode: "live",
  run: 2,
  complete: false,
  outcome: null,
  arrays: [{ name: "height", units: "m", description: "", dims: [], stride: 1 }],
});

/** A binary message: what it is, and its numbers. */
function packed(announced: object, time: number[], values: number[]): ArrayBuffer {
  const text = JSON.stringify(announced);
  const length = 8 * Math.ceil((4 + text.length) / 8) - 4;
  const bytes = new Uint8Array(4 + length + 8 * time.length + 4 * values.length);
  new DataView(bytes.buffer).setUint32(0, length, true);
  bytes.set(new TextEncoder().encode(text.padEnd(length)), 4);
  bytes.set(new Uint8Array(Float64Array.from(time).buffer), 4 + length);
  bytes.set(new Uint8Array(Float32Array.from(values).buffer), 4 + length + 8 * time.length);
  return bytes.buffer;
}

function rows(run: number, first: number, time: number[], values: number[]): ArrayBuffer {
  return packed({ kind: "rows", run, first, rows: time.length }, time, values);
}

describe("messages of a run", () => {
  it("begin_with_the_first_row_grow_and_end_with_the_hash", () => {
    const told = new Told();
    const feed = new Feed(told);
    feed.take(JSON.stringify({ type: "header", header: HEADER }));
    expect(told.calls).toEqual([]);
    feed.take(rows(2, 0, [0], [4]));
    feed.take(rows(2, 1, [0.5, 1], [3, 2]));
    feed.take(packed({ kind: "blob", run: 2, name: "events" }, [0.5, 1, 0], []));
    const done = {
      type: "done",
      outcome: "completed",
      summary: { ledger: "closed" },
      hash: "0123456789abcdef",
    };
    feed.take(JSON.stringify(done));
    expect(told.calls).toEqual(["begun", "grew", "grew", "done completed closed 0123456789abcdef"]);
    const recording = told.recording as Recording;
    expect([...recording.time.slice(0, recording.rows)]).toEqual([0, 0.5, 1]);
    expect([...(recording.track("height")?.values.slice(0, 3) ?? [])]).toEqual([4, 3, 2]);
    expect(recording.events).toEqual([{ time: 0.5, kind: "closest_approach", body: "a" }]);
    expect(recording.isOver).toBe(true);
  });

  it("of_another_run_are_left_out", () => {
    const told = new Told();
    const feed = new Feed(told);
    feed.take(rows(2, 0, [0], [4]));
    feed.take(JSON.stringify({ type: "header", header: HEADER }));
    feed.take(rows(1, 0, [0], [4]));
    expect(told.calls).toEqual([]);
    feed.take(JSON.stringify({ type: "header", header: { ...HEADER, protocol: 99 } }));
    expect(told.calls).toEqual([expect.stringContaining("different versions")]);
  });

  it("tell_a_halt_with_how_far_the_run_was", () => {
    const told = new Told();
    const feed = new Feed(told);
    feed.halted(true);
    const progress = { time: 1, end: 2, steps: 3, step: 0.1, paused: false, limited_by: "" };
    feed.take(JSON.stringify({ type: "progress", ...progress }));
    feed.halted(true);
    expect(told.calls).toEqual(["progress 1 running", "progress 1 paused"]);
  });
});
