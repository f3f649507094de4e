// Numbers that follow from recorded ones, computed once a row and kept, since plots ask for them again and again.

import type { Recording } from "../data/recording";

interface Kept {
  rows: number;
  values: Float32Array;
}

const kept = new WeakMap<Recording, Map<string, Kept>>();

/** `width` numbers a row under a name; `compute` fills those of a row. Only rows that are new are computed. */
export function derived(
  recording: Recording,
  name: string,
  width: number,
  compute: (row: number) => ArrayLike<number>,
): Float32Array {
  const all = kept.get(recording) ?? new Map<string, Kept>();
  kept.set(recording, all);
  const known = all.get(name) ?? { rows: 0, values: new Float32Array(0) };
  all.set(name, known);
  const { rows } = recording;
  if (known.values.length < width * rows) {
    const room = new Float32Array(width * Math.max(rows, Math.ceil(1.5 * known.rows)));
    room.set(known.values);
    known.values = room;
  }
  for (let row = known.rows; row < rows; row++) known.values.set(compute(row), width * row);
  known.rows = rows;
  return known.values;
}
