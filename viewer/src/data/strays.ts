// Bodies that fly off: those whose ways reach far beyond where most bodies are. They are not to make all others small.
//
//   r_i = max |p_i − m| + ℓ_i/2 over the samples,   stray: r_i > 4 R,   R = the median of r_i, 3 ℓ at least
//
// m is the median place, component by component, ℓ the largest size. Where more than a third fly, that is the motion,
// and none is a stray. Strips on paper have the same strays.

import { norm } from "../math/mat3";
import type { Vec3 } from "./header";
import type { Recording } from "./recording";

const FAR = 4;
const LEAST_SIZES = 3;
/** Places that are looked at. */
const PLACES = 60_000;

export interface Strays {
  bodies: Set<number>;
  /** The median place [m]. */
  middle: Vec3;
  /** Places of a stray that are no farther from the middle are shown [m]. */
  radius: number;
}

/** The bodies of a recording that fly off. */
export function straysOf(recording: Recording): Strays {
  const { bodies } = recording.header;
  const count = bodies.length;
  const centers = recording.track("position")?.values;
  const none: Strays = { bodies: new Set(), middle: [0, 0, 0], radius: Number.POSITIVE_INFINITY };
  if (count < 2 || !centers || recording.rows === 0) return none;
  const every = Math.max(1, Math.ceil((count * recording.rows) / PLACES));
  const rows: number[] = [];
  for (let row = 0; row < recording.rows; row += every) rows.push(row);
  if (rows[rows.length - 1] !== recording.rows - 1) rows.push(recording.rows - 1);
  const at = (row: number, body: number) =>
    centers.subarray(3 * (row * count + body), 3 * (row * count + body) + 3);
  const middle = [0, 1, 2].map((axis) =>
    median(rows.flatMap((row) => bodies.map((_, body) => at(row, body)[axis]))),
  ) as Vec3;
  const reaches = bodies.map((body, index) => {
    const away = rows.map((row) => norm(Array.from(at(row, index), (value, axis) => value - middle[axis])));
    return away.filter(Number.isFinite).reduce((a, b) => Math.max(a, b), 0) + 0.5 * body.size;
  });
  const size = bodies.reduce((most, body) => Math.max(most, body.size), 0);
  const radius = Math.max(median(reaches), LEAST_SIZES * size);
  const far = reaches.flatMap((reach, body) => (reach > FAR * radius ? [body] : []));
  return far.length > Math.max(1, Math.floor(count / 3)) ? none : { bodies: new Set(far), middle, radius };
}

/** The lower median of the finite values. */
function median(values: number[]): number {
  const sorted = Float64Array.from(values.filter(Number.isFinite)).sort();
  return sorted.length > 0 ? sorted[(sorted.length - 1) >> 1] : 0;
}
