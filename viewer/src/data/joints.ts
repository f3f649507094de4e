// The joints and pins of a scene, as its resolved form tells them.

import { describedIn } from "./described";
import { type End, Ends } from "./ends";
import type { Header, Vec3 } from "./header";
import { list, table, vector } from "./json";

const KINDS = ["ball", "hinge", "slider", "weld", "distance"] as const;

export type JointKind = (typeof KINDS)[number];

export interface Joint {
  name: string;
  kind: JointKind;
  ends: [End, End];
  /** Of a hinge or slider, in the axes of a first that is a body, else in those of space before any motion. */
  axis: Vec3;
}

/** All joints; a lattice has none. */
export function jointsOf(header: Header): Joint[] {
  const found = new Ends(header);
  return list(table(header.resolved).joint).flatMap((written): Joint[] => {
    const { name, kind, axis, between } = table(written);
    const ends = found.between(written, 0);
    const known = KINDS.find((word) => word === kind);
    if (!ends || !known) return [];
    const own = axis === undefined ? ([0, 0, 1] as Vec3) : vector(axis);
    const turn = found.turnOf(list(between)[0]);
    const turned = turn
      ? ([0, 3, 6].map((row) => turn[row] * own[0] + turn[row + 1] * own[1] + turn[row + 2] * own[2]) as Vec3)
      : own;
    return [{ name: String(name), kind: known, ends, axis: turned }];
  });
}

/** The points by which bodies are pinned, each with the centre of mass of its body. */
export function pinsOf(header: Header): [End, End][] {
  const described = describedIn(header);
  return header.bodies.flatMap(({ name }, body): [End, End][] => {
    const { pin } = described(name);
    const center: End = { body, at: [0, 0, 0] };
    return Array.isArray(pin) ? [[{ body, at: vector(pin) }, center]] : [];
  });
}
