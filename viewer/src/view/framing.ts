// What a camera should see: a ball around the bodies' paths and the ground under them, from millimetres to kilometres.
// The path of a body that flies off counts as far as the others reach.

import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { straysOf } from "../data/strays";
import { dot, norm, unit } from "../math/mat3";

/** Instants looked at; a path has no room to hide between them. */
const INSTANTS = 300;
/** Paths this many times larger than the bodies are not shown whole: the bodies would be dots. */
const MOST_SIZES = 14;
/** A body that is followed has this many sizes of room around it. */
const ROOM_SIZES = 3;

export interface Framing {
  /** A box that is to be seen [m]. */
  box: Box;
  center: Vec3;
  /** Half the diagonal of the box [m]. */
  radius: number;
  /** The opposite of gravity; z without gravity. */
  up: Vec3;
  /** Whether it is looked at from below, since all supports are above. */
  fromBelow: boolean;
  /** Whether the ball goes with the bodies, since their whole path would make them dots. */
  travels: boolean;
}

/** The first framing of what has been recorded so far. */
export function framed(recording: Recording): Framing {
  const { header } = recording;
  const up = upward(recording);
  const { supports } = header;
  const fromBelow = supports.length > 0 && supports.every(({ normal }) => dot(normal, up) < -0.3);
  const size = Math.max(...header.bodies.map((body) => body.size), 1e-12);
  const whole = box(recording, recording.rows - 1);
  const extent = Math.max(...whole[1].map((value, axis) => value - whole[0][axis]));
  if (header.bodies.length > 1 || !(extent > MOST_SIZES * size))
    return { ...ball(whole), up, fromBelow, travels: false };
  const [x, y, z] = recording.track("position")?.values ?? [0, 0, 0];
  const around: Box = nowhere();
  grow(around, [x, y, z], ROOM_SIZES * size);
  return { ...ball(around), up, fromBelow, travels: true };
}

export function upward(recording: Recording): Vec3 {
  const [x, y, z] = recording.header.gravity;
  return unit([-x, -y, -z], [0, 0, 1]);
}

export type Box = [Vec3, Vec3];

/** Around the bodies up to a row, and the supports' points below them where those are near. */
function box(recording: Recording, last: number): Box {
  const { bodies, supports } = recording.header;
  const centers = recording.track("position")?.values ?? new Float32Array(0);
  const around = nowhere();
  const strays = straysOf(recording);
  const instants = Math.min(last, INSTANTS, Math.ceil(100_000 / Math.max(1, bodies.length)));
  for (let k = 0; k <= instants; k++) {
    const row = instants > 0 ? Math.round((last * k) / instants) : 0;
    bodies.forEach((body, index) => {
      const at = 3 * (row * bodies.length + index);
      const p = Array.from(centers.subarray(at, at + 3)) as Vec3;
      const away = norm(p.map((value, axis) => value - strays.middle[axis]));
      if (strays.bodies.has(index) && away > strays.radius) return;
      grow(around, p, 0.55 * body.size);
      for (const { normal, origin } of supports) {
        const height = dot(p, normal) - dot(origin, normal);
        if (height < 12 * body.size)
          grow(around, p.map((value, axis) => value - height * normal[axis]) as Vec3, 0);
      }
    });
  }
  return around;
}

function grow([low, high]: Box, at: Vec3, margin: number): void {
  for (let axis = 0; axis < 3; axis++) {
    if (!Number.isFinite(at[axis])) continue;
    low[axis] = Math.min(low[axis], at[axis] - margin);
    high[axis] = Math.max(high[axis], at[axis] + margin);
  }
}

function nowhere(): Box {
  return [
    [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY],
    [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY],
  ];
}

function ball(box: Box): { box: Box; center: Vec3; radius: number } {
  const [low, high] = box;
  const radius = 0.5 * norm(high.map((value, axis) => value - low[axis]));
  if (!(radius > 0) || !Number.isFinite(radius))
    return {
      box: [
        [-1, -1, -1],
        [1, 1, 1],
      ],
      center: [0, 0, 0],
      radius: 1,
    };
  return { box, center: low.map((value, axis) => 0.5 * (value + high[axis])) as Vec3, radius };
}

/** The eight corners of a box. */
export function corners([low, high]: Box): Vec3[] {
  return Array.from(
    { length: 8 },
    (_, k) => [0, 1, 2].map((axis) => ((k >> axis) & 1 ? high : low)[axis]) as Vec3,
  );
}
