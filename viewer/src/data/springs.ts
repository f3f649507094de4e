// The springs of a scene: from a body to a point of space, or between two bodies, as its resolved form tells them; in a
// lattice those of all cells.

import type { Header, Json, Vec3 } from "./header";
import { list, table, vector } from "./json";
import { Cells } from "./lattice";

/** More would be a tangle. */
const MOST = 10_000;

/** A material point of a body, from its centre of mass, or a point of space. */
export interface SpringEnd {
  body: number | null;
  at: Vec3;
  /** How far the image of the body is that is meant, beyond the end of a periodic lattice [m]. */
  shift?: Vec3;
}

export interface Spring {
  ends: [SpringEnd, SpringEnd];
  /** The length without force [m]. */
  rest: number;
}

/** All springs of the scene; none where there are too many to tell apart. */
export function springsOf(header: Header): Spring[] {
  const scene = table(header.resolved);
  const cells = new Cells(header);
  const index = new Map(header.bodies.map((body, place) => [body.name, place]));
  const written =
    list(scene.spring).length +
    list(scene.body).reduce<number>((sum, body) => sum + list(table(body).spring).length, 0);
  if (written * cells.count > MOST) return [];
  return Array.from({ length: cells.count }, (_, number) => {
    const bodyIn = (name: Json | undefined, cell: number) => index.get(cells.nameIn(String(name), cell));
    const anchored = list(scene.body).flatMap((body) => {
      const place = bodyIn(table(body).name, number);
      if (place === undefined) return [];
      return list(table(body).spring).map((spring) => toAnchor(spring, place, cells.place(cells.at(number))));
    });
    const between = list(scene.spring).flatMap((spring): Spring[] => {
      const { between, points, cell, rest_length } = table(spring);
      const other = cells.beside(cells.at(number), list(cell).map(Number));
      const bodies = [bodyIn(list(between)[0], number), other && bodyIn(list(between)[1], other.number)];
      const [one, two] = bodies;
      if (one === undefined || two === undefined || two === null || !other) return [];
      const [here, there] = list(points).map(vector);
      const far = other.shift.some((part) => part !== 0) ? { shift: other.shift } : {};
      const ends: [SpringEnd, SpringEnd] = [
        { body: one, at: here ?? [0, 0, 0] },
        { body: two, at: there ?? [0, 0, 0], ...far },
      ];
      return [{ rest: Number(rest_length ?? 0), ends }];
    });
    return [...anchored, ...between];
  }).flat();
}

function toAnchor(spring: Json, body: number, away: Vec3): Spring {
  const { point, anchor, rest_length } = table(spring);
  const there = vector(anchor).map((part, axis) => part + away[axis]) as Vec3;
  return {
    rest: Number(rest_length ?? 0),
    ends: [
      { body, at: vector(point) },
      { body: null, at: there },
    ],
  };
}
