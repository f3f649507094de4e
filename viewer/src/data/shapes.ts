// The kinds of shapes of bodies and supports, as the resolved scene names them, and the boxes around surfaces.

import { describedIn } from "./described";
import type { Header, Vec3 } from "./header";
import { table } from "./json";

/** The kind of shape of what a scene names: `box`, `sphere`, … ; `null` where it tells none. */
export function shapesIn(header: Pick<Header, "resolved">): (name: string) => string | null {
  const described = describedIn(header);
  return (name) => Object.keys(table(described(name).shape))[0] ?? null;
}

/** A box along the axes of the body, around its points. */
export interface Extent {
  middle: Vec3;
  /** Half the sides [m]. */
  half: Vec3;
}

/** The box around points, three numbers each. */
export function extentOf(points: ArrayLike<number>): Extent {
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  for (let at = 0; at < points.length; at++) {
    const axis = at % 3;
    low[axis] = Math.min(low[axis], points[at]);
    high[axis] = Math.max(high[axis], points[at]);
  }
  if (!(high[0] >= low[0])) return { middle: [0, 0, 0], half: [0, 0, 0] };
  return {
    middle: low.map((value, axis) => 0.5 * (value + high[axis])) as Vec3,
    half: low.map((value, axis) => 0.5 * (high[axis] - value)) as Vec3,
  };
}
