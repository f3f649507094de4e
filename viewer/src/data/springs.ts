// The springs of a scene: from a body to a point of space, or between two bodies, as its resolved form tells them.

import type { Header, Json, Vec3 } from "./header";

/** A material point of a body, from its centre of mass, or a point of space. */
export interface SpringEnd {
  body: number | null;
  at: Vec3;
}

export interface Spring {
  ends: [SpringEnd, SpringEnd];
  /** The length without force [m]. */
  rest: number;
}

/** All springs of the scene. */
export function springsOf(header: Header): Spring[] {
  const scene = table(header.resolved);
  const index = new Map(header.bodies.map((body, place) => [body.name, place]));
  const anchored = list(scene.body).flatMap((body) => {
    const place = index.get(String(table(body).name));
    if (place === undefined) return [];
    return list(table(body).spring).map((spring): Spring => {
      const { point, anchor, rest_length } = table(spring);
      return {
        rest: Number(rest_length ?? 0),
        ends: [
          { body: place, at: vector(point) },
          { body: null, at: vector(anchor) },
        ],
      };
    });
  });
  const between = list(scene.spring).flatMap((spring): Spring[] => {
    const [one, other] = list(table(spring).between).map((name) => index.get(String(name)));
    const [here, there] = list(table(spring).points);
    if (one === undefined || other === undefined) return [];
    return [
      {
        rest: Number(table(spring).rest_length ?? 0),
        ends: [
          { body: one, at: vector(here) },
          { body: other, at: vector(there) },
        ],
      },
    ];
  });
  return [...anchored, ...between];
}

function table(value: Json | undefined): { [key: string]: Json } {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? value : {};
}

function list(value: Json | undefined): Json[] {
  return Array.isArray(value) ? value : [];
}

function vector(value: Json | undefined): Vec3 {
  const [x, y, z] = list(value).map(Number);
  return [x ?? 0, y ?? 0, z ?? 0];
}
