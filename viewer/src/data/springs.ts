// The springs and bonds of a scene: from a body to a point of space, or between two bodies, as its resolved form tells
// them; in a lattice those of all cells.

import { type End, Ends, writtenMotion } from "./ends";
import type { Header, Json, Vec3 } from "./header";
import { list, table, vector } from "./json";

/** More would be a tangle. */
const MOST = 10_000;

export interface Spring {
  ends: [End, End];
  /** The length without force [m]. */
  rest: number;
}

/** All springs of the scene; none where there are too many to tell apart. */
export function springsOf(header: Header): Spring[] {
  const scene = table(header.resolved);
  const ends = new Ends(header);
  const { cells } = ends;
  const written =
    list(scene.spring).length +
    list(scene.body).reduce<number>((sum, body) => sum + list(table(body).spring).length, 0);
  if (written * cells.count > MOST) return [];
  return Array.from({ length: cells.count }, (_, number) => {
    const anchored = list(scene.body).flatMap((body) => {
      const place = ends.bodyIn(table(body).name, number);
      if (place === undefined) return [];
      return list(table(body).spring).map((spring) => toAnchor(spring, place, cells.place(cells.at(number))));
    });
    const between = list(scene.spring).flatMap((spring): Spring[] => {
      const both = ends.between(spring, number);
      return both ? [{ rest: Number(table(spring).rest_length ?? 0), ends: both }] : [];
    });
    return [...anchored, ...between];
  }).flat();
}

/** The points that each bond joins; none where there are too many. */
export function bondsOf(header: Header): [End, End][] {
  const ends = new Ends(header);
  const written = list(table(header.resolved).bond);
  if (written.length * ends.cells.count > MOST) return [];
  return Array.from({ length: ends.cells.count }, (_, number) =>
    written.flatMap((bond) => {
      const both = ends.between(bond, number);
      return both ? [both] : [];
    }),
  ).flat();
}

function toAnchor(spring: Json, body: number, away: Vec3): Spring {
  const { point, anchor, anchor_motion, rest_length } = table(spring);
  const there = vector(anchor).map((part, axis) => part + away[axis]) as Vec3;
  const motion = writtenMotion(anchor_motion);
  return {
    rest: Number(rest_length ?? 0),
    ends: [
      { body, at: vector(point) },
      { body: null, at: there, ...(motion && { motion }) },
    ],
  };
}
