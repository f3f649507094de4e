// Recordings in memory: rows, search, messages of a live run, frames, thinning, ledger.

import { describe, expect, it } from "vitest";
import { rowsOf, unpacked } from "../../src/data/feed";
import { Frame } from "../../src/data/frame";
import { Recording } from "../../src/data/recording";
import { lowerBound, thinned } from "../../src/math/thin";
import { books, openLedgerInWords, residualInWords } from "../../src/ui/ledger";
import { headerOf, scalars } from "./made";

describe("a recording", () => {
  it("grows_by_portions_and_finds_rows_by_time", () => {
    const recording = scalars([0], { a: [10] });
    recording.put(1, Float64Array.of(0.1, 0.2, 0.3), [Float32Array.of(11, 12, 13)]);
    expect(recording.rows).toBe(4);
    expect(Array.from(recording.track("a")!.values.subarray(0, 4))).toEqual([10, 11, 12, 13]);
    expect([-1, 0, 0.1, 0.19, 5].map((t) => recording.rowAt(t))).toEqual([0, 0, 1, 1, 3]);
    expect([0.04, 0.06, 0.26].map((t) => recording.rowNear(t))).toEqual([0, 1, 3]);
  });

  it("refuses_rows_that_leave_a_hole", () => {
    const recording = scalars([0], { a: [10] });
    expect(() => recording.put(3, Float64Array.of(1), [Float32Array.of(1)])).toThrow(/missing/);
  });

  it("names_the_kinds_and_bodies_of_events", () => {
    const recording = scalars([0], {});
    recording.setEvents(Float64Array.of(0.5, 1, 0, 0.7, 0, -1));
    expect(recording.events).toEqual([
      { time: 0.5, kind: "closest_approach", body: "a" },
      { time: 0.7, kind: "apex", body: null },
    ]);
  });
});

describe("a message of a live run", () => {
  it("is_taken_apart_into_text_and_numbers", () => {
    const announced = JSON.stringify({ kind: "rows", run: 2, first: 5, rows: 2 });
    const padded = announced.padEnd(announced.length + ((8 - ((4 + announced.length) % 8)) % 8));
    const payload = new ArrayBuffer(8 * 2 + 4 * 2 + 4 * 6);
    new Float64Array(payload, 0, 2).set([0.1, 0.2]);
    new Float32Array(payload, 16, 2).set([1, 2]);
    new Float32Array(payload, 24, 6).set([1, 2, 3, 4, 5, 6]);
    const message = new Uint8Array(4 + padded.length + payload.byteLength);
    new DataView(message.buffer).setUint32(0, padded.length, true);
    message.set(new TextEncoder().encode(padded), 4);
    message.set(new Uint8Array(payload), 4 + padded.length);

    const taken = unpacked(message.buffer);
    expect(taken.announced).toEqual({ kind: "rows", run: 2, first: 5, rows: 2 });
    const [time, [scalar, vector]] = rowsOf(taken.payload, 2, [1, 3]);
    expect(Array.from(time)).toEqual([0.1, 0.2]);
    expect(Array.from(scalar)).toEqual([1, 2]);
    expect(Array.from(vector)).toEqual([1, 2, 3, 4, 5, 6]);
  });
});

describe("a frame", () => {
  const moving = (turned: number[]) => {
    const array = (name: string, stride: number) => ({ name, units: "", description: "", dims: [], stride });
    const recording = new Recording(
      headerOf({ arrays: [array("position", 3), array("placement_gradient", 9)] }),
    );
    const gradient = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, ...turned);
    recording.put(0, Float64Array.of(0, 1), [Float32Array.of(0, 0, 0, 2, 0, 0), gradient]);
    return recording;
  };

  it("shows_samples_unless_it_plays_slowly", () => {
    const recording = moving([1.2, 0, 0, 0, 1, 0, 0, 0, 1]);
    const frame = new Frame();
    frame.take(recording, 0.5, false);
    expect(frame.position[0]).toBe(0);
    frame.take(recording, 0.5, true);
    expect(frame.position[0]).toBe(1);
    expect(frame.gradient[0]).toBeCloseTo(1.1, 6);
  });

  it("does_not_join_samples_between_which_a_body_turns_far", () => {
    const frame = new Frame();
    frame.take(moving([-1, 0, 0, 0, -1, 0, 0, 0, 1]), 0.5, true);
    expect(frame.gradient[0]).toBe(1);
    expect(frame.position[0]).toBe(0);
  });
});

describe("thinning", () => {
  it("keeps_every_extreme_and_the_ends", () => {
    const rows = 100_000;
    const time = Float64Array.from({ length: rows }, (_, k) => k);
    const values = new Float32Array(rows);
    values[54_321] = 7;
    values[54_322] = -7;
    values[rows - 1] = 1;
    const table = thinned(time, [0, rows - 1], (_, row) => values[row], { series: 1, columns: 300 });
    expect(table[0].length).toBe(600);
    expect(Math.max(...(table[1] as number[]))).toBe(7);
    expect(Math.min(...(table[1] as number[]))).toBe(-7);
    expect(table[0].at(-1)).toBe(rows - 1);
    expect(table[1].at(-1)).toBe(1);
    for (let k = 1; k < 600; k++) expect(table[0][k]!).toBeGreaterThanOrEqual(table[0][k - 1]!);
  });

  it("shows_what_is_not_finite_as_a_hole", () => {
    const values = [1, Number.NaN, Number.POSITIVE_INFINITY, 4];
    const table = thinned([0, 1, 2, 3], [0, 3], (_, row) => values[row], { series: 1, columns: 10 });
    expect(table[1]).toEqual([1, null, null, 4]);
  });

  it("finds_the_first_row_not_before_a_time", () => {
    expect([-1, 0, 0.5, 2, 9].map((t) => lowerBound([0, 1, 2], 3, t))).toEqual([0, 0, 1, 2, 3]);
  });
});

describe("the ledger", () => {
  const recording = scalars([0, 1], {
    energy_kinetic: [0, 1],
    energy_gravity: [3, 1],
    work_damping: [0, -1],
    energy_residual: [0, 1e-9],
  });

  it("adds_energies_and_lists_works", () => {
    const seen = books(recording)!;
    expect(seen.sum).toEqual({ name: "sum", start: 3, end: 2 });
    expect(seen.works).toEqual([{ name: "damping", value: -1 }]);
    expect(seen.inPlay).toBe(1);
  });

  it("tells_the_residual_beside_the_energy_in_play", () => {
    expect(residualInWords(books(recording)!)).toContain("1.0e−9 of the energy in play (1 J)");
  });

  it("is_told_if_it_is_open", () => {
    const summary = { ledger: "open" as const, largest_residual: 0.5, energy_in_play: 2 };
    expect(openLedgerInWords(headerOf({ summary }))).toBe(
      "Energy ledger open: residual 500 mJ, energy in play 2 J. Do not trust the run.",
    );
    expect(openLedgerInWords(headerOf({ summary: { ...summary, ledger: "closed" } }))).toBeNull();
    expect(openLedgerInWords(headerOf())).toBeNull();
  });

  it("calls_rounding_by_its_name", () => {
    const seen = books(recording)!;
    expect(residualInWords({ ...seen, residual: 1e-16, largest: 1e-16 })).toContain(
      "the rounding of the energies",
    );
  });
});
